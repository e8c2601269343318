#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::micro {
namespace {

TEST(SingleCommunicator, works_without_mpi) {
  const Communicator alone;
  EXPECT_EQ(alone.rank(), 0);
  EXPECT_EQ(alone.size(), 1);
  EXPECT_TRUE(alone.is_root());
  alone.barrier();
  EXPECT_EQ(alone.all_gather("a"), std::vector<std::string>{"a"});
  EXPECT_EQ(alone.broadcast("b"), "b");
  EXPECT_NO_THROW(alone.agree(""));
  try {
    alone.agree("no space left");
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_STREQ(error.what(), "rank 0: no space left");
  }
}

}  // namespace
}  // namespace hemoscale::micro
