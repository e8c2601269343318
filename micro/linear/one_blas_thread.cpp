#include "micro/linear/one_blas_thread.hpp"

#include <cblas.h>

#include <Eigen/Core>
#include <mutex>

namespace hemoscale::micro {

void use_one_blas_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    openblas_set_num_threads(1);
    Eigen::setNbThreads(1);
  });
}

}  // namespace hemoscale::micro
