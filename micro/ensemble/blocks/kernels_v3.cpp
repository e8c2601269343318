#define HEMOSCALE_VERSION v3
#include "micro/ensemble/blocks/kernels.inl"
