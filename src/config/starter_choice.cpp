#include "config/starter_choice.h"

#include <span>

#include "base/shown.h"
#include "gapscope/sliding_mode/detector.h"

namespace gapscope::internal::config {
namespace {

/// What the detector saw decides: a locked output is one whose position is a loop over the input.
StarterChoice as_seen(std::span<const MotorTrace> traces, Coordinates coordinates) {
  const GapEstimate g = detect_gap(traces);
  if (g.method == GapMethod::kLostMotion)
    return {StarterModel::kLocked,
            "GUESS: locked output; x1 follows u in a loop, as that of a held output does and that of a load "
            "whose friction uses up nearly the whole torque",
            false};
  if (g.verdict == GapVerdict::kNone)
    return {StarterModel::kOneBody,
            "one body: a gap above " + coordinates.thousandths(g.none_above()) + " would have shown"};
  if (g.verdict == GapVerdict::kBacklash)
    return {StarterModel::kGap,
            "gap and free load: the detector reads a gap of " + coordinates.thousandths(g.gap)};
  if (g.reason.code() == "only_large_gaps" || g.reason.code() == "held_closed")
    return {StarterModel::kOneBody, "GUESS: one body; no impact shows, but " + g.reason.text(coordinates),
            false};
  return {StarterModel::kGap,
          "GUESS: gap and free load; the detector is inconclusive (" + g.reason.text(coordinates) + ")",
          false};
}

}  // namespace

StarterChoice chosen_structure(StarterModel model, std::span<const MotorTrace> traces, EncoderSide encoder,
                               Coordinates coordinates) {
  switch (model) {
    case StarterModel::kAsSeen:
      if (encoder == EncoderSide::kLoad)
        return {StarterModel::kOneBody,
                "GUESS: one body; whether there is a gap an encoder on the load cannot show without a model",
                false};
      return as_seen(traces, coordinates);
    case StarterModel::kGap:
      return {model, "gap and free load, as asked for"};
    case StarterModel::kLocked:
      return {model, "locked output, as asked for"};
    case StarterModel::kOneBody:
      return {model, "one body, as asked for"};
  }
  return {};
}

StarterChoice as_modelled(const JointNumbers& n, std::span<const MotorTrace> traces, EncoderSide encoder,
                          Coordinates coordinates) {
  const std::string where = "joint " + printable(n.joint, 40) + " of " + printable(n.model, 80);
  if (n.gap > 0.0 && n.locked) return {StarterModel::kLocked, "locked output, as " + where + " has it"};
  if (n.gap > 0.0) return {StarterModel::kGap, "gap and free load, as " + where + " has them"};
  if (encoder == EncoderSide::kLoad) return {StarterModel::kOneBody, "one body, as " + where + " has it"};
  StarterChoice seen = as_seen(traces, coordinates);
  if (!seen.seen || seen.structure == StarterModel::kOneBody)
    return {StarterModel::kOneBody, "one body, as " + where + " has it"};
  seen.why += "; " + where + " knows of none";
  return seen;
}

}  // namespace gapscope::internal::config
