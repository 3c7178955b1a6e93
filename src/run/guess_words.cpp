#include "run/guess_words.h"

#include <fmt/format.h>

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

std::optional<InputFacts> known_input(const Configuration& c) {
  const InputFacts input = c.input_facts();
  return input.told() ? std::optional(input) : std::nullopt;
}

}  // namespace gapscope::internal::run
