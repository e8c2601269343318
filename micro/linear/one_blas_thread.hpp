#pragma once

namespace hemoscale::micro {

/// Keeps OpenBLAS and the matrix products of Eigen, in the whole process and from now on, to the
/// calling thread: the number of their own threads would show in the last bits. Safe to call from
/// several threads, and again.
void use_one_blas_thread();

}  // namespace hemoscale::micro
