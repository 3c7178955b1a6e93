#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>

#include "gapscope/base/errors.h"
#include "gapscope/report/report.h"
#include "report/sample_run.h"
#include "results/scratch_folder.h"

namespace gapscope {
namespace {
namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void store_and_draw(const fs::path& folder, const RunResult& run) {
  write_run_result(folder.string(), run);
  write_report(folder.string());
}

TEST(Report, EveryFigureOfAFullRunIsThereAndNotBlank) {
  ScratchFolder scratch;
  store_and_draw(scratch.path, sample_run());
  const std::string text = text_of(scratch.path / "report.md");
  for (const char* name : {"overview.png", "fig2_input_and_displacement.png", "fig3_backlash_map.png",
                           "fig4_backlash_state_and_input.png", "fig5_displacement_and_error.png",
                           "fig6_one_period.png", "estimates.png", "residuals.png"}) {
    const cv::Mat image = cv::imread((scratch.path / name).string());
    EXPECT_EQ(image.cols, std::string(name) == "overview.png" ? 3200 : 1600) << name;
    EXPECT_GT(image.rows, 400) << name;
    EXPECT_NE(text.find("](" + std::string(name) + ")"), std::string::npos) << name << " is not in report.md";
    cv::Scalar centre, spread;
    cv::meanStdDev(image, centre, spread);
    EXPECT_GT(spread[0], 10.0) << name << " is blank";
  }
  EXPECT_EQ(text.find("Left out"), std::string::npos);
}

}  // namespace
}  // namespace gapscope
