#include <gtest/gtest.h>
#include <stdlib.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "report/rich_text.h"
#include "report/typesetter.h"

namespace gapscope::internal::report {
namespace {

using Level = TextRun::Level;

/// The smallest box around all ink.
cv::Rect ink(const Typesetter& typesetter, const std::string& markup, bool bold = false) {
  cv::Mat image(300, 1200, CV_8UC3, cv::Scalar::all(255)), grey;
  typesetter.draw(image, {100.0, 200.0}, markup, 100.0, kBlack, bold);
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return cv::boundingRect(grey < 128);
}

TEST(ParseMarkup, SetsVariablesInItalicsAndNumbersUpright) {
  const auto runs = parse_markup("error $50 × e_x$ (mrad)");
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[0].text, "error 50 × ");
  EXPECT_FALSE(runs[0].italic);
  EXPECT_EQ(runs[1].text, "e");
  EXPECT_TRUE(runs[1].italic);
  EXPECT_EQ(runs[2].text, "x");
  EXPECT_EQ(runs[2].level, Level::kSubscript);
  EXPECT_EQ(runs[3].text, " (mrad)");
  EXPECT_FALSE(runs[3].italic);
}

TEST(ParseMarkup, KnowsHatsBracesAndSuperscripts) {
  const auto runs = parse_markup("$2\\hat{β}$, $\\hat{w}_{12}$ rad$^2$");
  EXPECT_EQ(runs[1].text, "β");
  EXPECT_TRUE(runs[1].hat && runs[1].italic);
  EXPECT_EQ(runs[3].text, "w");
  EXPECT_TRUE(runs[3].hat);
  EXPECT_EQ(runs[4].text, "12");
  EXPECT_EQ(runs[4].level, Level::kSubscript);
  EXPECT_FALSE(runs[4].italic || runs[4].hat);
  EXPECT_EQ(runs.back().level, Level::kSuperscript);
  EXPECT_EQ(plain_text("$2\\hat{β}$ of $x_1$"), "2β\u0302 of x_1");
}

TEST(ParseMarkup, RefusesWhatIsNotClosed) {
  for (const char* markup : {"$x", "$x_{1$", "$x_$"})
    EXPECT_THROW(parse_markup(markup), std::logic_error) << markup;
}

TEST(Literal, KeepsEverySignOfATextFromOutside) {
  const std::string text = "cost: $5, x_1 {\\hat}";
  EXPECT_EQ(plain_text(literal(text)), text);
}

TEST(Typesetter, SubscriptsAreSmallerAndLower) {
  const Typesetter typesetter;
  const auto placed = typesetter.place("$x_1$", 100.0);
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_GT(placed[1].y, 0.0) << "y points downwards";
  EXPECT_LT(placed[1].size, placed[0].size);
  EXPECT_DOUBLE_EQ(placed[1].x, placed[0].width);
  const cv::Rect base = ink(typesetter, "$x$"), both = ink(typesetter, "$x_1$");
  EXPECT_GT(both.br().y, base.br().y + 10) << "the ink itself hangs below the baseline";
  EXPECT_GT(both.br().x, base.br().x + 20);
}

TEST(Typesetter, HatsStandClearOverTheirLetter) {
  const Typesetter typesetter;
  for (const std::string letter : {"β", "w", "x"}) {
    const cv::Rect plain = ink(typesetter, "$" + letter + "$");
    const cv::Rect hatted = ink(typesetter, "$\\hat{" + letter + "}$");
    EXPECT_LT(hatted.y, plain.y - 8) << letter;
    EXPECT_EQ(hatted.br().y, plain.br().y) << letter;
  }
}

TEST(Typesetter, MeasuresWhatItDraws) {
  // Side bearings and rounding to whole pixels: a few hundredths of the em of 100 px.
  const Typesetter typesetter;
  for (const char* markup : {"slip (mrad)", "$2\\hat{β} = 18.7$ mrad", "$x_1 − x_2$", "$N e_x$"}) {
    const TextMetrics metrics = typesetter.measure(markup, 100.0);
    const cv::Rect box = ink(typesetter, markup);
    EXPECT_NEAR(box.br().x - 100.0, metrics.width, 12.0) << markup;
    EXPECT_LE(200.0 - box.y, metrics.ascent + 1.0) << markup;
    EXPECT_LE(box.br().y - 200.0, metrics.descent + 1.0) << markup;
  }
}

TEST(Typesetter, BlanksHaveWidth) {
  const Typesetter typesetter;
  EXPECT_GT(typesetter.measure("a b", 100.0).width, typesetter.measure("ab", 100.0).width + 20.0);
}

TEST(FontFolder, SaysWhatToDoWithoutFonts) {
  setenv("GAPSCOPE_FONTS", "/nowhere", 1);
  try {
    font_folder();
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("GAPSCOPE_FONTS"), std::string::npos);
  }
  unsetenv("GAPSCOPE_FONTS");
}

}  // namespace
}  // namespace gapscope::internal::report
