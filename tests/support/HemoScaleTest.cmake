# What nearly every test includes, compiled once. An executable, because its flags must be those of
# the tests.
add_executable(hemoscale_test_headers support/test_headers.cpp)
set_target_properties(hemoscale_test_headers PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(hemoscale_test_headers PRIVATE hemoscale_options Eigen3::Eigen GTest::gtest GTest::gmock)
target_precompile_headers(hemoscale_test_headers PRIVATE <gtest/gtest.h> <gmock/gmock.h> <Eigen/Core>
  <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <sstream>
  <string> <variant> <vector>)

# hemoscale_test(NAME name LABEL label SOURCES file... [LIBRARIES target...] [TIMEOUT seconds])
# One GoogleTest executable whose cases become tests "label.Suite.case" with that label.
function(hemoscale_test)
  cmake_parse_arguments(T "" "NAME;LABEL;TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 120)
  endif()
  if(HEMOSCALE_SANITIZE)
    math(EXPR T_TIMEOUT "5 * ${T_TIMEOUT}")  # instrumented programs take their time
  endif()
  add_executable(${T_NAME} ${T_SOURCES})
  set_target_properties(${T_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${T_NAME} PRIVATE ${T_LIBRARIES} hemoscale_options GTest::gtest_main GTest::gmock)
  target_precompile_headers(${T_NAME} REUSE_FROM hemoscale_test_headers)
  target_compile_definitions(${T_NAME} PRIVATE HEMOSCALE_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    HEMOSCALE_BINARY_DIR="${CMAKE_BINARY_DIR}")
  gtest_discover_tests(${T_NAME} TEST_PREFIX "${T_LABEL}." DISCOVERY_MODE PRE_TEST
    # Tests run side by side: threads of each would wait for each other more than they compute. What
    # must hold for several threads is tested by setting their number.
    PROPERTIES LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT} ENVIRONMENT OMP_NUM_THREADS=1)
endfunction()
