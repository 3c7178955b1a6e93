#include "config/starter_choice.h"

#include <fmt/format.h>

#include <span>
#include <vector>

#include "base/shell_word.h"
#include "base/shown.h"
#include "gapscope/recording/recording_file.h"
#include "gapscope/sliding_mode/detector.h"
#include "inspection/reach.h"

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

namespace {

/// Which is better fitted, and what is to be said of the other one.
struct ToldOrder {
  FittingOrder order;
  std::string little;  ///< why the one that is held out judges little; empty: it does not
};

ToldOrder order_of(const RecordingConfig& config, Coordinates coordinates) {
  std::vector<MotionReach> reach;
  for (const RecordedFile& file : {config.files.front(), config.held_out.front()}) {
    const Recording r = read_recording(file.path, config.reading_of(file, UnevenRows::kStamped));
    const MotorTrace trace = r.motor_trace();
    reach.push_back(reach_of({&trace, 1}));
  }
  return {fitting_order(reach[0], reach[1], coordinates), judges_little(reach[0], reach[1])};
}

std::string command_of(const std::string& fitted, const std::string& held_out, const std::string& options) {
  constexpr std::size_t kLongest = 4000;
  return printable(fmt::format("gapscope init {} --held-out {}{}{}", shell_word(fitted), shell_word(held_out),
                               options.empty() ? "" : " ", options),
                   kLongest);
}

}  // namespace

std::string order_told(const RecordingConfig& recording, const std::string& options,
                       Coordinates coordinates) {
  const ToldOrder told = order_of(recording, coordinates);
  const std::string &fitted = recording.files.front().path, &held_out = recording.held_out.front().path;
  const std::string first = printable(fitted, 200), second = printable(held_out, 200);
  const FittingOrder& order = told.order;
  const std::string but = told.little.empty() ? "" : "; but " + second + " " + told.little;
  switch (order.fit) {
    case FittingOrder::Fit::kFirst:
      return fmt::format("{}: {} is fitted, which asks more of the drive than {} ({}){}",
                         but.empty() ? "good as it is" : "good for the fit", first, second, order.why, but);
    case FittingOrder::Fit::kSecond:
      return fmt::format(
          "better the other way round: {} asks more of the drive than {} ({}); a model is known only as "
          "far as it was fitted -> {}",
          second, first, order.why, command_of(held_out, fitted, options));
    case FittingOrder::Fit::kEither:
      break;
  }
  return fmt::format("either recording may be fitted: {}{}", order.why, but);
}

}  // namespace gapscope::internal::config
