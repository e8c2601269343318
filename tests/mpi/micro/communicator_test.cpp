#include "micro/parallel/communicator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

std::string name_of(int rank) {
  return std::string(static_cast<std::size_t>(rank) * 1000, 'x') + '\0' + 'r';
}

TEST(Communicator, gathers_strings_of_different_length_in_the_order_of_the_ranks) {
  const Communicator all(MPI_COMM_WORLD);
  const std::vector<std::string> names = all.all_gather(name_of(all.rank()));
  ASSERT_EQ(names.size(), static_cast<std::size_t>(all.size()));
  for (int rank = 0; rank < all.size(); ++rank) {
    EXPECT_EQ(names[static_cast<std::size_t>(rank)], name_of(rank));
  }
}

TEST(Communicator, gathers_empty_strings) {
  const Communicator all(MPI_COMM_WORLD);
  for (const std::string& each : all.all_gather("")) {
    EXPECT_TRUE(each.empty());
  }
}

TEST(Communicator, broadcasts_the_string_of_the_root) {
  const Communicator all(MPI_COMM_WORLD);
  EXPECT_EQ(all.broadcast("from " + std::to_string(all.rank())), "from 0");
  EXPECT_EQ(all.broadcast(all.is_root() ? "" : "not this"), "");
}

TEST(Communicator, agrees_when_nobody_failed) {
  const Communicator all(MPI_COMM_WORLD);
  EXPECT_NO_THROW(all.agree(""));
}

TEST(Communicator, a_failure_on_the_last_rank_is_the_same_failure_on_all) {
  const Communicator all(MPI_COMM_WORLD);
  const int last = all.size() - 1;
  try {
    all.agree(all.rank() == last ? "disk full" : "");
    FAIL() << "no failure on rank " << all.rank();
  } catch (const EnvironmentError& error) {
    EXPECT_EQ(error.what(), "rank " + std::to_string(last) + ": disk full");
  }
}

TEST(Communicator, lists_all_failures) {
  const Communicator all(MPI_COMM_WORLD);
  std::string expected;
  for (int rank = 0; rank < all.size(); ++rank) {
    expected += (rank == 0 ? "" : "\n") + std::string("rank ") + std::to_string(rank) +
                ": reason " + std::to_string(rank);
  }
  try {
    all.agree("reason " + std::to_string(all.rank()));
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_EQ(error.what(), expected);
  }
}

TEST(Communicator, failures_of_mpi_become_exceptions) {
  // A null communicator is an error that MPI reports on the world communicator, whose handler is
  // set to return errors for this test alone.
  MPI_Errhandler previous = MPI_ERRHANDLER_NULL;
  MPI_Comm_get_errhandler(MPI_COMM_WORLD, &previous);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  EXPECT_THROW(Communicator{MPI_COMM_NULL}, EnvironmentError);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, previous);
  MPI_Errhandler_free(&previous);
}

TEST(Communicator, moves_without_losing_its_ranks) {
  Communicator first(MPI_COMM_WORLD);
  const int size = first.size();
  const int rank = first.rank();
  Communicator second(std::move(first));
  EXPECT_EQ(second.size(), size);
  Communicator third;
  third = std::move(second);
  EXPECT_EQ(third.rank(), rank);
  EXPECT_EQ(third.all_gather("x").size(), static_cast<std::size_t>(size));
}

}  // namespace
}  // namespace hemoscale::micro

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  const int own = RUN_ALL_TESTS();
  int worst = 0;
  MPI_Allreduce(&own, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return worst;
}
