#pragma once

#include "micro/ensemble/blocks/kernel_arguments.hpp"

namespace hemoscale::micro::blocks {

// The tables of the versions that this build contains.
namespace plain {  // what every processor of the family runs
extern const Kernels<float> single_kernels;
extern const Kernels<double> double_kernels;
}  // namespace plain
namespace v3 {  // x86-64-v3: 256 bits, fused operations
extern const Kernels<float> single_kernels;
extern const Kernels<double> double_kernels;
}  // namespace v3
namespace v4 {  // x86-64-v4: 512 bits
extern const Kernels<float> single_kernels;
extern const Kernels<double> double_kernels;
}  // namespace v4

}  // namespace hemoscale::micro::blocks
