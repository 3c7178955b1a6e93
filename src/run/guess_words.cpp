#include "run/guess_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace gapscope::internal::run {

std::vector<std::string> guess_warnings(const Configuration& c) {
  std::vector<std::string> warnings;
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!c.model.guessed[at] || !has_parameter(c.model.structure, i)) continue;
    const std::string key = kDriveParameters[i].key;
    const std::string number = fmt::format("{:g} {}", c.model.parameters[at].value,
                                           c.coordinates.shown_unit(kDriveParameters[i].unit));
    warnings.push_back(
        key == "torque_constant"
            ? fmt::format(
                  "torque_constant is a guess ({}): every {}, inertia, damping and stiffness in this report "
                  "scales with it; gaps, times and percentages do not.",
                  number, c.coordinates.torque_word())
            : fmt::format("{} is a guess ({}), and what is fitted beside it rests on that.", key, number));
  }
  return warnings;
}

std::string hanging_warning(const Configuration& c, double phase) {
  constexpr double kEdge = 1e-3;  // of the band: an end that the last steps of a search do not quite reach
  if (!c.anchor || !(c.anchor->mass > 0.0) || !c.anchor->hangs_at.estimate) return "";
  const double low = c.anchor->hangs_at.low, high = c.anchor->hangs_at.high, hangs = -phase;
  if (!(std::min(hangs - low, high - hangs) < kEdge * (high - low))) return "";
  return fmt::format(
      "the arm of the anchor ended at the edge of where it may hang ({:.4g} to {:.4g} rad): it hangs "
      "elsewhere, and no torque, inertia or friction here is right -> anchor: hangs_at: the position at which "
      "the arm hangs down, e.g. {{value: 3.14, estimate: true, bounds: [2.64, 3.64]}} (or a bare number).",
      low, high);
}

std::string hanging_warning(const Configuration& c, const ReferenceModel& fitted) {
  for (const ModelEffect& e : fitted.effects)
    if (e.entry->name == std::string_view("load_unbalance")) return hanging_warning(c, e.parameters[1].value);
  return "";
}

std::optional<InputFacts> known_input(const Configuration& c) {
  const InputFacts input = c.input_facts();
  return input.told() ? std::optional(input) : std::nullopt;
}

}  // namespace gapscope::internal::run
