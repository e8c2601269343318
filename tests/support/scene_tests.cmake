hemoscale_test(NAME scene_unit LABEL unit
  SOURCES unit/scene/child_process_test.cpp unit/scene/results_folder_test.cpp
  LIBRARIES hemoscale_scene)

hemoscale_test(NAME ensemble_feed_unit LABEL unit
  SOURCES unit/scene/ensemble_feed_test.cpp
  LIBRARIES hemoscale_scene hemoscale_config)

# Tests of the program as a user runs it.
function(hemoscale_program_test label name file timeout)
  add_test(NAME ${label}.${name} COMMAND ${HEMOSCALE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  set(has_plugin 0)
  if(HEMOSCALE_OPENFOAM_BUILT)
    set(has_plugin 1)
  endif()
  set_tests_properties(${label}.${name} PROPERTIES LABELS ${label} TIMEOUT ${timeout} ENVIRONMENT
    "HEMOSCALE=$<TARGET_FILE:hemoscale>;HEMOSCALE_HAS_PLUGIN=${has_plugin};PYTHONDONTWRITEBYTECODE=1")
endfunction()
hemoscale_program_test(property bad_input property/scene/bad_input.py 200)
hemoscale_program_test(restart kill_and_restart restart/scene/kill_and_restart.py 200)
hemoscale_program_test(mpi ranks mpi/scene/ranks.py 200)
hemoscale_program_test(verification channel_feedback verification/scene/channel_feedback.py 300)
set_tests_properties(mpi.ranks PROPERTIES RUN_SERIAL ON)
hemoscale_program_test(property plasma_bad_input property/scene/plasma_bad_input.py 120)
hemoscale_program_test(mpi plasma_ranks mpi/scene/plasma_ranks.py 400)
hemoscale_program_test(verification plasma_cases verification/scene/plasma_cases.py 200)
set_tests_properties(mpi.plasma_ranks PROPERTIES RUN_SERIAL ON)
hemoscale_program_test(property cell_bad_input property/scene/cell_bad_input.py 200)
hemoscale_program_test(restart cells_restart restart/scene/cells_restart.py 200)
hemoscale_program_test(verification cell_cases verification/scene/cell_cases.py 200)
hemoscale_program_test(property ensemble_bad_input property/scene/ensemble_bad_input.py 120)
hemoscale_program_test(openfoam fed_bifurcation openfoam/ensemble_flow/fed_bifurcation.py 200)
set_property(TEST openfoam.fed_bifurcation APPEND PROPERTY ENVIRONMENT OMP_NUM_THREADS=1)
hemoscale_program_test(restart ensemble_restart restart/scene/ensemble_restart.py 120)
hemoscale_program_test(verification ensemble_cases verification/scene/ensemble_cases.py 120)
