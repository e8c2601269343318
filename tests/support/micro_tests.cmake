hemoscale_test(NAME micro_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/micro/philox_test.cpp
  unit/micro/outline_test.cpp
  unit/micro/outline_checks_test.cpp
  unit/micro/rest_shape_test.cpp
  unit/micro/ring_membrane_test.cpp
  unit/micro/ring_mesh_test.cpp
  unit/micro/angle_period_test.cpp
  unit/micro/capillary_number_test.cpp
  unit/micro/curve_distance_test.cpp
  unit/micro/ring_concavity_test.cpp
  unit/micro/ring_curve_test.cpp
  unit/micro/ring_modes_test.cpp
  unit/micro/ring_motion_test.cpp
  unit/micro/ring_shape_test.cpp
  unit/micro/ring_strain_test.cpp
  unit/micro/steady_state_test.cpp
  unit/micro/potentials_test.cpp
  unit/micro/velocity_profile_test.cpp
  unit/micro/lateral_profile_test.cpp
  unit/micro/series_estimate_test.cpp
  unit/micro/run_average_test.cpp
  unit/micro/synthetic_model_test.cpp
  unit/micro/ensemble_model_test.cpp
  unit/micro/single_communicator_test.cpp)
hemoscale_test(NAME micro_property LABEL property LIBRARIES hemoscale_micro SOURCES
  property/micro/membrane_laws_test.cpp
  property/micro/membrane_stiffness_test.cpp
  property/micro/neighbour_list_test.cpp
  property/micro/packing_test.cpp
  property/micro/stress_test.cpp)
hemoscale_test(NAME micro_verification LABEL verification LIBRARIES hemoscale_micro SOURCES
  verification/micro/ring_shape_test.cpp
  verification/micro/membrane_continuum_test.cpp
  verification/micro/membrane_convergence_test.cpp
  verification/micro/rest_shape_reference_test.cpp
  verification/micro/series_estimate_test.cpp
  verification/micro/ensemble_physics_test.cpp
  verification/micro/euler_order_test.cpp)
hemoscale_test(NAME micro_stability LABEL stability LIBRARIES hemoscale_micro SOURCES
  stability/micro/explicit_limit_test.cpp)
hemoscale_test(NAME micro_restart LABEL restart LIBRARIES hemoscale_micro SOURCES
  restart/micro/micro_restart_test.cpp)

add_executable(micro_mpi mpi/micro/communicator_test.cpp)
set_target_properties(micro_mpi PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(micro_mpi PRIVATE hemoscale_micro hemoscale_options GTest::gtest GTest::gmock)
foreach(ranks 2 3)
  add_test(NAME mpi.micro_communicator.${ranks}_ranks
    COMMAND ${MPIEXEC_EXECUTABLE} --allow-run-as-root --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks}
            $<TARGET_FILE:micro_mpi>)
  set_tests_properties(mpi.micro_communicator.${ranks}_ranks PROPERTIES LABELS mpi RUN_SERIAL TRUE
    TIMEOUT 60)
endforeach()
