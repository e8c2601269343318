# What is seen of an ensemble of cells.
hemoscale_test(NAME ensemble_observables_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/micro/ensemble_cross_forces_test.cpp
  unit/micro/ensemble_observables_flux_test.cpp
  unit/micro/ensemble_observables_forces_test.cpp
  unit/micro/ensemble_observables_lateral_test.cpp
  unit/micro/ensemble_observables_observer_test.cpp
  unit/micro/ensemble_observables_shape_test.cpp)
hemoscale_test(NAME ensemble_observables_property LABEL property LIBRARIES hemoscale_micro SOURCES
  property/micro/ensemble_observables_test.cpp)
hemoscale_test(NAME ensemble_observables_verification LABEL verification LIBRARIES hemoscale_micro
  SOURCES
  verification/micro/ensemble_observables_test.cpp)
hemoscale_test(NAME ensemble_observables_results LABEL unit LIBRARIES hemoscale_scene
  hemoscale_report hemoscale_snapshot SOURCES
  unit/results/ensemble_observables_plot_test.cpp
  unit/scene/ensemble_observables_results_test.cpp)
