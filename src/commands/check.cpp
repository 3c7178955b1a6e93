#include "commands/check.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/input_facts.h"
#include "base/require.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "results/inspection_result.h"

namespace gapscope {
namespace {

/// With the unit that is declared for u; without one that is said once, where the input is told. A share has
/// none.
void tell_unit(Finding& f, const Configuration& c) {
  const InputFacts input = c.input_facts();
  const bool share = c.recording->units.input == "%";
  if (f.rule == kInputRule && input.unit.empty())
    f.found = replaced(f.found, " units of u", share ? " (1 is 100 %)" : " (no unit declared: --input-unit)");
  f.found = with_input_unit(f.found, input);
}

}  // namespace

CheckedRecording checked_recording(const Configuration& c, Purpose purpose, const std::string& told_as) {
  GAPSCOPE_REQUIRE(c.recording && !c.recording->files.empty());
  CheckedRecording checked;
  checked.inspection =
      inspect(c.recording->files.front().path, c.recording->reading_for(UnevenRows::kRefused), c.coordinates);
  const std::vector<Remark>& undeclared = c.recording->assumed;
  checked.inspection.assumed.insert(checked.inspection.assumed.begin(), undeclared.begin(), undeclared.end());
  if (!told_as.empty()) checked.inspection.file = told_as;
  judge_for_unit(c.input_facts().unit, checked.inspection);
  judge_for_encoder(c.position_quantum(), c.recording->units.position == "counts", checked.inspection);
  for (Finding& f : checked.inspection.findings) tell_unit(f, c);
  if (c.encoder.sides == EncoderSides::kLoad) judge_for_load_encoder(checked.inspection);
  if (c.model.given && c.model.structure.has_load && c.model.structure.load == LoadKind::kLocked)
    judge_for_locked_output(checked.inspection);
  judge_for(purpose, checked.inspection);
  checked.json = inspection_json(checked.inspection, resolved_reading(c));
  return checked;
}

Configuration reading_of_one(const Configuration& c, int index) {
  if (!c.recording) throw ConfigError(c.file, "has no recording: to be checked, expected one");
  std::vector<RecordedFile> all = c.recording->files;
  all.insert(all.end(), c.recording->held_out.begin(), c.recording->held_out.end());
  if (index < 0 || static_cast<std::size_t>(index) >= all.size())
    throw ConfigError(c.file,
                      fmt::format("has {} recordings, expected a number from 0 and below that instead of {}",
                                  all.size(), index));
  Configuration reading;
  reading.file = c.file;
  reading.recording = c.recording;
  reading.recording->held_out.clear(), reading.recording->simulated.clear();
  reading.recording->files = {all[static_cast<std::size_t>(index)]};
  RecordedFile& file = reading.recording->files.front();
  file.given = std::filesystem::path(file.path).filename().string();
  reading.encoder = c.encoder;
  reading.coordinates = c.coordinates;
  return reading;
}

}  // namespace gapscope
