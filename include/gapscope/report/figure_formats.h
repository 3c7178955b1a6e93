#pragma once

namespace gapscope {

/// What each figure is written as, beside its PNG.
struct FigureFormats {
  bool svg = false;    ///< <figure>.svg: drawn from lines and letters, for a journal or a slide
  bool title = true;   ///< its title above it; a paper has a caption of its own
  bool small = false;  ///< the PNGs at half the size and in few colours, for a page
};

}  // namespace gapscope
