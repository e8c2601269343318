hemoscale_test(NAME coupling_unit LABEL unit LIBRARIES hemoscale_coupling
  SOURCES
    unit/coupling/coupled_loop_test.cpp
    unit/coupling/coupling_scheme_test.cpp
    unit/coupling/micro_runs_test.cpp
    unit/coupling/monotone_regression_test.cpp
    unit/coupling/openfoam_dictionary_test.cpp
    unit/coupling/rheology_table_test.cpp
    unit/coupling/sampling_test.cpp
    unit/coupling/scheme_parts_test.cpp
    unit/coupling/student_t_test.cpp
    unit/coupling/transfer_test.cpp
    unit/coupling/channel_forcing_test.cpp)
hemoscale_test(NAME coupling_property LABEL property LIBRARIES hemoscale_coupling
  SOURCES
    property/coupling/monotone_fit_test.cpp
    property/coupling/shear_frame_test.cpp)
hemoscale_test(NAME coupling_verification LABEL verification LIBRARIES hemoscale_coupling
  SOURCES
    verification/coupling/channel_feedback_test.cpp
    verification/coupling/confidence_band_test.cpp)
hemoscale_test(NAME coupling_stability LABEL stability LIBRARIES hemoscale_coupling
  SOURCES stability/coupling/relaxation_limit_test.cpp)
hemoscale_test(NAME coupling_restart LABEL restart LIBRARIES hemoscale_coupling
  SOURCES restart/coupling/loop_restart_test.cpp)

add_executable(coupling_mpi mpi/coupling/rank_independence_test.cpp)
set_target_properties(coupling_mpi PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(coupling_mpi PRIVATE hemoscale_coupling hemoscale_options GTest::gtest GTest::gmock)
foreach(ranks 1 2 3)
  add_test(NAME mpi.coupling_rank_independence.${ranks}_ranks
    COMMAND ${MPIEXEC_EXECUTABLE} --allow-run-as-root --oversubscribe ${MPIEXEC_NUMPROC_FLAG} ${ranks}
            $<TARGET_FILE:coupling_mpi>)
  set_tests_properties(mpi.coupling_rank_independence.${ranks}_ranks PROPERTIES LABELS mpi
    RUN_SERIAL TRUE TIMEOUT 60)
endforeach()
