find_package(nlohmann_json 3.11 REQUIRED)

hemoscale_test(NAME results_unit_test LABEL unit
  SOURCES unit/results/cell_plot_test.cpp
          unit/results/checkpoint_test.cpp
          unit/results/feed_plot_test.cpp
          unit/results/plot_test.cpp
          unit/results/progress_test.cpp
          unit/results/provenance_test.cpp
          unit/results/series_test.cpp
          unit/results/summary_test.cpp
          unit/results/trajectory_file_test.cpp
          unit/results/xdmf_test.cpp
  LIBRARIES hemoscale_snapshot hemoscale_report nlohmann_json::nlohmann_json)
hemoscale_test(NAME results_property_test LABEL property
  SOURCES property/results/damaged_files_test.cpp
  LIBRARIES hemoscale_snapshot)

hemoscale_test(NAME results_restart_test LABEL restart
  SOURCES restart/results/interrupted_writes.cpp
          restart/results/killed_checkpoint_test.cpp
          restart/results/killed_trajectory_test.cpp
  LIBRARIES hemoscale_snapshot MPI::MPI_C ${HDF5_C_LIBRARIES})
target_include_directories(results_restart_test SYSTEM PRIVATE ${HDF5_C_INCLUDE_DIRS})
target_compile_definitions(results_restart_test PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
# These tests replace the C library's writing functions by their own, and the libraries must find
# those of the executable.
set_target_properties(results_restart_test PROPERTIES ENABLE_EXPORTS ON)
