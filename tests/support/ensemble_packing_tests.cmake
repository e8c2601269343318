# Initial states of the ensembles, cells that come and go, and what is checked of them.
hemoscale_test(NAME ensemble_packing_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/micro/ensemble_packing_checks_test.cpp
  unit/micro/ensemble_packing_feed_test.cpp
  unit/micro/ensemble_packing_insertion_test.cpp
  unit/micro/ensemble_packing_lattice_test.cpp
  unit/micro/ensemble_packing_outline_test.cpp)
hemoscale_test(NAME ensemble_packing_property LABEL property LIBRARIES hemoscale_micro SOURCES
  property/micro/ensemble_packing_test.cpp)
hemoscale_test(NAME ensemble_packing_scene LABEL unit LIBRARIES hemoscale_scene hemoscale_config SOURCES
  unit/scene/ensemble_kinds_test.cpp
  unit/scene/ensemble_packing_shape_test.cpp)
