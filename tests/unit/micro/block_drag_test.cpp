#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "micro/error.hpp"
#include "tests/support/micro/block_laws.hpp"
#include "tests/support/micro/blocks.hpp"

namespace hemoscale::micro {
namespace {

using blocks::kernel_index;
using test::BlockCase;
using test::Integrator;
using test::KernelBlock;
using test::Polygon;
using test::um;
using testing::HasSubstr;

template <class Real>
class BlockDrag : public testing::Test {};
TYPED_TEST_SUITE(BlockDrag, test::Reals);

// The displacement of an explicit step with anisotropic drag: that with isotropic drag, of which
// the part across the membrane is divided by the ratio.
TYPED_TEST(BlockDrag, across_the_membrane_acts_on_forces_alone) {
  constexpr int nodes = 37;
  const double ratio = 2.5;
  MembraneParameters p;
  p.area_modulus = 5;
  const MembraneLaws laws = make_membrane_laws(p);
  const RingMesh mesh =
      make_ring_mesh(test::dented_polygon(nodes, 1, 0.05, 0.02), NaturalShape::outline);
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    for (const bool walls : {false, true}) {
      const auto displacements = [&](double excess, bool flow) {
        KernelBlock<TypeParam> block(mesh, laws, 3e-3);
        for (std::size_t lane = 0; lane < block.width; ++lane) {
          block.set(lane, test::dented_polygon(nodes, 100 + lane));
        }
        const Polygon before = block.get(1);
        const test::BlockSituation situation{true, walls};
        test::disturb(block, situation, 0.01, 7);
        if (!flow) block.flow.assign(block.flow.size(), 0);
        block.ring.normal_excess = static_cast<TypeParam>(excess);
        version->explicit_step[kernel_index(situation.choice(false))](block.arguments());
        const Polygon after = block.get(1);
        Polygon result;
        for (std::size_t i = 0; i < before.size(); ++i) {
          result.push_back((after[i] - before[i]) / um +
                           Vector<2>(static_cast<double>(block.memory_x[i * block.width + 1]),
                                     static_cast<double>(block.memory_y[i * block.width + 1])));
        }
        return result;
      };
      const Polygon forces = displacements(0, false);
      const Polygon isotropic = displacements(0, true);
      const Polygon found = displacements(1 / ratio - 1, true);
      KernelBlock<TypeParam> block(mesh, laws, 3e-3);
      block.set(1, test::dented_polygon(nodes, 101));
      const Polygon shape = block.get(1);
      const double scale = test::largest_norm(forces);
      for (std::size_t i = 0; i < nodes; ++i) {
        const Vector<2> chord =
            (shape[(i + 1) % nodes] - shape[(i + nodes - 1) % nodes]).normalized();
        const Vector<2> normal(chord.y(), -chord.x());
        const Vector<2> wanted = isotropic[i] + (1 / ratio - 1) * forces[i].dot(normal) * normal;
        EXPECT_LE((found[i] - wanted).norm(), (sizeof(TypeParam) == 4 ? 3e-5 : 1e-12) * scale)
            << version->name << ", node " << i;
      }
    }
  }
}

struct Refused {
  const char* why;
  void (*spoil)(blocks::BlockSettings&);
};

TEST(BlockSettings, of_drag_mass_and_stages_are_checked) {
  using blocks::BlockSettings;
  const Refused refused[] = {
      {"only explicit_euler and chebyshev",
       [](BlockSettings& s) { s.kinds.front().normal_drag = 2; }},
      {"must be finite and positive", [](BlockSettings& s) { s.kinds.front().normal_drag = 0; }},
      {"needs a positive one", [](BlockSettings& s) { s.integrator = Integrator::inertial; }},
      {"only with the inertial integrator",
       [](BlockSettings& s) { s.kinds.front().momentum_drag = 1; }},
      {"2 to 50 are possible",
       [](BlockSettings& s) {
         s.integrator = Integrator::chebyshev;
         s.stages = 51;
       }},
      {"strongest attraction", [](BlockSettings& s) {
         s.contact = MorsePotential{
             .energy_scale = 1e-13, .steepness = 8e6, .rest_distance = 3e-7, .cutoff = 3.5e-7};
       }}};
  for (const Refused& each : refused) {
    BlockCase c = test::relaxing_cell();
    c.settings.time_step = 1e-6;
    c.settings.integrator = Integrator::linearly_implicit;
    each.spoil(c.settings);
    try {
      c.make(Precision::twofold);
      FAIL() << each.why;
    } catch (const ParameterError& error) {
      EXPECT_THAT(error.what(), HasSubstr(each.why));
    }
  }
}

// Laws with integrators: a crowd that shear brings into contact stays apart.
TEST(BlockContactLaws, keep_cells_apart) {
  for (const auto& [name, law] : test::contact_laws()) {
    for (const Integrator integrator :
         {Integrator::linearly_implicit, Integrator::constant_operator_second_order,
          Integrator::chebyshev}) {
      // Frozen contacts: the limit is that of the steep cores of the other laws.
      if (integrator == Integrator::chebyshev && law.index() != 0) continue;
      BlockCase c = test::crowded_channel();
      c.settings.contact = law;
      c.settings.integrator = integrator;
      c.settings.stages = 20;
      c.settings.time_step = integrator == Integrator::chebyshev ? 4e-5 : 1e-3;
      BlockEnsemble ensemble = c.make(Precision::single);
      const auto steps = static_cast<std::int64_t>(std::lround(0.4 / c.settings.time_step));
      EXPECT_NO_THROW(ensemble.advance(steps)) << name;
      EXPECT_EQ(test::count_contacts(ensemble.states(), 0.12e-6), 0U) << name;
      EXPECT_GT(test::count_contacts(ensemble.states(), 0.5e-6), 10U) << name;
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
