#include "coupling/scheme/coupling_scheme.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/support/coupling_doubles.hpp"

namespace hemoscale::coupling {
namespace {

constexpr double hematocrit = 0.4;
constexpr double stress = 1;  // [Pa]

// Simple shear at a given stress that insists on being advanced window by window.
class MarchingFlow final : public macro::MacroModel<2> {
 public:
  std::shared_ptr<const macro::FlowField<2>> advance(const macro::ViscosityLaw& law,
                                                     const macro::Window& window) override {
    EXPECT_EQ(window.begin, time_) << "advanced from another time than that of the model";
    time_ = window.end;
    viscosities.push_back(law.viscosity(1, hematocrit));
    macro::Tensor<2> gradient = macro::Tensor<2>::Zero();
    gradient(0, 1) = stress / viscosities.back();
    return std::make_shared<testing::UniformGradient<2>>(gradient);
  }
  std::vector<double> snapshot() const override { return {time_}; }
  void restore(const std::vector<double>& snapshot) override { time_ = snapshot.at(0); }

  double time() const { return time_; }
  std::vector<double> viscosities;  // [Pa s] of the laws that were seen

 private:
  double time_ = 0;  // [s]
};

class Scheme : public ::testing::Test {
 protected:
  static LoopOptions options() {
    LoopOptions result = testing::loop_options(testing::exact_run());
    result.memory = Memory::latest;
    result.relaxation = ConstantRelaxation{0.9};
    result.tolerance = 1e-3;
    return result;
  }

  micro::Communicator alone_;
  MarchingFlow model_;
  CoupledFlow<2> flow_{model_, {{0, 0}}, hematocrit};
  CoupledLoop loop_{testing::newtonian(0.01), options(),
                    testing::synthetic(testing::power_law(0.02, 0.8), 0, 1), alone_};
};

TEST_F(Scheme, one_way_and_explicit_take_one_pass_a_window) {
  OneWay<2>().advance(flow_, loop_, {0, 1}, {});
  EXPECT_EQ(model_.viscosities.back(), 0.01);
  Explicit<2>().advance(flow_, loop_, {1, 2}, {});
  EXPECT_EQ(model_.viscosities.back(), 0.01);  // the law of the window before
  Explicit<2>().advance(flow_, loop_, {2, 3}, {});
  EXPECT_NE(model_.viscosities.back(), 0.01);
  EXPECT_EQ(model_.viscosities.size(), 3u);
  EXPECT_EQ(model_.time(), 3);
}

TEST_F(Scheme, implicit_repeats_each_window_from_its_begin) {
  Implicit<2> scheme(50);
  int called = 0;
  for (int k = 0; k < 3; ++k) {
    const WindowReport<2> window =
        scheme.advance(flow_, loop_, {double(k), k + 1.0}, [&](const LoopReport&) { ++called; });
    EXPECT_TRUE(window.converged);
    EXPECT_EQ(model_.time(), k + 1);
    EXPECT_EQ(loop_.passes_in_window(), 0);
    if (k > 0) {
      EXPECT_EQ(window.passes.size(), 1u);
    }
  }
  EXPECT_EQ(called, loop_.passes());
}

TEST_F(Scheme, implicit_returns_the_flow_under_the_final_law) {
  const WindowReport<2> window = Implicit<2>(3).advance(flow_, loop_, {0, 1}, {});
  EXPECT_FALSE(window.converged);
  EXPECT_EQ(window.passes.size(), 3u);
  const double viscosity = loop_.law().viscosity(1, hematocrit);
  EXPECT_EQ(model_.viscosities.back(), viscosity);
  EXPECT_EQ(window.field->at({0, 0}, 1)->velocity_gradient(0, 1), stress / viscosity);
}

}  // namespace
}  // namespace hemoscale::coupling
