#include "reference/words.h"

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
      "Values are those of an observer at {:.3g} Hz; intervals hold their scatter over windows, gains and "
      "parts of the recordings, not what the missing physics may bias. `gapscope diagnose` asks what is "
      "missing.",
      {floors, observer_hz}};
}
Remark free_run_departs(double observer_hz) {
  return {"free_run_departs",
          "the free run departs from the recordings although the predictions do not: values are those of an "
          "observer at {:.3g} Hz.",
          {observer_hz}};
}
Remark not_random(double lag1, double quantiser) {
  return {"not_random",
          "the residual is within the encoder's size but not random (lag-1 autocorrelation {:.2f}, the "
          "quantiser explains {:.2f}): something small is missing or another minimum is better, and the "
          "intervals assume neither.",
          {lag1, quantiser}};
}
Remark worse_than_still(double ratio) {
  return {"worse_than_still",
          "the free run misses the motion by {:.3g} times what a motor that stood still would: look at the "
          "sign and the unit of u first (gapscope check).",
          {ratio}};
}

Remark at_bound(const std::string& key, double value, const std::string& unit) {
  return {"at_bound", "{} ended at its bound {:.4g} {}.", {key, value, RemarkUnit{unit}}};
}
Remark no_trace(const std::string& key) {
  return {"no_trace", "{} leaves no trace in the recordings: needed is {}.", {key, excitation_for(key)}};
}
Remark like_initial_state(const std::string& key) {
  return {"like_initial_state", "{} cannot be told apart from the initial state: not identifiable.", {key}};
}
Remark change_together(const std::vector<std::string>& keys, const std::vector<double>& changes) {
  return Remark("change_together", "{} change together without a trace: ", {listed(keys)}) +
         what_is_determined(changes) +
         Remark("excitation", " determined. Fix one of them; what would tell them apart is {}.",
                {excitation_for_any(keys)});
}
Remark not_determined(const std::string& key, double std, const std::string& unit,
                      const std::string& partner) {
  return {"not_determined",
          "{} is not determined by the recordings (standard error {:.2g} {}{}): needed is {}.",
          {key, std, RemarkUnit{unit}, partner.empty() ? "" : ", confounded with " + partner,
           excitation_for(key)}};
}
Remark no_information(const std::string& key) {
  return {"no_information", "{} is not determined by the recordings.", {key}};
}
Remark little_known(const std::string& key, double percent) {
  return {"little_known",
          "{} is known to {:.2g} % only (standard error); sharper by {}.",
          {key, percent, excitation_for(key)}};
}

Remark another_gap(double from, const std::string& unit, double to) {
  return {
      "another_gap",
      "the gap is {:.3g} {} on one part of the recordings and {:.3g} on another: what the model takes for "
      "a gap is something else, and none is reported.",
      {from, RemarkUnit{unit}, to}};
}
Remark values_move(const Remark& where, const std::vector<ValueShift>& moved) {
  Remark text = Remark("values_move", "values move by more than their own intervals ") + where;
  for (const ValueShift& m : moved)
    text += Remark("moved",
                   &m == &moved.front() ? ": {} from {:.4g} to {:.4g} {}" : ", {} from {:.4g} to {:.4g} {}",
                   {m.key, m.from, m.to, RemarkUnit{m.unit}});
  return text + Remark("values_move", ".");
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
