#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode::words {

Remark error_never_at_rest() {
  return {"error_never_at_rest", "e_x is never at rest: the bound is below the engaged acceleration"};
}
Remark bound_above_gap_mode() {
  return {"bound_above_gap_mode",
          "no t1: the bound is above the gap-mode acceleration, where at most the impact shows"};
}
Remark bound_below_engaged() {
  return {"bound_below_engaged",
          "no t1: with this bound e_x is away from zero before the reversal, and where contact is lost it "
          "does not bend visibly"};
}
Remark flank_late(double percent) {
  const char* const text =
      "t1 comes {:.0f} % of the passage late: the bound is close to the gap-mode acceleration";
  return {"flank_late", text, {percent}};
}
Remark passages_contradict() {
  return {"passages_contradict",
          "the passages contradict each other; record more periods of one steady motion"};
}
Remark reversals_read(double read, double half_periods, double bound) {
  return {"reversals_read", "{:.0f} of {:.0f} reversals read with L = {:.3g}", {read, half_periods, bound}};
}
Remark passages_as_printed(double read, double half_periods, double bound) {
  const char* const text = "S1 to S6 as printed with L = {:.3g}: a passage in {:.0f} of {:.0f} half periods";
  return {"passages_as_printed", text, {bound, read, half_periods}};
}
Remark paper_bound_misses(double bound, const Remark& reason) {
  const char* const text =
      "the bound of the source paper's eq. (13), one e_x with L = {:.3g} [rad/s²], would have missed the "
      "passages: ";
  return Remark("paper_bound_misses", text, {bound}) + reason;
}
Remark auto_reads() { return {"auto_reads", "; no single bound reads this recording, but auto does"}; }
Remark nothing_reads(const Remark& why_not_auto) {
  return Remark("nothing_reads", "; no single bound reads this recording, nor does auto: ") + why_not_auto;
}
Remark bound_to_try(double bound) { return {"bound_to_try", "; try L = {:.2g}", {bound}}; }
Remark bounds_to_try(double smallest, double largest) {
  return {"bounds_to_try", "; try L between {:.2g} and {:.2g}", {smallest, largest}};
}

}  // namespace gapscope::internal::sliding_mode::words
