# LAPACK by its C interface, on OpenBLAS: the library alone knows how to use one thread.
# Gives LAPACKE::LAPACKE (private to the library that links it: no header of ours includes it).
find_path(LAPACKE_INCLUDE_DIR lapacke.h)
find_path(OPENBLAS_INCLUDE_DIR cblas.h PATH_SUFFIXES openblas-pthread openblas-openmp
  openblas-serial openblas)
find_library(LAPACKE_LIBRARY lapacke)
find_library(OPENBLAS_LIBRARY openblas)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LAPACKE
  REQUIRED_VARS LAPACKE_LIBRARY OPENBLAS_LIBRARY LAPACKE_INCLUDE_DIR OPENBLAS_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install liblapacke-dev and libopenblas-dev (cases/support/packages.txt)")
mark_as_advanced(LAPACKE_INCLUDE_DIR OPENBLAS_INCLUDE_DIR LAPACKE_LIBRARY OPENBLAS_LIBRARY)
if(LAPACKE_FOUND AND NOT TARGET LAPACKE::LAPACKE)
  add_library(LAPACKE::LAPACKE INTERFACE IMPORTED GLOBAL)
  target_include_directories(LAPACKE::LAPACKE SYSTEM INTERFACE ${LAPACKE_INCLUDE_DIR}
    ${OPENBLAS_INCLUDE_DIR})
  # OpenBLAS first: it holds an optimised LAPACK, whichever liblapack.so.3 the system has chosen.
  target_link_libraries(LAPACKE::LAPACKE INTERFACE ${OPENBLAS_LIBRARY} ${LAPACKE_LIBRARY})
endif()
