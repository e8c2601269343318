#define HEMOSCALE_VERSION v4
#include "micro/ensemble/blocks/kernels.inl"
