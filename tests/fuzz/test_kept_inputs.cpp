// The inputs that fuzzing begins with are taken, and what ended a reader once (ended_...) does not do so
// again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "fuzz/readers.h"
#include "support/reading.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

using Reader = int (*)(std::string_view);
const std::map<std::string, Reader> kReaders = {{"recording", testing::read_recording},
                                                {"mat", testing::read_mat},
                                                {"arrays", testing::read_arrays},
                                                {"logs", testing::read_logs},
                                                {"configuration", testing::read_configuration},
                                                {"result", testing::read_result},
                                                {"store", testing::read_store},
                                                {"stream", testing::read_stream}};

class KeptInputs : public ::testing::TestWithParam<std::string> {};

TEST_P(KeptInputs, AreReadOrRefused) {
  const Reader read = kReaders.at(GetParam());
  int inputs = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(GAPSCOPE_CORPUS) / GetParam())) {
    SCOPED_TRACE(entry.path().filename().string());
    int taken = 0;
    EXPECT_NO_THROW(taken = read(testing::text_of(entry.path())));
    EXPECT_TRUE(taken > 0 || entry.path().filename().string().starts_with("ended_"));
    ++inputs;
  }
  EXPECT_GE(inputs, 3);
}

INSTANTIATE_TEST_SUITE_P(Of, KeptInputs,
                         ::testing::Values("recording", "mat", "arrays", "logs", "configuration", "result",
                                           "store", "stream"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace gapscope
