#include "micro/cells/capillary_number.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

CellInFlow capillary() {
  return {.viscosity = 1e-3,
          .density = 1000,
          .speed = 1e-2,
          .radius = 3e-6,
          .gap_width = 1e-5,
          .stretch_modulus = 5e-5,
          .bending_modulus = 2e-19};
}

TEST(CellNumbers, of_the_cell_of_the_paper) {
  const CellNumbers numbers = cell_numbers(capillary());
  EXPECT_NEAR(numbers.reynolds, 0.1, 1e-12);
  EXPECT_NEAR(numbers.confinement, 0.6, 1e-12);
  EXPECT_NEAR(numbers.stretch_capillary, 0.2, 1e-12);
  EXPECT_NEAR(numbers.bending_capillary, 450, 1e-9);
}

TEST(CellNumbers, of_an_inextensible_cell_in_unbounded_flow_without_inertia) {
  CellInFlow cell = capillary();
  cell.gap_width = infinity;
  cell.stretch_modulus = infinity;
  EXPECT_EQ(cell_numbers(cell).confinement, 0);
  EXPECT_EQ(cell_numbers(cell).stretch_capillary, 0);
  EXPECT_NEAR(cell_numbers(cell).reynolds, 0.06, 1e-12);
  cell.density = 0;
  EXPECT_EQ(cell_numbers(cell).reynolds, 0);
}

TEST(UnboundedStretch, warns_with_the_number_from_one_on) {
  CellInFlow cell = capillary();
  cell.stretch_modulus = 1.01e-5;
  EXPECT_EQ(unbounded_stretch(cell), "");
  cell.stretch_modulus = 0.5e-5;
  EXPECT_THAT(unbounded_stretch(cell), testing::HasSubstr("mu U / E_l = 2,"));
  EXPECT_THAT(unbounded_stretch(cell), testing::HasSubstr("reduce the speed below 0.005 m/s"));
}

TEST(CellNumbers, refuse_what_is_no_cell_and_name_all_of_it) {
  EXPECT_NO_THROW(cell_numbers(capillary()));
  CellInFlow cell = capillary();
  cell.viscosity = 0;
  cell.radius = -1;
  cell.bending_modulus = infinity;
  try {
    cell_numbers(cell);
    ADD_FAILURE() << "admitted";
  } catch (const ParameterError& error) {
    for (const char* name : {"viscosity", "radius", "bending modulus"}) {
      EXPECT_THAT(error.what(), testing::HasSubstr(name));
    }
  }
  for (double CellInFlow::*value : {&CellInFlow::speed, &CellInFlow::gap_width,
                                    &CellInFlow::stretch_modulus, &CellInFlow::density}) {
    CellInFlow broken = capillary();
    broken.*value = -1;
    EXPECT_THROW(cell_numbers(broken), ParameterError);
    broken.*value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(cell_numbers(broken), ParameterError);
  }
}

}  // namespace
}  // namespace hemoscale::micro
