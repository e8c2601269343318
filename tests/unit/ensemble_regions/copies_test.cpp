#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "micro/ensemble/blocks/cell_copies.hpp"
#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/ensemble/regions/cell_bytes.hpp"
#include "micro/ensemble/regions/copy_bytes.hpp"
#include "micro/ensemble/regions/copy_carrier.hpp"
#include "micro/ensemble/regions/exchange_interval.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/dense_channel.hpp"

namespace hemoscale::micro::regions {
namespace {

using blocks::BlockStore;
using blocks::CellRecord;

CellRecord cell_of(blocks::CellId id, int nodes) {
  CellRecord cell;
  cell.id = id;
  cell.frame = {1.0 + id, 2};
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    cell.x.push_back(3 * std::cos(angle));
    cell.y.push_back(2 * std::sin(angle));
  }
  return cell;
}

/// Three own cells and two copies, of cells with 10 nodes.
BlockStore<double> store_with_copies() {
  auto store = blocks::make_store<double>(
      {{10, 5}}, {cell_of(0, 10), cell_of(1, 10), cell_of(2, 10)}, 5, false, 0);
  blocks::set_copies(store, {{3, 0}, {4, 0}});
  return store;
}

TEST(CellCopies, lie_beyond_the_blocks_and_leave_own_cells_alone) {
  BlockStore<double> store = store_with_copies();
  EXPECT_EQ(blocks::count_copies(store), 2);
  EXPECT_EQ(blocks::count_copy_groups(store), 1);
  EXPECT_EQ(store.places(), 8);
  EXPECT_EQ(store.ids[8], 3);
  EXPECT_EQ(store.first_cluster[8], 8 * 3);
  EXPECT_EQ(store.mirror[0].size(), 8 * 3 * 10);
  EXPECT_EQ(store.mirror[0][0], cell_of(0, 10).x[0]);
  EXPECT_EQ(store.place_of_id[3], -1);
  blocks::set_copies(store, {});
  EXPECT_EQ(blocks::count_copies(store), 0);
  EXPECT_EQ(store.mirror[1].size(), 8 * 3 * 8);
}

/// The bytes of a copy: frame and nodes displaced rigidly.
std::vector<char> bytes_of(const BlockStore<double>& store, const Vector<2>& frame,
                           const Vector<2>& nodes) {
  const CellRecord cell = cell_of(3, 10);
  std::vector<double> mirror(mirror_size(store, 8), 1e5);
  for (std::size_t i = 0; i < cell.x.size(); ++i) {
    mirror[8 * (i / 4) + i % 4] = cell.x[i] + nodes.x();
    mirror[8 * (i / 4) + i % 4 + 4] = cell.y[i] + nodes.y();
  }
  std::vector<char> bytes(copy_bytes(store, 8));
  write(write(bytes.data(), frame.data(), 2), mirror.data(), mirror.size());
  return bytes;
}

/// Position of node 1 of the first copy [um].
Vector<2> node_of(const BlockStore<double>& store, std::int64_t step) {
  const auto now = static_cast<std::size_t>(step % 2);
  const double* const mirror = store.mirror[now].data() + mirror_begin(store, 8);
  return store.frames[now][8] + Vector<2>(mirror[1], mirror[5]);
}

Vector<2> carry_from_ten_to_thirteen(CopyMotion motion) {
  const SimpleShearFlow flow(10, 1e-4);
  BlockStore<double> store = store_with_copies();
  CopyCarrier<double> carrier({motion, &flow, 0, 1e-3, 5});
  carrier.begin(store);
  const auto bytes = bytes_of(store, {1, 2}, {0, 0});
  carrier.place_copy(store, 10, 8, bytes.data());
  const Vector<2> before = node_of(store, 10);
  for (std::int64_t step = 10; step < 13; ++step) carrier.carry(store, step, 0);
  return node_of(store, 13) - before;
}

TEST(CopyCarrier, frozen_copies_stay) {
  EXPECT_EQ(carry_from_ten_to_thirteen(CopyMotion::frozen), Vector<2>(0, 0));
}

TEST(CopyCarrier, nodes_follow_the_flow) {
  // u = 10/s y, 3 ms, node 1 at y = 2 + 2 sin(36 degrees).
  const double y = 2 + 2 * std::sin(2 * std::numbers::pi / 10);
  const Vector<2> moved = carry_from_ten_to_thirteen(CopyMotion::flow);
  EXPECT_NEAR(moved.x(), 0.03 * y, 1e-14);
  EXPECT_EQ(moved.y(), 0);
}

TEST(CellBytes, bring_a_cell_back_with_all_bits) {
  CellRecord cell = cell_of(7, 12);
  cell.kind = 1;
  cell.area = 1.0 / 3;
  cell.memory_x = {0.1, 0.2};
  cell.memory_y = {0.3, 0.4};
  std::string bytes;
  append_cell(bytes, cell);
  append_cell(bytes, cell_of(8, 10));
  std::vector<CellRecord> back;
  read_cells(bytes, back);
  ASSERT_EQ(back.size(), 2);
  EXPECT_EQ(back[0].id, 7);
  EXPECT_EQ(back[0].kind, 1);
  EXPECT_EQ(back[0].frame, cell.frame);
  EXPECT_EQ(back[0].x, cell.x);
  EXPECT_EQ(back[0].y, cell.y);
  EXPECT_EQ(back[0].memory_x, cell.memory_x);
  EXPECT_EQ(back[0].memory_y, cell.memory_y);
  EXPECT_EQ(back[0].area, cell.area);
  EXPECT_EQ(back[1].area, std::nullopt);
  bytes.pop_back();
  EXPECT_THROW(read_cells(bytes, back), EnvironmentError);
}

TEST(ExchangeInterval, follows_straying_and_relaxation) {
  blocks::BlockSettings s = test::dense_channel(4, 4).settings;
  s.time_step = 1e-3;
  // 8 zeta / k0 = 8 * 12 * 1.2e-3 / 60 / 0.25 = 7.7 ms; rc / 80 over shear rate times radius:
  // 0.5e-6 / 80 / (largest shear rate * 3.07e-6 m).
  const double radius = s.kinds.front().mesh.rest_perimeter / (2 * std::numbers::pi);
  const double straying = 0.5e-6 / 80 / (s.flow->largest_shear_rate() * radius);
  EXPECT_LT(straying, 7e-3);
  EXPECT_NEAR(longest_copy_age(s, CopyMotion::flow), straying, 1e-9);
  EXPECT_NEAR(longest_copy_age(s, CopyMotion::frozen), 0.5e-6 / 80 / s.flow->largest_speed(), 1e-9);
  EXPECT_EQ(exchange_interval(s, CopyMotion::frozen), 1);

  s.flow = std::make_shared<SimpleShearFlow>(1e-3, 1e-5);
  EXPECT_NEAR(longest_copy_age(s, CopyMotion::flow), 8 * 12 * 1.2e-3 / 60 / 0.25, 1e-9);
  EXPECT_EQ(exchange_interval(s, CopyMotion::flow), 7);
  s.contact = make_pair_potential(0, 0.3e-6, 0.5e-6, 0.05);
  EXPECT_EQ(exchange_interval(s, CopyMotion::flow), 1000);
}

}  // namespace
}  // namespace hemoscale::micro::regions
