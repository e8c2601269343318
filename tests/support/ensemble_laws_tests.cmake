# Integrators, laws of contact and migration, drag forms and limits of the block ensemble.
hemoscale_test(NAME ensemble_laws_unit LABEL unit LIBRARIES hemoscale_micro SOURCES
  unit/micro/block_drag_test.cpp
  unit/micro/block_pair_laws_test.cpp
  unit/micro/chebyshev_weights_test.cpp
  unit/micro/contact_law_test.cpp)
hemoscale_test(NAME ensemble_laws_verification LABEL verification LIBRARIES hemoscale_micro SOURCES
  verification/micro/block_orders_test.cpp
  verification/micro/lateral_migration_test.cpp)
hemoscale_test(NAME ensemble_laws_stability LABEL stability LIBRARIES hemoscale_micro SOURCES
  stability/micro/block_limits_test.cpp)
