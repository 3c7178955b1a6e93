#include "reference/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gapscope::internal::reference::words {
namespace {

constexpr double kSameChange = 0.05;  ///< relative changes that count as equal

/// "a, b and c"
std::string listed(const std::vector<std::string>& keys) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i)
    text += (i == 0 ? "" : i + 1 == keys.size() ? " and " : ", ") + keys[i];
  return text;
}

/// What is left of parameters that change together, by their relative changes along the null direction.
Remark what_is_determined(const std::vector<double>& changes) {
  const auto equal = [&](double a, double b) { return std::abs(a - b) < kSameChange * std::abs(a); };
  bool together = true;
  for (const double c : changes) together &= equal(changes[0], c);
  if (together) return {"ratio", changes.size() == 2 ? "only their ratio is" : "only their ratios are"};
  if (changes.size() == 2 && equal(changes[0], -changes[1])) return {"product", "only their product is"};
  Remark text("combination", "only a combination is (they change as");
  for (std::size_t i = 0; i < changes.size(); ++i)
    text += Remark("change", i == 0 ? " {:+.2g}" : " : {:+.2g}", {changes[i] / std::abs(changes[0])});
  return text + Remark("combination", ")");
}

std::string excitation_for_any(const std::vector<std::string>& keys) {
  for (const std::string& key : keys)
    if (key.starts_with("controller.") && key != "controller.delay") return excitation_for(key);
  for (const char* scale : {"torque_constant", "motor_inertia"})
    if (std::find(keys.begin(), keys.end(), scale) != keys.end()) return excitation_for(scale);
  std::vector<std::string> wishes;
  for (const std::string& key : keys)
    if (const std::string wish = excitation_for(key);
        std::find(wishes.begin(), wishes.end(), wish) == wishes.end())
      wishes.push_back(wish);
  return listed(wishes);
}

}  // namespace

std::string excitation_for(const std::string& key) {
  static const std::map<std::string, std::string> advice = {
      {"motor_inertia", "faster changes of the input"},
      {"torque_constant", "a known torque or a known inertia"},
      {"motor_damping", "more speed, or more passages through the gap"},
      {"mass_ratio", "fast changes of the input with the contact closed, and passages through the gap"},
      {"gap", "a motion that closes the contact on both sides"},
      {"load_damping", "more speed with the contact closed"},
      {"load_coulomb_friction", "slow reversals that move the load"},
      {"contact_stiffness", "impacts, or a larger torque in contact"},
      {"contact_damping", "harder impacts"}};
  if (key == "controller.delay") return "steps of the target, or faster updates of it";
  if (key.starts_with("controller."))
    return "a known mass on a known arm, a known inertia or a known friction torque (anchor), or the recorded input";
  const auto found = advice.find(key);
  return found == advice.end() ? "an input that brings this effect out" : found->second;
}

Remark diverges() { return {"diverges", "the simulated motion diverges from every starting point."}; }
Remark iterations_ran_out() {
  return {"iterations_ran_out", "the iterations ran out before the cost settled."};
}
Remark not_explained(double floors, double observer_hz) {
  return {
      "not_explained",
      "the model does not explain the recordings: its prediction error is {:.3g} times the encoder floor. "
      "So its numbers were fitted while the encoder corrects it (observer at {:.3g} Hz), not in a free run; "
      "their intervals hold the scatter over windows, gains and parts of the recordings, not the bias by what "
      "is missing.",
      {floors, observer_hz}};
}
Remark leaves_some(double unexplained_percent, double observer_hz) {
  return {
      "leaves_some",
      "the model leaves {:.2g} % of what the [torque] does to the motion unexplained, so its numbers were fitted "
      "while the encoder corrects it (observer at {:.3g} Hz), not in a free run; their intervals hold the scatter "
      "over windows, gains and parts of the recordings, not the bias by what is missing.",
      {unexplained_percent, observer_hz}};
}
Remark free_run_departs(double observer_hz) {
  return {
      "free_run_departs",
      "simulated on its own the model drifts off the recordings, though from row to row it predicts well: its "
      "numbers were fitted while the encoder corrects it slowly (observer at {:.3g} Hz), and hold less for what "
      "is slow.",
      {observer_hz}};
}
Remark not_random(double lag1, double quantiser) {
  return {
      "not_random",
      "what the model leaves is no larger than the encoder's step but has a pattern (lag-1 autocorrelation "
      "{:.2f}, rounding explains {:.2f}): something small is missing or another minimum is better, and the "
      "fit's intervals are too narrow for either.",
      {lag1, quantiser}};
}
Remark input_timing(const InputTiming& timing) {
  const Doubt doubt = mistimed(timing);
  return {"input_timing",
          "{}: {}; the intervals are widened by what that may move.",
          {doubt.found, doubt.advice}};
}
Remark worse_than_still(double ratio) {
  return {"worse_than_still",
          "the free run misses the motion by {:.3g} times what a motor that stood still would: look at the "
          "sign and the unit of u first (gapscope check).",
          {ratio}};
}

Remark impossible_start(const std::string& key, double start, double begun, const std::string& unit) {
  return {"impossible_start",
          "{} was to start at {:.3g} {}, which is more than this drive can have (is it in units of u, from "
          "before the torque constant was known?): the fit began at {:.3g} {} instead.",
          {key, start, RemarkUnit{unit}, begun, RemarkUnit{unit}}};
}

Remark at_bound(const std::string& key, double value, const std::string& unit) {
  if (unit == "-")
    return {
        "at_bound", "{} ended at the limit of its search, {:.4g}, which is no measured value.", {key, value}};
  return {"at_bound",
          "{} ended at the limit of its search, {:.4g} {}, which is no measured value.",
          {key, value, RemarkUnit{unit}}};
}
Remark no_trace(const std::string& key) {
  return {"no_trace", "{} leaves no trace in the recordings; it needs {}.", {key, excitation_for(key)}};
}
Remark like_initial_state(const std::string& key) {
  return {"like_initial_state", "{} cannot be separated from the initial state: not identifiable.", {key}};
}
Remark change_together(const std::vector<std::string>& keys, const std::vector<double>& changes) {
  return Remark("change_together", "{} change together without a trace: ", {listed(keys)}) +
         what_is_determined(changes) +
         Remark("excitation", " determined. Fix one of them; what would separate them is {}.",
                {excitation_for_any(keys)});
}
Remark not_determined(const std::string& key, double std, const std::string& unit,
                      const std::string& partner) {
  return {"not_determined",
          "{} is not determined by the recordings (standard error {:.2g} {}{}): it takes {}.",
          {key, std, RemarkUnit{unit}, partner.empty() ? "" : ", confounded with " + partner,
           excitation_for(key)}};
}
Remark no_information(const std::string& key) {
  return {"no_information", "{} is not determined by the recordings.", {key}};
}
Remark little_known(const std::string& key, double percent) {
  return {"little_known",
          "{} has a relative standard error of {:.2g} %; {} would determine it better.",
          {key, percent, excitation_for(key)}};
}

Remark at_the_floor(double fit_percent) {
  return {"at_the_floor",
          "The free run follows the recording to {:.4g} % and leaves what the encoder leaves.",
          {fit_percent}};
}
Remark failed_to_fit() { return {"failed", "The simulated motion diverges from every starting point."}; }
Remark leaves_unexplained(double share, double floors) {
  if (share >= 1.0)
    return {"leaves_unexplained",
            "The model predicts the motion no better than a motor that coasts without any torque (prediction "
            "error {:.3g} times the encoder's noise).",
            {floors}};
  return {
      "leaves_unexplained",
      "The model misses {:.0f} % of what the [torque] does to the motion (prediction error {:.3g} times the "
      "encoder's noise).",
      {100.0 * share, floors}};
}
Remark as_well_without_gap(double ratio) {
  return {"as_well_without_gap",
          "The recording is explained as well without a gap (with it closed the prediction error is {:.3g} "
          "times as large), which does not say that the drive has none.",
          {ratio}};
}
Remark gap_bears_little(double ratio, double floors) {
  return {
      "gap_bears_little",
      "The model misses the recording by {:.3g} times the encoder's noise, and without a gap by only {:.3g} times "
      "as much: what it lacks may pose as the gap.",
      {floors, ratio}};
}
Remark gap_differs() {
  return {"gap_differs",
          "Parts of the recording ask for different gaps: what the model reads as a gap is something else."};
}
Remark odd_coupling(const std::string& key, double value, const std::string& unit) {
  return {
      "odd_coupling",
      "It misses the recording even with {} at its bound ({:.3g} {}): the coupling stands in for something else.",
      {key, value, RemarkUnit{unit}}};
}
Remark not_settled() { return {"not_settled", "The iterations ran out before the cost settled."}; }
Remark gap_at_bound() { return {"gap_at_bound", "The gap ended at the limit of its search."}; }
Remark gap_not_determined() { return {"gap_not_determined", "The recording does not determine the gap."}; }
Remark parts_disagree() {
  return {
      "parts_disagree",
      "Values move by more than their intervals between parts of the recording or gains of the observer."};
}
Remark above_floor(double fit_percent, double floors, double unexplained_percent) {
  const Remark run =
      fit_percent > 0.0
          ? Remark("above_floor", "The free run follows the recording to {:.4g} %", {fit_percent})
          : Remark("above_floor", "The free run drifts away");
  return run +
         Remark("above_floor",
                ", and {:.2g} % of what the [torque] does to the motion is left unexplained ({:.3g} encoder "
                "floors): intervals do not hold what the missing physics may bias.",
                {unexplained_percent, floors});
}
Remark residual_patterned() {
  return {"residual_patterned",
          "The residual is within the encoder's size but not random: something small is missing."};
}
Remark pressed_by_bound(const std::vector<std::string>& keys) {
  return {"at_bound",
          "{} ended at a bound: the optimum lies beyond it, or the model lacks something.",
          {listed(keys)}};
}
Remark other_law(const std::string& law) {
  return {
      "other_law",
      "A {} explains the recording better than the model does: the gap depends on the law that is fitted.",
      {law}};
}

Remark input_mistimed(const InputTiming& timing) {
  const Doubt doubt = mistimed(timing);
  return {"input_mistimed", "Within its error, but {}: {}.", {doubt.found, doubt.advice}};
}

Doubt mistimed(const InputTiming& timing) {
  const bool early = timing.early_rows > 0.0;
  return {
      "input_timing",
      fmt::format("the motion answers to the input {:.2g} ± {:.1g} rows {} its row",
                  std::abs(timing.early_rows), timing.std_rows, early ? "before" : "after"),
      early
          ? "u changes between the rows, or its rows come too late: record at the rate of the drive's loop"
          : "the drive acts later than its log says, or u's rows come too early: record u and x1 of the same instant"};
}
Doubt patterned(const Correlation& correlation) {
  return {"not_random",
          fmt::format("what the fitted model leaves is as small as the encoder's step but not random: lag-1 "
                      "autocorrelation {:.2f}, of which the counts explain {:.2f}",
                      correlation.lag1, correlation.quantiser),
          "something small is missing, or u and x1 do not belong to the same rows"};
}

Remark another_gap(double from, double to) {
  return {"another_gap",
          "the gap is {:.3g} [rad] on one part of the recordings and {:.3g} [rad] on another: what the model "
          "reads as a gap is something else, and none is reported.",
          {from, to}};
}
Remark values_move(const Remark& where, const std::vector<ValueShift>& moved) {
  Remark text = Remark("values_move", "values move by more than noise moves them ") + where;
  for (const ValueShift& m : moved) {
    const std::string name = &m == &moved.front() ? ": {}" : ", {}";
    const bool close = std::abs(m.to - m.from) < 1e-3 * std::abs(m.from);  // alike in four digits
    const std::string number = close ? "{:.7g}" : "{:.4g}";
    text += m.unit == "rad" ? Remark("moved", name + " from " + number + " [rad] to " + number + " [rad]",
                                     {m.key, m.from, m.to})
            : m.unit.empty() || m.unit == "-"
                ? Remark("moved", name + " from " + number + " to " + number, {m.key, m.from, m.to})
                : Remark("moved", name + " from " + number + " to " + number + " {}",
                         {m.key, m.from, m.to, RemarkUnit{m.unit}});
  }
  return text + Remark("values_move", "; the intervals allow for that.");
}
Remark between_recordings(const std::string& from, const std::string& to) {
  return {"recordings", "from {} to {}", {from, to}};
}
Remark between_parts(double split) {
  return {"parts", "from the part before {:.4g} s to the part after", {split}};
}
Remark between_gains(double from_hz, double to_hz) {
  return {"gains", "when the observer is taken from {:.3g} to {:.3g} Hz", {from_hz, to_hz}};
}

}  // namespace gapscope::internal::reference::words
