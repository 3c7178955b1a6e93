#include "report/refitted_table.h"

#include <fmt/format.h>

#include "report/diagnosis_words.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

std::string refitted_row(const RefittedNumber& n, Coordinates coordinates) {
  const Coordinates own = n.key.ends_with("phase_rad") ? Coordinates() : coordinates;  // along a slide, too
  const std::string unit = own.shown_unit(n.unit);
  return fmt::format("| `{}` | {} | {} | {} |\n", n.key, quantity_beside(n.configured, n.fitted, unit),
                     beside_interval(n.fitted, n.ci95, unit), interval_text(n.ci95, unit));
}

}  // namespace

std::string refitted_table(const DiagnosisResult& r) {
  std::string rows;
  for (const RefittedNumber& n : r.diagnosis.refitted)
    if (rounded(n.configured) != rounded(n.fitted)) rows += refitted_row(n, r.coordinates);
  if (rows.empty()) return "";
  return fmt::format(
      "\n## Numbers of your model\n\nEstimated numbers whose interval leaves out what the configuration "
      "starts at, where three digits show that: a number that the recordings contradict, or no more than a "
      "first guess. The intervals hold for the model {}; `fitted.yaml` has the fitted ones.\n\n"
      "| number | the configuration starts at | fitted | 95 % |\n|---|---|---|---|\n{}",
      added(r) ? with_added(r) : std::string("as it is"), rows);
}

}  // namespace gapscope::internal::report
