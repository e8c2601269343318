#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "micro/ensemble/blocks/pair_arguments.hpp"
#include "tests/support/micro/blocks.hpp"
#include "tests/support/micro/contact_laws.hpp"

// Every law of contact in the kernels against its scalar twin in double precision: one cluster of
// four nodes among many others, from nodes that coincide to such as are far away.
namespace hemoscale::micro {
namespace {

using blocks::PairArguments;
using test::AlignedArray;
using test::um;

constexpr int others = 400;  // clusters

template <class Real>
struct Cluster {
  static constexpr std::size_t width = 64 / sizeof(Real);
  AlignedArray<Real> mirror;
  std::vector<blocks::ClusterEntry> entries;
  std::vector<AlignedArray<Real>> sums;
  Real shift[2] = {static_cast<Real>(0.01), static_cast<Real>(-0.02)};  // [um]

  Cluster() : sums(5, AlignedArray<Real>(4 * width, 0)) {
    const auto draw = [](std::uint64_t stream, std::size_t k) {
      return 2 * uniform({5, stream, k}) - 1;
    };
    mirror.assign(8 * (others + 1), 0);
    for (std::size_t k = 0; k < mirror.size(); ++k) mirror[k] = static_cast<Real>(0.5 * draw(0, k));
    for (std::size_t k = 8 * others; k < mirror.size(); ++k) mirror[k] = static_cast<Real>(1e5);
    for (std::uint32_t k = 1; k <= others; ++k) entries.push_back({k, 0});
  }

  void run(typename blocks::Kernels<Real>::Pairs kernel, const ContactLaw& law) {
    const blocks::ActiveCluster active{0, 0, others};
    const std::uint32_t first_cluster[width] = {};
    for (auto& sum : sums) std::fill(sum.begin(), sum.end(), static_cast<Real>(0));
    // Displacements in micrometres are forces in pN/um times tau.
    PairArguments<Real> g = blocks::pair_arguments<Real>(law, 1);
    g.mirror = mirror.data();
    g.active = &active;
    g.active_count = 1;
    g.entries = entries.data();
    g.shifts = shift;
    g.first_cluster = first_cluster;
    g.nodes = 4;
    g.force_x = sums[0].data();
    g.force_y = sums[1].data();
    g.stiffness_xx = sums[2].data();
    g.stiffness_xy = sums[3].data();
    g.stiffness_yy = sums[4].data();
    kernel(g);
  }
  double sum(std::size_t array, std::size_t node) const {
    return static_cast<double>(sums[array][node * width]);
  }
};

/// In SI.
struct Reference {
  Vector<2> force = Vector<2>::Zero();
  double xx = 0, xy = 0, yy = 0;
  double largest = 0;  // sums of magnitudes
  double stiffest = 0;
};

template <class Real>
Reference plain(const Cluster<Real>& cluster, const ContactLaw& law, std::size_t node) {
  Reference result;
  const auto at = [&](std::size_t k) { return static_cast<double>(cluster.mirror[k]); };
  for (std::size_t c = 1; c <= others; ++c) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Vector<2> other(at(8 * c + j) + static_cast<double>(cluster.shift[0]),
                            at(8 * c + 4 + j) + static_cast<double>(cluster.shift[1]));
      const Vector<2> d = um * (Vector<2>(at(node), at(4 + node)) - other);
      const double s = d.squaredNorm();
      if (s == 0) continue;
      const double f = force_over_distance(law, s);
      result.force += f * d;
      result.largest += std::abs(f) * d.norm();
      const double k = std::max(0.0, (f + pair_curvature(law, s)) / s);
      result.xx += k * d.x() * d.x();
      result.xy += k * d.x() * d.y();
      result.yy += k * d.y() * d.y();
      result.stiffest += k * s;
    }
  }
  return result;
}

template <class Real>
class BlockPairLaws : public testing::Test {
 protected:
  static constexpr double tolerance = sizeof(Real) == 4 ? 2e-6 : 3e-14;
};
TYPED_TEST_SUITE(BlockPairLaws, test::Reals);

TYPED_TEST(BlockPairLaws, are_those_of_their_scalar_twins) {
  Cluster<TypeParam> cluster;
  for (const auto& [name, law] : test::contact_laws()) {
    const std::size_t form = law.index();
    for (const auto* version : test::kernel_versions<TypeParam>()) {
      cluster.run(version->stiff_pairs[form], law);
      const Cluster<TypeParam> stiff = cluster;
      for (std::size_t i = 0; i < 4; ++i) {
        const Reference wanted = plain(cluster, law, i);
        ASSERT_GT(wanted.largest, 0);
        const std::string where = std::string(name) + ", " + version->name;
        const double bound = this->tolerance * wanted.largest / um;
        EXPECT_NEAR(cluster.sum(0, i), wanted.force.x() / um, bound) << where;
        EXPECT_NEAR(cluster.sum(1, i), wanted.force.y() / um, bound) << where;
        const double stiff_bound = 3 * this->tolerance * wanted.stiffest;
        EXPECT_NEAR(cluster.sum(2, i), wanted.xx, stiff_bound) << where;
        EXPECT_NEAR(cluster.sum(3, i), wanted.xy, stiff_bound) << where;
        EXPECT_NEAR(cluster.sum(4, i), wanted.yy, stiff_bound) << where;
      }
      cluster.run(version->bounded_pairs[form], law);
      for (std::size_t i = 0; i < 4; ++i) {
        const Reference wanted = plain(cluster, law, i);
        EXPECT_NEAR(cluster.sum(2, i), 2 * wanted.stiffest, 6 * this->tolerance * wanted.stiffest);
        EXPECT_EQ(cluster.sums[0], stiff.sums[0]);
      }
      cluster.run(version->pairs[form], law);
      EXPECT_EQ(cluster.sums[0], stiff.sums[0]);
      EXPECT_EQ(cluster.sums[1], stiff.sums[1]);
      EXPECT_EQ(cluster.sum(2, 0), 0);
    }
  }
}

// Pairs at no distance at all.
TYPED_TEST(BlockPairLaws, nodes_that_coincide_have_finite_forces) {
  for (const auto& [name, law] : test::contact_laws()) {
    for (const auto* version : test::kernel_versions<TypeParam>()) {
      Cluster<TypeParam> cluster;
      for (std::size_t k = 0; k < 16; ++k) cluster.mirror[k] = static_cast<TypeParam>(0.25);
      cluster.entries.assign(others, {1, 0});
      cluster.shift[0] = cluster.shift[1] = 0;
      for (const auto kernel :
           {version->stiff_pairs[law.index()], version->bounded_pairs[law.index()]}) {
        cluster.run(kernel, law);
        for (std::size_t a = 0; a < 5; ++a) EXPECT_TRUE(std::isfinite(cluster.sum(a, 0))) << name;
      }
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
