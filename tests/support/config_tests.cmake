hemoscale_test(NAME config_unit_tests LABEL unit
  SOURCES
    unit/config/failure_test.cpp
    unit/config/interpret_test.cpp
    unit/config/nearest_key_test.cpp
    unit/config/parameter_table_test.cpp
    unit/config/read_toml_test.cpp
    unit/config/read_value_test.cpp
    unit/config/reference_test.cpp
    unit/config/settings_test.cpp
    unit/config/units_test.cpp
  LIBRARIES hemoscale_config hemoscale_program)
target_include_directories(config_unit_tests SYSTEM PRIVATE ${UDUNITS2_INCLUDE_DIR})
target_link_libraries(config_unit_tests PRIVATE ${UDUNITS2_LIBRARY})

hemoscale_test(NAME config_property_tests LABEL property
  SOURCES property/config/broken_case_test.cpp
  LIBRARIES hemoscale_config)

set(run_and_check ${CMAKE_CURRENT_LIST_DIR}/run_and_check.cmake)

# hemoscale_program_test(name code text command...): how a command ends, and what it says.
function(hemoscale_program_test name label code text)
  add_test(NAME ${label}.program.${name} COMMAND ${CMAKE_COMMAND} -DEXPECT_CODE=${code}
    "-DEXPECT_TEXT=${text}" -P ${run_and_check} -- ${ARGN})
  set_tests_properties(${label}.program.${name} PROPERTIES LABELS ${label} TIMEOUT 60)
endfunction()

if(TARGET hemoscale)
  set(cases ${CMAKE_CURRENT_LIST_DIR}/../unit/config/cases)
  set(hemoscale $<TARGET_FILE:hemoscale>)
  hemoscale_program_test(version unit 0 "hemoscale ${PROJECT_VERSION}" ${hemoscale} --version)
  hemoscale_program_test(help unit 0 "Exit codes" ${hemoscale} --help)
  hemoscale_program_test(no_command unit 1 "subcommand is required" ${hemoscale})
  hemoscale_program_test(unknown_command unit 1 "did you mean check" ${hemoscale} chekc x)
  hemoscale_program_test(unknown_option unit 1 "nonsense" ${hemoscale} check --nonsense x)
  hemoscale_program_test(check unit 0 "no faults" ${hemoscale} check ${cases}/valid)
  hemoscale_program_test(check_file unit 0 "no faults" ${hemoscale} check ${cases}/valid/case.toml)
  hemoscale_program_test(check_broken unit 2 "case.toml:5:14: fluid.hematocrit.*3 faults"
    ${hemoscale} check ${cases}/broken)
  hemoscale_program_test(run_broken unit 2 "3 faults" ${hemoscale} run ${cases}/broken)
  hemoscale_program_test(unknown_variant unit 2 "there is no variant" ${hemoscale} check ${cases}/valid
    --variant nope)
  hemoscale_program_test(no_such_case unit 2 "no such folder" ${hemoscale} check ${cases}/absent)
  hemoscale_program_test(not_a_case unit 2 "not a case folder" ${hemoscale} check ${cases})
  hemoscale_program_test(reference unit 0 "sampling" ${hemoscale} reference)
  hemoscale_program_test(reference_key unit 0 "quantity in N/m" ${hemoscale} reference
    micro.membrane.stretch_modulus)
  hemoscale_program_test(reference_unknown unit 2 "nearest known" ${hemoscale} reference micro.drga)
  hemoscale_program_test(doctor unit 0 "UDUNITS-2" ${hemoscale} doctor)
  hemoscale_program_test(full_disk unit 3 "standard output cannot be written"
    sh -c "\"$0\" reference > /dev/full" ${hemoscale})
endif()

if(TARGET hemoscale_program)
  add_executable(end_together mpi/config/end_together.cpp)
  set_target_properties(end_together PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(end_together PRIVATE hemoscale_program hemoscale_options)
  set(mpi_run ${CMAKE_COMMAND} -E env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    ${MPIEXEC_EXECUTABLE} --oversubscribe ${MPIEXEC_NUMPROC_FLAG} 3 $<TARGET_FILE:end_together>)
  hemoscale_program_test(all_ranks_succeed mpi 0 "" ${mpi_run} nobody)
  hemoscale_program_test(all_ranks_fail mpi 3 "disk full" ${mpi_run} all)
  hemoscale_program_test(one_rank_fails mpi 3 "disk full.*on rank 1, the first of 1 of 3" ${mpi_run} one)
  hemoscale_program_test(one_rank_fails_while_others_wait mpi 3
    "disk full.*on rank 1 of 3; the others are ended" ${mpi_run} waiting)
  # One message, whoever fails.
  add_test(NAME mpi.program.one_message COMMAND ${CMAKE_COMMAND} -DEXPECT_CODE=3
    "-DREFUSE_TEXT=disk full.*disk full" -P ${run_and_check} -- ${mpi_run} all)
  set_tests_properties(mpi.program.one_message PROPERTIES LABELS mpi TIMEOUT 60)
endif()
