# The ensemble of cells in blocks: kernels, lists, threads, integrators.
hemoscale_test(NAME ensemble_blocks_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/micro/block_errors_test.cpp
  unit/micro/block_explicit_kernel_test.cpp
  unit/micro/block_implicit_kernel_test.cpp
  unit/micro/block_pair_kernel_test.cpp
  unit/micro/block_schedule_test.cpp
  unit/micro/block_threads_test.cpp)
hemoscale_test(NAME ensemble_blocks_property LABEL property LIBRARIES hemoscale_micro SOURCES
  property/micro/block_bits_test.cpp
  property/micro/block_lists_test.cpp
  property/micro/block_rebuilds_test.cpp
  property/micro/block_versions_test.cpp)
hemoscale_test(NAME ensemble_blocks_verification LABEL verification LIBRARIES hemoscale_micro SOURCES
  verification/micro/block_momentum_test.cpp
  verification/micro/block_order_test.cpp)
hemoscale_test(NAME ensemble_blocks_stability LABEL stability LIBRARIES hemoscale_micro SOURCES
  stability/micro/block_stability_test.cpp)
hemoscale_test(NAME ensemble_blocks_restart LABEL restart LIBRARIES hemoscale_micro SOURCES
  restart/micro/block_restart_test.cpp)

# Figures of micro/ensemble/blocks/README.md; not part of the tests, nor of `all`.
add_executable(benchmark_ensemble_speed EXCLUDE_FROM_ALL benchmark/ensemble_speed/ensemble_speed.cpp)
set_target_properties(benchmark_ensemble_speed PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(benchmark_ensemble_speed PRIVATE hemoscale_micro hemoscale_options fmt::fmt)
