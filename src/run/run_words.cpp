#include "run/run_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string_view>

#include "base/input_file.h"
#include "run/run_pipeline.h"

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

namespace gapscope {

bool is_made_by_simulate(const std::string& path) {
  constexpr std::size_t kLongest = 4096;  // of the first two lines: of another file they may be all there is
  std::string begin(kLongest, '\0');
  std::ifstream in = try_input_file(path);
  in.read(begin.data(), kLongest);
  std::istringstream text(begin.substr(0, static_cast<std::size_t>(in.gcount())));
  std::string header, row;
  std::getline(text, header) && std::getline(text, row);
  const std::string mode = row.substr(row.rfind(',') + 1);
  const bool told = mode == "gap" || mode == "impact" || mode == "one_body" || mode.starts_with("engagement");
  return header.starts_with("t,u,x1") && header.ends_with(",mode") && told;
}

namespace internal::run {
namespace {

std::vector<std::string> simulated_files(const RecordingConfig& recording) {
  std::vector<std::string> names;
  for (const auto* files : {&recording.files, &recording.held_out})
    for (const RecordedFile& file : *files)
      if (is_made_by_simulate(file.path)) names.push_back(file.given);
  return names;
}

/// "a.csv, b.csv were"
std::string were(const std::vector<std::string>& files) {
  return fmt::format("{} {}", fmt::join(files, ", "), files.size() > 1 ? "were" : "was");
}

/// Where no model is fitted, none agrees with itself.
std::vector<std::string> unfitted_words(const Configuration& c) {
  if (c.simulation) return {"The data are simulated; no drive was measured."};
  const std::vector<std::string> files =
      c.recording ? simulated_files(*c.recording) : std::vector<std::string>{};
  if (files.empty()) return {};
  return {were(files) + " made by `gapscope simulate`; no drive was measured."};
}

}  // namespace

std::vector<std::string> simulated_words(const Configuration& c, bool fitted) {
  if (!fitted) return unfitted_words(c);
  if (c.simulation && c.simulation->independent)
    return {
        "The data are simulated, by equations that share no code with those that are fitted here; no drive "
        "was measured."};
  if (c.simulation)
    return {
        "The data are simulated by the very equations that are fitted here: a perfect fit shows that the "
        "code agrees with itself, and nothing of a real drive."};
  if (!c.recording) return {};
  const std::vector<std::string> files = simulated_files(*c.recording);
  if (files.empty()) return {};
  return {
      fmt::format("{} made by `gapscope simulate`, with the very equations that are fitted here unless its "
                  "plant was independent: a perfect fit shows nothing of a real drive.",
                  were(files))};
}

}  // namespace internal::run
}  // namespace gapscope
