# Ensembles spread over ranks.
hemoscale_test(NAME ensemble_regions_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/ensemble_regions/copies_test.cpp
  unit/ensemble_regions/many_cells_test.cpp
  unit/ensemble_regions/region_grid_test.cpp)

add_executable(ensemble_regions_mpi mpi/ensemble_regions/rank_messages_test.cpp
  mpi/ensemble_regions/region_ensemble_test.cpp)
set_target_properties(ensemble_regions_mpi PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(ensemble_regions_mpi PRIVATE hemoscale_micro hemoscale_options GTest::gtest
  GTest::gmock)
foreach(ranks 1 2 3 4)
  add_test(NAME mpi.ensemble_regions.${ranks}_ranks
    COMMAND ${MPIEXEC_EXECUTABLE} --allow-run-as-root --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks}
            $<TARGET_FILE:ensemble_regions_mpi>)
  set_tests_properties(mpi.ensemble_regions.${ranks}_ranks PROPERTIES LABELS mpi RUN_SERIAL TRUE
    TIMEOUT 120)
endforeach()

# Figures of micro/ensemble/regions/README.md; not part of the tests, nor of `all`.
add_executable(benchmark_ensemble_ranks EXCLUDE_FROM_ALL benchmark/ensemble_ranks/ensemble_ranks.cpp)
set_target_properties(benchmark_ensemble_ranks PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(benchmark_ensemble_ranks PRIVATE hemoscale_micro hemoscale_options fmt::fmt
  MPI::MPI_C)
target_compile_definitions(benchmark_ensemble_ranks PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
