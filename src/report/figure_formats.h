#pragma once

namespace gapscope {

/// What each figure is written as, beside its PNG.
struct FigureFormats {
  bool svg = false;    ///< <figure>.svg: drawn from lines and letters, for a journal or a slide
  bool title = true;   ///< false: for a paper, which has a caption of its own: letters of 8 pt at least
  bool small = false;  ///< the PNGs at half the size and in few colours, for a page
};

}  // namespace gapscope
