# Given flows, walls and openings of the ensembles.
hemoscale_test(NAME ensemble_flow_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/ensemble_flow/grid_flow_test.cpp
  unit/ensemble_flow/inflow_queue_test.cpp
  unit/ensemble_flow/openings_test.cpp
  unit/ensemble_flow/parallel_flow_test.cpp
  unit/ensemble_flow/table_flow_test.cpp
  unit/ensemble_flow/wall_geometry_test.cpp)
hemoscale_test(NAME ensemble_flow_property LABEL property LIBRARIES hemoscale_micro SOURCES
  property/ensemble_flow/inflow_property_test.cpp
  property/ensemble_flow/wall_distance_property_test.cpp)
hemoscale_test(NAME ensemble_flow_verification LABEL verification LIBRARIES hemoscale_micro SOURCES
  verification/ensemble_flow/grid_order_test.cpp
  verification/ensemble_flow/wall_circle_test.cpp)
hemoscale_test(NAME ensemble_flow_scene LABEL unit LIBRARIES hemoscale_scene hemoscale_config SOURCES
  unit/ensemble_flow/scene_flow_test.cpp)
