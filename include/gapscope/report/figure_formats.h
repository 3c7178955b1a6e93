#pragma once

namespace gapscope {

/// What each figure is written as, beside its PNG.
struct FigureFormats {
  bool svg = false;  ///< <figure>.svg: drawn from lines and letters, for a journal or a slide
};

}  // namespace gapscope
