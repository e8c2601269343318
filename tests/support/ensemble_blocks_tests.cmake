# The ensemble of cells in blocks: kernels, lists, threads, integrators.
hemoscale_test(NAME ensemble_blocks_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/micro/block_errors_test.cpp
  unit/micro/block_explicit_kernel_test.cpp
  unit/micro/block_implicit_kernel_test.cpp
  unit/micro/block_pair_kernel_test.cpp
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
