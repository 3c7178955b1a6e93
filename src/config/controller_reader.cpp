#include "config/controller_reader.h"

#include <cmath>
#include <optional>

#include "config/field_reader.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

/// The controller as its block has it.
struct WrittenController {
  PositionController numbers;
  std::optional<double> saturation;

  void fields(FieldVisitor& v) {
    v.field({"gain", "unit of u per rad", "of the position error", -1e12, 1e12}, numbers.gain);
    v.field({"derivative", "unit of u s/rad", "of its slope from update to update", -1e12, 1e12},
            numbers.derivative);
    v.field({"integral", "unit of u per rad s", "of its integral, which rests at saturation", -1e12, 1e12},
            numbers.integral);
    v.field({"rate", "Hz", "of its updates; 0: one at each row", 0, 1e5}, numbers.rate);
    v.field({"delay", "s", "from the reading of the position to the change of the input", 0, 1},
            numbers.delay);
    v.field({"saturation", "unit of u", "limit of its output, either way", 1e-12, 1e12}, saturation);
    v.field({"dead_band", "rad", "error up to which it takes no action", 0, 1e6}, numbers.dead_band);
  }
};

/// @throws ConfigError for what is to be estimated: a number is needed to know the input at all
void require_given(const Value& position) {
  for (const auto& [key, value] : position.entries())
    if (value.is_map())
      value.fail(
          "is to be estimated, expected a number: where the input was not recorded, a gain cannot be told "
          "from torque_constant, nor a delay from the effect input_delay; estimate those");
}

PositionController read_position(const Value& value) {
  if (value.is_map()) require_given(value);
  WrittenController written;
  read_fields(value, written);
  written.numbers.saturation = written.saturation.value_or(kInfinity);
  return written.numbers;
}

}  // namespace

void read_controller(const Section& root, Configuration& c) {
  const auto controller = root.find("controller");
  const bool target = c.recording && !c.recording->reading.columns.target.empty();
  if (!controller && !target) return;
  if (!controller)
    throw ConfigError(
        c.file, c.recording->files.front().line,
        "recording.columns has a target, expected controller: {position: {gain: ...}} beside it, "
        "which makes the input of it");
  const Section section(*controller, {"position"});
  const PositionController position = read_position(
      section.require("position", "{gain, derivative, integral, rate, delay, saturation, dead_band}"));
  if (!target)
    controller->fail(c.recording
                         ? "stands without the target, expected recording: columns: {target: ...}"
                         : "stands beside simulation, expected it with recording: columns: {target: ...}");
  c.recording->reading.controller = position;
}

void write_controller(YamlWriter& out, const RecordingConfig& recording) {
  if (!recording.reading.controller) return;
  WrittenController written{*recording.reading.controller, {}};
  if (std::isfinite(written.numbers.saturation)) written.saturation = written.numbers.saturation;
  FieldWriter fields(out);
  out.open("controller");
  out.open("position");
  written.fields(fields);
  out.close();
  out.close();
}

Json controller_schema() {
  MapSchema controller;
  controller.add("position", fields_schema(WrittenController{}).schema("of the position that is recorded"));
  controller.required = {"position"};
  return controller.schema("of the drive's firmware: makes the input of recording: columns: target");
}

}  // namespace gapscope::internal::config
