#define HEMOSCALE_VERSION plain
#include "micro/ensemble/blocks/kernels.inl"
