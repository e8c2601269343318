# Rules of the project that no compiler checks.
# The interpreter for which Debian packages numpy and h5py, whatever else is on the PATH.
find_program(HEMOSCALE_PYTHON NAMES python3 HINTS /usr/bin NO_DEFAULT_PATH)
find_program(HEMOSCALE_PYTHON NAMES python3 REQUIRED)
foreach(rule include_direction text_rules)
  add_test(NAME lint.${rule} COMMAND ${HEMOSCALE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/lint/${rule}.py ${CMAKE_SOURCE_DIR})
  add_test(NAME lint.${rule}.self_test
    COMMAND ${HEMOSCALE_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/lint/${rule}.py --self-test)
  set_tests_properties(lint.${rule} lint.${rule}.self_test PROPERTIES LABELS lint TIMEOUT 60)
endforeach()

find_program(HEMOSCALE_CLANG_FORMAT NAMES clang-format-14)
if(HEMOSCALE_CLANG_FORMAT)
  add_test(NAME lint.format COMMAND sh -c
    "git ls-files '*.hpp' '*.cpp' | xargs '${HEMOSCALE_CLANG_FORMAT}' --dry-run -Werror")
  set_tests_properties(lint.format PROPERTIES LABELS lint TIMEOUT 60 WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endif()

# The installed package serves another project.
set(sanitizer_flags "")
if(HEMOSCALE_SANITIZE)
  set(sanitizer_flags "-fsanitize=address,undefined")
endif()
add_test(NAME verification.installed_package COMMAND ${CMAKE_COMMAND}
  -DBUILD=${CMAKE_BINARY_DIR} -DWORK=${CMAKE_BINARY_DIR}/installed -DGENERATOR=${CMAKE_GENERATOR}
  -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/verification/install "-DFLAGS=${sanitizer_flags}"
  -P ${CMAKE_CURRENT_SOURCE_DIR}/verification/install/installed_package.cmake)
set_tests_properties(verification.installed_package PROPERTIES LABELS verification TIMEOUT 200)
