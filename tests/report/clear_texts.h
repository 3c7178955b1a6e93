#pragma once

#include <gtest/gtest.h>

#include "report/draw_figure.h"

namespace gapscope::internal::report {

/// No text of the drawing is cut off or meets another.
inline void expect_clear_texts(const FigureData& figure, const Drawing& drawing) {
  const Box paper{0.0, 0.0, static_cast<double>(drawing.image.cols), static_cast<double>(drawing.image.rows)};
  for (std::size_t i = 0; i < drawing.texts.size(); ++i) {
    EXPECT_TRUE(paper.holds(drawing.texts[i].box)) << figure.file << ": cut off: " << drawing.texts[i].markup;
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(overlap(drawing.texts[i].box, drawing.texts[k].box))
          << figure.file << ": " << drawing.texts[i].markup << " meets " << drawing.texts[k].markup;
  }
}

}  // namespace gapscope::internal::report
