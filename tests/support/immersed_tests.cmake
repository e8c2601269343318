# Membranes in plasma.
hemoscale_test(NAME immersed_explicit_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/immersed/direct_insertion_test.cpp
  unit/immersed/kernel_function_test.cpp
  unit/immersed/membrane_watch_test.cpp)
hemoscale_test(NAME immersed_explicit_property LABEL property LIBRARIES hemoscale_micro SOURCES
  property/immersed/kernel_transfer_test.cpp)
hemoscale_test(NAME immersed_explicit_verification LABEL verification LIBRARIES hemoscale_micro
  SOURCES
  verification/immersed/immersed_membranes_test.cpp
  verification/immersed/local_acceleration_test.cpp)
hemoscale_test(NAME immersed_explicit_stability LABEL stability LIBRARIES hemoscale_micro SOURCES
  stability/immersed/membrane_limits_test.cpp)
hemoscale_test(NAME immersed_explicit_restart LABEL restart LIBRARIES hemoscale_micro SOURCES
  restart/immersed/membranes_restart_test.cpp)
target_link_libraries(immersed_explicit_restart PRIVATE OpenMP::OpenMP_CXX)
# It sets the number of threads: compiled with OpenMP, unlike the precompiled headers.
set_target_properties(immersed_explicit_restart PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)

# Membranes advanced implicitly, by boundary integrals.
hemoscale_test(NAME immersed_implicit_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/immersed/boundary_integral_test.cpp
  unit/immersed/cell_stress_test.cpp
  unit/immersed/implicit_membranes_test.cpp
  unit/immersed/ring_quadrature_test.cpp
  unit/immersed/secant_map_test.cpp
  unit/immersed/stokes_kernels_test.cpp
  unit/mps/node_sampler_test.cpp)
hemoscale_test(NAME immersed_implicit_verification LABEL verification LIBRARIES hemoscale_micro
  SOURCES
  verification/immersed/implicit_order_test.cpp
  verification/immersed/many_cells_test.cpp
  verification/immersed/parachute_test.cpp
  verification/immersed/rigid_disc_test.cpp
  verification/immersed/shear_cell_test.cpp
  verification/immersed/stokes_nodes_test.cpp
  verification/immersed/surrounding_flow_test.cpp)
hemoscale_test(NAME immersed_implicit_study LABEL slow LIBRARIES hemoscale_micro TIMEOUT 600 SOURCES
  verification/immersed/many_cells_study_test.cpp
  verification/immersed/migration_study_test.cpp
  verification/immersed/parachute_study_test.cpp)
foreach(program verification study)
  target_link_libraries(immersed_implicit_${program} PRIVATE fmt::fmt)
endforeach()
hemoscale_test(NAME immersed_implicit_restart LABEL restart LIBRARIES hemoscale_micro SOURCES
  restart/immersed/implicit_restart_test.cpp)
target_link_libraries(immersed_implicit_restart PRIVATE OpenMP::OpenMP_CXX)
set_target_properties(immersed_implicit_restart PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
hemoscale_test(NAME immersed_implicit_stability LABEL stability LIBRARIES hemoscale_micro SOURCES
  stability/immersed/implicit_steps_test.cpp)
