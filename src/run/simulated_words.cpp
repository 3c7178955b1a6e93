#include "run/simulated_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <sstream>

#include "base/input_file.h"
#include "run/run_pipeline.h"

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
