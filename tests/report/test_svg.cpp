// Figures as SVG, and the resolution that a PNG tells.
#include <gtest/gtest.h>
#include <png.h>

#include <opencv2/core.hpp>
#include <regex>
#include <set>

#include "report/draw_figure.h"
#include "report/png_bytes.h"
#include "report/rich_text.h"
#include "support/reading.h"

namespace gapscope::internal::report {
namespace {

FigureData marked_figure() {
  FigureData figure;
  figure.file = "f.png";
  figure.title = "Gap $2\\hat{β}$ & <more>";
  figure.reading = "One \"line\".";
  Panel panel;
  panel.title = "Panel";
  panel.x = {"time $t$", "s", {0.0, 1.0}, {}, {}};
  panel.y = {"angle $x_1$", "rad", {-1.0, 1.0}, {}, {}};
  for (const Marker marker : {Marker::kNone, Marker::kDisc, Marker::kCircle, Marker::kTriangleUp,
                              Marker::kTriangleDown, Marker::kCross}) {
    Series s{"series $x_1$", {kBlue, 4.0, {16, 9}}, {0.1, 0.5, 3.0}, {0.5, -0.5, 0.0}};
    s.marker = marker;
    panel.series.push_back(s);
  }
  panel.x_bands.push_back({{0.2, 0.4}, kGapShade, "band"});
  panel.dimensions.push_back({{-0.5, 0.5}, "width"});
  figure.panels.push_back(panel);
  return figure;
}

/// Every element that is opened is closed in its turn.
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  const std::regex tag(R"rx(<(/?)([A-Za-z]+)([^<>]*?)(/?)>)rx");
  const std::size_t begin = xml.find("?>");
  for (auto m = std::sregex_iterator(xml.begin() + static_cast<long>(begin) + 2, xml.end(), tag);
       m != std::sregex_iterator(); ++m) {
    if ((*m)[1].length() > 0) {
      if (open.empty() || open.back() != (*m)[2]) return false;
      open.pop_back();
    } else if ((*m)[4].length() == 0) {
      open.push_back((*m)[2]);
    }
  }
  return open.empty();
}

TEST(Svg, HoldsItsTextAsText) {
  const std::string svg = draw_as_svg(marked_figure());
  EXPECT_TRUE(is_well_formed(svg));
  EXPECT_NE(svg.find("<title>Gap 2β̂ &amp; &lt;more&gt;</title>"), std::string::npos);
  EXPECT_NE(svg.find("<desc>One &quot;line&quot;.</desc>"), std::string::npos);
  EXPECT_NE(svg.find(">time </text>"), std::string::npos);
  EXPECT_NE(svg.find(">width</text>"), std::string::npos);
  EXPECT_NE(svg.find("font-style=\"oblique\""), std::string::npos) << "variables lean";
}

TEST(Svg, IsOfTheSizeOfThePaper) {
  const std::string svg = draw_as_svg(marked_figure());
  EXPECT_NE(svg.find("width=\"8.5cm\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_NE(svg.find("viewBox=\"0 0 1600 "), std::string::npos);
}

TEST(Svg, ClipsWhatLeavesTheFrame) {
  const std::string svg = draw_as_svg(marked_figure());
  const std::regex used(R"rx(url\(#(frame\d+)\))rx"), defined(R"rx(clipPath id="(frame\d+)")rx");
  std::set<std::string> uses, definitions;
  for (auto m = std::sregex_iterator(svg.begin(), svg.end(), used); m != std::sregex_iterator(); ++m)
    uses.insert((*m)[1]);
  for (auto m = std::sregex_iterator(svg.begin(), svg.end(), defined); m != std::sregex_iterator(); ++m)
    definitions.insert((*m)[1]);
  EXPECT_FALSE(uses.empty());
  EXPECT_EQ(uses, definitions);
}

cv::Mat read_back(const std::string& bytes) {
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&read, bytes.data(), bytes.size()), 0) << read.message;
  read.format = PNG_FORMAT_BGR;
  cv::Mat pixels(static_cast<int>(read.height), static_cast<int>(read.width), CV_8UC3);
  EXPECT_NE(png_image_finish_read(&read, nullptr, pixels.data, 0, nullptr), 0) << read.message;
  return pixels;
}

/// 16 levels of each primary colour: a pixel is off by half a step of 17 at most, white and black by nothing.
/// Where that makes more colours than a list has, six: half a step of 51.
TEST(Png, PackedTightlyKeepsItsColoursToHalfAStep) {
  cv::Mat image(20, 60, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int x = 0; x < 60; ++x) image.col(x).rowRange(5, 15) = cv::Scalar(4 * x, 200, 255 - 4 * x);
  const cv::Mat few = read_back(png_bytes("f.png", image, 18823.5, true));
  ASSERT_EQ(few.size(), image.size());
  EXPECT_LE(cv::norm(few, image, cv::NORM_INF), 8.0);
  EXPECT_EQ(few.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 255, 255));
  cv::Mat many(64, 64, CV_8UC3);  // of more colours than a list has
  for (int i = 0; i < 64 * 64; ++i)
    many.at<cv::Vec3b>(i / 64, i % 64) = cv::Vec3i(4 * (i % 64), 4 * (i / 64), i % 251);
  const std::string tight = png_bytes("f.png", many, 18823.5, true);
  EXPECT_LE(cv::norm(read_back(tight), many, cv::NORM_INF), 25.0);
  EXPECT_LT(tight.size(), png_bytes("f.png", many, 18823.5).size() / 2);
}

TEST(Png, TellsItsResolutionAndStaysReadable) {
  const cv::Mat image(30, 40, CV_8UC3, cv::Scalar(10, 20, 30));
  const std::string bytes = png_bytes("f.png", image, 18823.5);
  // ISO/IEC 15948, 11.3.5.3: pixels per unit x and y, the metre; its code as zlib's crc32 has it.
  const std::string expected =
      std::string("\0\0\0\x09pHYs\0\0\x49\x88\0\0\x49\x88\x01", 17) + "\x45\x04\x14\xb7";
  EXPECT_EQ(bytes.substr(33, 21), expected);
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&read, bytes.data(), bytes.size()), 0) << read.message;
  read.format = PNG_FORMAT_BGR;
  cv::Mat pixels(static_cast<int>(read.height), static_cast<int>(read.width), CV_8UC3);
  ASSERT_NE(png_image_finish_read(&read, nullptr, pixels.data, 0, nullptr), 0) << read.message;
  EXPECT_EQ(read.warning_or_error, 0u) << read.message;
  ASSERT_EQ(pixels.size(), image.size());
  EXPECT_EQ(cv::norm(pixels, image, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace gapscope::internal::report
