#include "micro/linear/choose_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

std::string chosen(const ModelSystem<2>& system, const SystemTraits& traits,
                   LinearSolverKind kind = LinearSolverKind::automatic) {
  const Communicator alone;
  return make_solver(kind, *system.matrix.pattern, system.layout(), traits, {}, alone)->describe();
}

SystemTraits symmetric() {
  return {1, true, {}};
}
SystemTraits general() {
  return {1, false, {}};
}

TEST(ChooseSolver, takes_a_band_while_it_is_narrow) {
  const auto narrow = particle_laplacian<2>({80, 10}, ChannelEnds::outlet, 0.2, 1);
  EXPECT_THAT(chosen(narrow, symmetric()), StartsWith("banded Cholesky"));
  EXPECT_THAT(chosen(narrow, general()), StartsWith("banded LU"));
}

TEST(ChooseSolver, iterates_where_the_band_is_wide) {
  const auto wide = particle_laplacian<2>({60, 60}, ChannelEnds::outlet, 0.2, 1);
  EXPECT_THAT(chosen(wide, symmetric()), StartsWith("conjugate gradients with multigrid"));
  EXPECT_THAT(chosen(wide, general()), StartsWith("GMRES with multigrid"));
}

TEST(ChooseSolver, does_not_iterate_on_coupled_systems) {
  SparsePattern pattern;
  pattern.global_rows = 900000;
  pattern.first.assign(pattern.global_rows + 1, 0);
  const SystemTraits coupled{3, false, {}};
  EXPECT_EQ(choose_kind(pattern, coupled, 900), LinearSolverKind::banded);
  EXPECT_EQ(choose_kind(pattern, coupled, 9000), LinearSolverKind::sparse_direct);
  EXPECT_EQ(choose_kind(pattern, general(), 900), LinearSolverKind::aggregate);
}

TEST(ChooseSolver, takes_hypre_where_rows_are_spread) {
  SparsePattern part;
  part.global_rows = 10;
  part.first.assign(6, 0);
  EXPECT_EQ(choose_kind(part, symmetric(), 3), LinearSolverKind::hypre);
}

TEST(ChooseSolver, obeys_an_explicit_choice) {
  const auto system = particle_laplacian<2>({80, 10}, ChannelEnds::outlet, 0.2, 1);
  EXPECT_THAT(chosen(system, symmetric(), LinearSolverKind::banded), StartsWith("banded"));
  EXPECT_THAT(chosen(system, symmetric(), LinearSolverKind::sparse_direct),
              StartsWith("sparse LDL^T"));
  EXPECT_THAT(chosen(system, general(), LinearSolverKind::sparse_direct), StartsWith("sparse LU"));
  EXPECT_THAT(chosen(system, symmetric(), LinearSolverKind::aggregate),
              HasSubstr("multigrid on lattices"));
}

TEST(ChooseSolver, refuses_a_choice_that_does_not_fit) {
  const auto system = particle_laplacian<2>({80, 10}, ChannelEnds::outlet, 0.2, 1);
  const SystemTraits coupled{2, false, {}};
  EXPECT_THAT([&] { chosen(system, coupled, LinearSolverKind::aggregate); },
              ThrowsMessage<ParameterError>(HasSubstr("use banded or sparse_direct")));
  ModelSystem<2> part = system;
  auto pattern = std::make_shared<SparsePattern>(*system.matrix.pattern);
  pattern->global_rows += 1;
  part.matrix.pattern = pattern;
  EXPECT_THAT([&] { chosen(part, symmetric(), LinearSolverKind::banded); },
              ThrowsMessage<ParameterError>(HasSubstr("hypre alone")));
}

TEST(ChooseSolver, hypre_says_that_it_needs_mpi) {
  const auto system = particle_laplacian<2>({80, 10}, ChannelEnds::outlet, 0.2, 1);
  EXPECT_THAT([&] { chosen(system, symmetric(), LinearSolverKind::hypre); },
              ThrowsMessage<EnvironmentError>(HasSubstr("not initialised")));
}

TEST(ChooseSolver, every_kind_has_a_name) {
  EXPECT_EQ(name_of(LinearSolverKind::automatic), "automatic");
  EXPECT_EQ(name_of(LinearSolverKind::banded), "banded");
  EXPECT_EQ(name_of(LinearSolverKind::sparse_direct), "sparse_direct");
  EXPECT_EQ(name_of(LinearSolverKind::aggregate), "aggregate");
  EXPECT_EQ(name_of(LinearSolverKind::hypre), "hypre");
}

}  // namespace
}  // namespace hemoscale::micro
