# The semi-implicit particle method.
hemoscale_test(NAME mps_semi_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/mps/semi_domains_test.cpp
  unit/mps/semi_lattice_constants_test.cpp
  unit/mps/semi_operators_test.cpp)
hemoscale_test(NAME mps_semi_verification LABEL verification LIBRARIES hemoscale_micro SOURCES
  verification/mps/semi_flows_test.cpp)
hemoscale_test(NAME mps_semi_stability LABEL stability LIBRARIES hemoscale_micro SOURCES
  stability/mps/semi_limits_test.cpp)
hemoscale_test(NAME mps_semi_restart LABEL restart LIBRARIES hemoscale_micro SOURCES
  restart/mps/semi_restart_test.cpp)
target_link_libraries(mps_semi_restart PRIVATE OpenMP::OpenMP_CXX)

add_executable(benchmark_mps EXCLUDE_FROM_ALL benchmark/mps/semi_implicit_step.cpp)
set_target_properties(benchmark_mps PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(benchmark_mps PRIVATE hemoscale_micro hemoscale_options fmt::fmt
  OpenMP::OpenMP_CXX)

add_executable(benchmark_stage EXCLUDE_FROM_ALL benchmark/mps/stage_step.cpp)
set_target_properties(benchmark_stage PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(benchmark_stage PRIVATE hemoscale_micro hemoscale_options fmt::fmt
  OpenMP::OpenMP_CXX)

# Particles, the least-squares method and the plasma model.
hemoscale_test(NAME particles_property LABEL property LIBRARIES hemoscale_micro SOURCES
  property/particles/neighbour_table_test.cpp)
target_link_libraries(particles_property PRIVATE OpenMP::OpenMP_CXX)
hemoscale_test(NAME mps_stage_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/mps/plasma_model_test.cpp
  unit/mps/stage_domains_test.cpp
  unit/mps/stage_least_squares_test.cpp)
hemoscale_test(NAME mps_stage_verification LABEL verification LIBRARIES hemoscale_micro SOURCES
  verification/mps/stage_flows_test.cpp TIMEOUT 120)
hemoscale_test(NAME mps_stage_stability LABEL stability LIBRARIES hemoscale_micro SOURCES
  stability/mps/stage_limits_test.cpp)
hemoscale_test(NAME mps_stage_restart LABEL restart LIBRARIES hemoscale_micro SOURCES
  restart/mps/stage_restart_test.cpp)
target_link_libraries(mps_stage_restart PRIVATE OpenMP::OpenMP_CXX)
# They set the number of threads: compiled with OpenMP, unlike the precompiled headers.
set_target_properties(mps_semi_restart particles_property mps_stage_restart
  PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
