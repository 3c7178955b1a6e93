#include "gapscope/sliding_mode/gap_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gapscope {

const char* to_string(GapVerdict verdict) {
  switch (verdict) {
    case GapVerdict::kNotRun:
      return "not_run";
    case GapVerdict::kBacklash:
      return "backlash";
    case GapVerdict::kNone:
      return "none";
    case GapVerdict::kInconclusive:
      return "inconclusive";
  }
  return "";
}

const char* to_string(GapMethod method) {
  switch (method) {
    case GapMethod::kImpact:
      return "impact";
    case GapMethod::kPaper:
      return "paper";
    case GapMethod::kLiteral:
      return "literal";
    case GapMethod::kLostMotion:
      return "lost_motion";
    case GapMethod::kReversal:
      return "reversal";
  }
  return "";
}

const char* to_string(GapQuantity quantity) {
  switch (quantity) {
    case GapQuantity::kGap:
      return "gap";
    case GapQuantity::kFirstGap:
      return "first_gap";
    case GapQuantity::kPlayAtZeroTorque:
      return "play_at_zero_torque";
  }
  return "";
}

const char* to_string(GapTrust trust) {
  constexpr const char* kWords[] = {"none", "limited", "good"};
  return kWords[static_cast<int>(trust)];
}

const char* to_string(LostMotionCause cause) {
  switch (cause) {
    case LostMotionCause::kNotRead:
      return "not_read";
    case LostMotionCause::kGap:
      return "gap";
    case LostMotionCause::kFriction:
      return "friction_and_compliance";
    case LostMotionCause::kOpen:
      return "open";
  }
  return "";
}

Interval LostMotion::range() const {
  if (levels.empty()) return {};
  const auto [low, high] =
      std::ranges::minmax_element(levels, {}, [](const LostMotionLevel& l) { return l.lost_motion; });
  return {low->lost_motion, high->lost_motion};
}

double GapEstimate::none_above() const { return std::fmin(smallest_visible_gap, lost_motion.gap_limit); }

std::string GapEstimate::brief_report() const {
  switch (verdict) {
    case GapVerdict::kBacklash:
      if (std::isnan(ci95.low))
        return fmt::format("backlash: gap {:.4g} rad, passages scatter by {:.2g} rad ({})", gap, std,
                           reason.text());
      return fmt::format("backlash: {} {:.4g} rad, 95 % interval [{:.4g}, {:.4g}] rad ({})",
                         quantity == GapQuantity::kPlayAtZeroTorque ? "play at zero torque" : "gap", gap,
                         ci95.low, ci95.high, reason.text());
    case GapVerdict::kNone:
      return fmt::format("none above {:.3g} rad ({})", none_above(), reason.text());
    case GapVerdict::kInconclusive:
      return fmt::format(
          "inconclusive: {}{}", reason.text(),
          std::isfinite(gap_at_most) ? fmt::format("; a gap is at most {:.3g} rad wide", gap_at_most) : "");
    case GapVerdict::kNotRun:
      break;
  }
  return fmt::format("not run: {}", reason.text());
}

}  // namespace gapscope
