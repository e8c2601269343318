add_library(hemoscale_linear_test_support STATIC support/linear/model_systems.cpp)
target_link_libraries(hemoscale_linear_test_support PUBLIC hemoscale_micro PRIVATE hemoscale_options)

# Figures of micro/linear/README.md; not part of the tests, nor of `all`.
add_executable(benchmark_linear EXCLUDE_FROM_ALL benchmark/linear/pressure_solve.cpp)
set_target_properties(benchmark_linear PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(benchmark_linear PRIVATE hemoscale_linear_test_support hemoscale_options fmt::fmt
  MPI::MPI_C)
target_compile_definitions(benchmark_linear PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)

hemoscale_test(NAME linear_unit LABEL unit LIBRARIES hemoscale_linear_test_support SOURCES
  unit/linear/aggregate_solver_test.cpp
  unit/linear/choose_solver_test.cpp
  unit/linear/direct_solvers_test.cpp
  unit/linear/krylov_test.cpp
  unit/linear/lattice_interpolation_test.cpp
  unit/linear/ordering_test.cpp
  unit/linear/sparse_matrix_test.cpp)
hemoscale_test(NAME linear_property LABEL property LIBRARIES hemoscale_linear_test_support
    OpenMP::OpenMP_CXX SOURCES
  property/linear/solvers_agree_test.cpp)
# It sets the number of threads: compiled with OpenMP, unlike the precompiled headers.
set_target_properties(linear_property PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
hemoscale_test(NAME linear_verification LABEL verification LIBRARIES hemoscale_linear_test_support
  SOURCES
  verification/linear/iterations_test.cpp)

add_executable(linear_mpi mpi/linear/hypre_test.cpp)
set_target_properties(linear_mpi PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(linear_mpi PRIVATE hemoscale_linear_test_support hemoscale_options GTest::gtest
  GTest::gmock)
foreach(ranks 1 2 3)
  add_test(NAME mpi.linear_hypre.${ranks}_ranks
    COMMAND ${MPIEXEC_EXECUTABLE} --allow-run-as-root --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks}
            $<TARGET_FILE:linear_mpi>)
  set_tests_properties(mpi.linear_hypre.${ranks}_ranks PROPERTIES LABELS mpi RUN_SERIAL TRUE TIMEOUT 60)
endforeach()
