hemoscale_test(NAME macro_unit_test LABEL unit LIBRARIES hemoscale_macro
  SOURCES
    unit/macro/kinematics_test.cpp
    unit/macro/decaying_flows_test.cpp
    unit/macro/viscosity_laws_test.cpp
    unit/macro/parameter_check_test.cpp
    unit/macro/viscosity_table_test.cpp
    unit/macro/numerics_test.cpp
    unit/macro/analytic_flows_test.cpp
    unit/macro/channel_model_test.cpp)
hemoscale_test(NAME macro_property_test LABEL property LIBRARIES hemoscale_macro
  SOURCES
    property/macro/kinematics_property_test.cpp
    property/macro/viscosity_property_test.cpp
    property/macro/channel_property_test.cpp)
hemoscale_test(NAME macro_verification_test LABEL verification LIBRARIES hemoscale_macro
  SOURCES
    verification/macro/table_order_test.cpp
    verification/macro/analytic_flows_verification_test.cpp
    verification/macro/womersley_verification_test.cpp
    verification/macro/channel_exact_test.cpp
    verification/macro/channel_quadrature_test.cpp)
hemoscale_test(NAME macro_stability_test LABEL stability LIBRARIES hemoscale_macro
  SOURCES stability/macro/channel_limits_test.cpp)
hemoscale_test(NAME macro_restart_test LABEL restart LIBRARIES hemoscale_macro
  SOURCES restart/macro/channel_restart_test.cpp)

# The headers as the OpenFOAM library sees them.
hemoscale_test(NAME macro_headers_cxx17_test LABEL unit LIBRARIES hemoscale_macro
  SOURCES unit/macro/headers_cxx17_test.cpp)
set_target_properties(macro_headers_cxx17_test PROPERTIES CXX_STANDARD 17 DISABLE_PRECOMPILE_HEADERS ON)
