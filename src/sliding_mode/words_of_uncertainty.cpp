#include <algorithm>
#include <cmath>

#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode::words {

Remark gap_uncertain(double gap, double percent, const Remark& why) {
  return Remark("gap_uncertain", "a gap of {:.2g} [rad] is seen, but only to {:.0f} %: ", {gap, percent}) +
         why;
}
Remark few_counts(double counts, double needed) {
  const long bits = std::max(1L, std::lround(std::ceil(std::log2(needed / counts))));
  return {"few_counts",
          bits == 1 ? "it is {:.0f} counts wide, and about {:.0f} are needed; {} bit more, or a triangle"
                    : "it is {:.0f} counts wide, and about {:.0f} are needed; {} bits more, or a triangle",
          {counts, needed, bits}};
}
Remark ends_uncertain() {
  return {"ends_uncertain",
          "where contact is lost and regained shows in too little; let the motion rest at its reversals "
          "(a trapezoid that pauses at zero torque), or use a finer encoder"};
}
Remark passages_differ() {
  return {"passages_differ",
          "its passages differ among each other; record more periods of one steady motion"};
}
Remark directions_differ() {
  return {"directions_differ",
          "rising and falling x1 read it differently; remove the offset of the excitation, or let the motion "
          "rest at its reversals"};
}
Remark recordings_differ() {
  return {"recordings_differ",
          "the recordings read it differently; read each by itself, and see what else differs between them"};
}
Remark samples_apart() {
  return {"samples_apart", "x1 moves far from one sample to the next at the impacts; sample faster"};
}
}  // namespace gapscope::internal::sliding_mode::words
