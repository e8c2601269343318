#include <gtest/gtest.h>

#include "tests/support/micro/block_pairs.hpp"

// Contacts by list and kernel against a plain double loop over all nodes and images.
namespace hemoscale::micro {
namespace {

using blocks::find_contacts;
using blocks::make_store;
using test::ContactForces;
using test::Periodicity;

// Those of the vessel, in micrometres: repulsion up to 0.3, attraction up to 0.5.
constexpr PairPotential law{
    .scale = 50, .rest_squared = 0.09, .cutoff_squared = 0.25, .attraction = 0.05};

struct Domain {
  const char* name;
  Periodicity periodicity;
};
const Domain domains[] = {{"none", {0, 0, 0}},
                          {"along x", {18, 0, 0}},
                          {"sliding images", {17, 15, 10.3}},
                          {"images of itself", {7.1, 6.4, 3.0}}};

double relative(const std::vector<Vector<2>>& found, const std::vector<Vector<2>>& wanted) {
  double difference = 0;
  double scale = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    difference = std::max(difference, (found[i] - wanted[i]).norm());
    scale = std::max(scale, wanted[i].norm());
  }
  return difference / scale;
}

template <class Real>
class BlockPairKernel : public testing::Test {
 protected:
  static constexpr double tolerance = sizeof(Real) == 4 ? 5e-4 : 1e-14;
  // Two kinds, the second with a last cluster that is not full; blocks with places without a cell.
  static blocks::BlockStore<Real> crowd(std::uint64_t seed) {
    const std::vector<blocks::CellKind> kinds = {{100, 5}, {37, 4}};
    const auto cells = test::random_cells(kinds, {.width = 14, .height = 12, .seed = seed});
    return make_store<Real>(kinds, cells, cells.size(), false, 0);
  }
};
TYPED_TEST_SUITE(BlockPairKernel, test::Reals);

TYPED_TEST(BlockPairKernel, gives_the_forces_of_a_plain_double_loop) {
  for (const Domain& domain : domains) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const auto store = this->crowd(seed);
      const auto list = find_contacts(store, 0, domain.periodicity, 0.65);
      const auto nodes = test::nodes_of(store, 0);
      const ContactForces wanted = test::plain_contacts(nodes, domain.periodicity, law);
      for (const auto* version : test::kernel_versions<TypeParam>()) {
        const ContactForces found = test::kernel_contacts(*version, store, 0, domain.periodicity,
                                                          list, test::kernel_pair<TypeParam>(law));
        EXPECT_LE(relative(found.force, wanted.force), this->tolerance)
            << version->name << ", " << domain.name << ", seed " << seed;
        EXPECT_LE(relative(found.diagonal, wanted.diagonal), 5 * this->tolerance) << version->name;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          EXPECT_NEAR(found.off_diagonal[i], wanted.off_diagonal[i], 5 * this->tolerance * 20);
        }
        // Without the stiffness: the same forces, to the bit.
        const ContactForces soft = test::kernel_contacts(
            *version, store, 0, domain.periodicity, list, test::kernel_pair<TypeParam>(law), false);
        EXPECT_EQ(soft.force, found.force) << version->name;
        for (const Vector<2>& k : soft.diagonal) EXPECT_EQ(k, Vector<2>(0, 0));
      }
    }
  }
}

TYPED_TEST(BlockPairKernel, obeys_the_third_law) {
  for (const Domain& domain : domains) {
    const auto store = this->crowd(4);
    const auto list = find_contacts(store, 0, domain.periodicity, 0.65);
    for (const auto* version : test::kernel_versions<TypeParam>()) {
      const ContactForces found = test::kernel_contacts(*version, store, 0, domain.periodicity,
                                                        list, test::kernel_pair<TypeParam>(law));
      Vector<2> sum = Vector<2>::Zero();
      double size = 0;
      for (const Vector<2>& f : found.force) {
        sum += f;
        size += f.norm();
      }
      EXPECT_GT(size, 0);
      EXPECT_LE(sum.norm(), (sizeof(TypeParam) == 4 ? 2e-6 : 1e-14) * size)
          << version->name << ", " << domain.name;
    }
  }
}

// The bits do not depend on the range of the list.
TYPED_TEST(BlockPairKernel, pairs_beyond_the_cutoff_add_exact_zeros) {
  for (const Domain& domain : domains) {
    const auto store = this->crowd(5);
    for (const auto* version : test::kernel_versions<TypeParam>()) {
      const auto forces = [&](double range) {
        return test::kernel_contacts(*version, store, 0, domain.periodicity,
                                     find_contacts(store, 0, domain.periodicity, range),
                                     test::kernel_pair<TypeParam>(law));
      };
      const ContactForces narrow = forces(0.501);
      const ContactForces wide = forces(1.5);
      EXPECT_EQ(narrow.force, wide.force) << version->name << ", " << domain.name;
      EXPECT_EQ(narrow.diagonal, wide.diagonal) << version->name;
      EXPECT_EQ(narrow.off_diagonal, wide.off_diagonal) << version->name;
    }
  }
}

// The places of cells in the store decide nothing: sums run in the order of their numbers.
TYPED_TEST(BlockPairKernel, the_order_of_places_changes_no_bit) {
  const std::vector<blocks::CellKind> kinds = {{100, 11}, {37, 10}};
  auto cells = test::random_cells(kinds, {.width = 14, .height = 12, .seed = 6});
  const Periodicity sliding{17, 15, 10.3};
  const auto forces = [&](const blocks::Kernels<TypeParam>& version) {
    const auto store = make_store<TypeParam>(kinds, cells, cells.size(), false, 0);
    const auto list = find_contacts(store, 0, sliding, 0.65);
    const ContactForces found =
        test::kernel_contacts(version, store, 0, sliding, list, test::kernel_pair<TypeParam>(law));
    const auto nodes = test::nodes_of(store, 0);
    std::map<std::pair<int, std::size_t>, Vector<2>> by_number;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      by_number[{store.ids[nodes[i].place], nodes[i].node}] = found.force[i];
    }
    return by_number;
  };
  for (const auto* version : test::kernel_versions<TypeParam>()) {
    const auto before = forces(*version);
    std::reverse(cells.begin(), cells.end());
    EXPECT_EQ(before, forces(*version)) << version->name;
    std::rotate(cells.begin(), cells.begin() + 4, cells.end());
    EXPECT_EQ(before, forces(*version)) << version->name;
  }
}

TEST(BlockPairEnergy, force_is_minus_the_gradient_of_the_potential) {
  const std::vector<blocks::CellKind> kinds = {{12, 3}};
  const Periodicity sliding{9, 8, 5.5};
  PairPotential wide = law;  // contacts of coarse rings
  wide.rest_squared = 1;
  wide.cutoff_squared = 2.25;
  const auto cells = test::random_cells(kinds, {.width = 9, .height = 8, .seed = 2});
  const auto store = make_store<double>(kinds, cells, cells.size(), false, 0);
  const auto list = find_contacts(store, 0, sliding, 1.6);
  const ContactForces found = test::kernel_contacts(blocks::kernels<double>(), store, 0, sliding,
                                                    list, test::kernel_pair<double>(wide));
  auto nodes = test::nodes_of(store, 0);
  const auto energy = [&] {
    double sum = 0;
    test::visit_pairs(nodes, sliding, 1.5,
                      [&](std::size_t, std::size_t, const Vector<2>& d, int, int) {
                        sum += 0.5 * wide.energy(d.squaredNorm());
                      });
    return sum;
  };
  double scale = 0;
  for (const Vector<2>& f : found.force) scale = std::max(scale, f.norm());
  ASSERT_GT(scale, 0);
  const double h = 1e-5;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      const long double here = nodes[i].x(axis);
      nodes[i].x(axis) = here + h;
      const double above = energy();
      nodes[i].x(axis) = here - h;
      const double below = energy();
      nodes[i].x(axis) = here;
      EXPECT_NEAR(found.force[i](axis), (below - above) / (2 * h), 1e-6 * scale) << "node " << i;
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
