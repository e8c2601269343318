if(TARGET hemoscale_study)
  hemoscale_test(NAME study_unit LABEL unit LIBRARIES hemoscale_study hemoscale_scene
    SOURCES
      unit/study/measured_child_test.cpp
      unit/study/numbers_test.cpp
      unit/study/overrides_test.cpp
      unit/study/plan_test.cpp
      unit/study/read_study_test.cpp
      unit/study/runner_test.cpp)
  hemoscale_test(NAME study_property LABEL property LIBRARIES hemoscale_study
    SOURCES property/study/broken_study_test.cpp)

  # The command as a user runs it (hemoscale_program_test of scene_tests.cmake).
  hemoscale_program_test(property bad_study property/study/bad_study.py 100)
  hemoscale_program_test(verification chart verification/study/chart.py 200)
  hemoscale_program_test(restart killed_chart restart/study/killed_chart.py 200)
endif()
