#pragma once

namespace hemoscale::micro {

/// Keeps OpenBLAS, in the whole process and from now on, to the calling thread: the number of its
/// own threads would show in the last bits. Safe to call from several threads, and again.
void use_one_blas_thread();

}  // namespace hemoscale::micro
