# Kill and full-disk tests replace the C library's writing functions by their own: the libraries must
# find those of the executable.
hemoscale_test(NAME results_restart_test LABEL restart
  SOURCES restart/results/interrupted_writes.cpp
          restart/results/killed_trajectory_test.cpp
  LIBRARIES hemoscale_snapshot hemoscale_report)
set_target_properties(results_restart_test PROPERTIES ENABLE_EXPORTS ON)
