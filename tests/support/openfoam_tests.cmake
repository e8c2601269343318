# Tests against the real OpenFOAM. They are always built; where the plug-in is not part of the build
# they are skipped with the reason, or fail if REQUIRE_OPENFOAM is set in the environment.
set(openfoam_tests ${CMAKE_CURRENT_LIST_DIR}/../openfoam/adapter)

add_library(hemoscale_openfoam_test_support STATIC ${openfoam_tests}/case_folder.cpp)
target_compile_definitions(hemoscale_openfoam_test_support PRIVATE
  HEMOSCALE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" HEMOSCALE_BINARY_DIR="${CMAKE_BINARY_DIR}"
  HEMOSCALE_LIBRARY_FOLDER="${CMAKE_INSTALL_LIBDIR}")
target_link_libraries(hemoscale_openfoam_test_support PUBLIC hemoscale_openfoam_loader GTest::gtest
  PRIVATE hemoscale_options)

add_executable(openfoam_decomposed_sampler ${openfoam_tests}/decomposed_sampler.cpp)
set_target_properties(openfoam_decomposed_sampler PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_compile_definitions(openfoam_decomposed_sampler PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
target_link_libraries(openfoam_decomposed_sampler PRIVATE hemoscale_openfoam_loader MPI::MPI_C
  hemoscale_options)

hemoscale_test(NAME openfoam_reader_test LABEL openfoam TIMEOUT 300
  LIBRARIES hemoscale_openfoam_test_support
  SOURCES ${openfoam_tests}/sampling_test.cpp ${openfoam_tests}/case_reader_test.cpp
    ${openfoam_tests}/loader_test.cpp)
target_compile_definitions(openfoam_reader_test PRIVATE
  HEMOSCALE_SAMPLER="$<TARGET_FILE:openfoam_decomposed_sampler>")
add_dependencies(openfoam_reader_test openfoam_decomposed_sampler)

hemoscale_test(NAME openfoam_viscosity_test LABEL openfoam TIMEOUT 300
  LIBRARIES hemoscale_openfoam_test_support hemoscale_macro
  SOURCES ${openfoam_tests}/viscosity_model_test.cpp)

hemoscale_test(NAME openfoam_plugin_test LABEL openfoam TIMEOUT 300
  LIBRARIES hemoscale_openfoam_test_support
  SOURCES ${openfoam_tests}/function_object_test.cpp)

hemoscale_test(NAME openfoam_ensemble_flow_test LABEL openfoam TIMEOUT 300
  LIBRARIES hemoscale_openfoam_test_support hemoscale_scene hemoscale_config
  SOURCES openfoam/ensemble_flow/bifurcation_test.cpp)
