#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <vector>

#include "base/run_apart.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

TEST(RunApart, ReturnsWhatTheWorkReturns) {
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  EXPECT_EQ(run_apart([&] { return large; }), large);
  EXPECT_EQ(run_apart([] { return std::string("a\0b", 3); }), std::string("a\0b", 3));
  EXPECT_EQ(run_apart([] { return std::string(); }), "");
}

TEST(RunApart, OutlivesTheEndOfTheWork) {
  EXPECT_EQ(run_apart([]() -> std::string { throw std::logic_error("no answer"); }), std::nullopt);
  EXPECT_EQ(run_apart([]() -> std::string { std::abort(); }), std::nullopt);
  EXPECT_THROW(run_apart([]() -> std::string { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THROW(run_apart([] { return std::raise(SIGKILL), std::string("not reached"); }), MachineError)
      << "by somebody else: that says nothing of the work";
}

TEST(RunApart, HasSoMuchMemoryAndNoMore) {
  bool refused = false;
  try {
    refused = !run_apart([] { return std::string(1, std::vector<char>(std::size_t{3} << 30, 'x').back()); });
  } catch (const std::bad_alloc&) {
    refused = true;
  }
  EXPECT_TRUE(refused) << "three GiB beyond what there is here";
}

TEST(RunApart, ChangesNothingHere) {
  int value = 1;
  EXPECT_EQ(run_apart([&] { return value = 2, std::to_string(value); }), "2");
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace gapscope
