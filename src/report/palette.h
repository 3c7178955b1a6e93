#pragma once

#include <vector>

namespace gapscope::internal::report {

struct Colour {
  int red = 0, green = 0, blue = 0;
};

/// How a line looks on white paper. Every meaning has a colour of the Okabe–Ito set, which the colour-blind
/// tell apart, and a dash pattern of its own, which a grey print keeps.
struct LineStyle {
  Colour colour;
  double width = 4.0;            ///< [px]; 4 px are 0.6 pt in a column of 8.5 cm
  std::vector<double> dashes{};  ///< on, off, on, ... [px]; empty: solid
};

inline constexpr Colour kBlack{0, 0, 0};
inline constexpr Colour kInk{40, 40, 40};
inline constexpr Colour kFrame{90, 90, 90};
inline constexpr Colour kGrid{226, 226, 226};
inline constexpr Colour kFaint{190, 190, 190};  ///< single samples behind what is made of them
inline constexpr Colour kGrey{130, 130, 130};
inline constexpr Colour kVermillion{213, 94, 0};
inline constexpr Colour kBlue{0, 114, 178};
inline constexpr Colour kGreen{0, 158, 115};
inline constexpr Colour kPurple{170, 68, 153};
inline constexpr Colour kGapShade{255, 236, 200};   ///< behind the gap mode
inline constexpr Colour kBandShade{222, 233, 242};  ///< a 95 % band

// One meaning, one look, in every figure.
inline LineStyle measured_style() { return {kBlack, 4.5, {}}; }
inline LineStyle truth_style() { return {kGrey, 5.0, {26, 10}}; }
inline LineStyle model_free_style() { return {kVermillion, 4.5, {}}; }
inline LineStyle literal_style() { return {kPurple, 4.5, {6, 7}}; }
inline LineStyle reference_style() { return {kBlue, 4.5, {16, 9}}; }
inline LineStyle input_style() { return {kGreen, 4.5, {}}; }
inline LineStyle guide_style() { return {kFrame, 2.5, {4, 8}}; }
inline LineStyle begin_style() { return {kVermillion, 3.0, {14, 8}}; }  ///< of a passage through the gap
inline LineStyle end_style() { return {kVermillion, 3.0, {}}; }

}  // namespace gapscope::internal::report
