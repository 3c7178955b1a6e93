#include "config/detector_reader.h"

#include <fmt/format.h>

namespace gapscope::internal::config {
namespace {

/// `bound: auto`, a number, or {from_model: {input_limit, load_force_bound}}.
void read_bound(const Value& bound, DetectorConfig& detector) {
  detector.line = bound.line();
  if (bound.is_map()) {
    const Section from(
        Section(bound, {"from_model"}).require("from_model", "{input_limit, load_force_bound}"),
        {"input_limit", "load_force_bound"});
    detector.from_model =
        BoundKnowledge{from.require("input_limit", "the largest |u|").number({1e-12, 1e12, "unit of u"}),
                       from.require("load_force_bound", "G, a bound of the unknown forces [N m]")
                           .number({0.0, 1e12, "N m"})};
  } else if (!bound.is_text()) {
    bound.fail_expecting(
        "auto, a number [rad/s^2] or {from_model: {input_limit: ..., load_force_bound: ...}}");
  } else if (bound.text() != "auto") {
    detector.bound = bound.number({1e-9, 1e12, "rad/s^2"});
  }
}

/// `method:` agrees with the bound: `paper` and `literal` need one, the others take theirs from the data.
void require_bound_for_method(const Value& method, const DetectorConfig& detector) {
  const bool given = detector.bound || detector.from_model;
  const bool needed =
      detector.method == DetectorMethod::kPaper || detector.method == DetectorMethod::kLiteral;
  if (needed && !given)
    method.fail(fmt::format(
        "is {} without a bound, expected bound: a number [rad/s^2] or {{from_model: ...}} beside it",
        method.text()));
  if (detector.method != DetectorMethod::kAuto && !needed && given)
    method.fail(fmt::format("is {} beside a bound, expected paper, literal or bound: auto", method.text()));
}

}  // namespace

DetectorConfig read_detector(const Value& value) {
  const Section section(value, {"method", "bound", "literal"});
  DetectorConfig detector;
  detector.line = value.line();
  if (const auto bound = section.find("bound")) read_bound(*bound, detector);
  if (const auto method = section.find("method")) {
    detector.method =
        static_cast<DetectorMethod>(method->word({"auto", "impact", "lost_motion", "paper", "literal"}));
    require_bound_for_method(*method, detector);
  }
  if (const auto literal = section.find("literal"))
    detector.literal = literal->number({1e-9, 1e12, "rad/s^2"});
  return detector;
}

}  // namespace gapscope::internal::config
