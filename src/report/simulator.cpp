#include "report/simulator.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/decimals.h"
#include "base/text.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

LineStyle simulator_style() { return {kVermillion, 4.0, {}}; }

/// "20.0 ± 0.4 mN·m", with the name of the number where a row has several.
std::string side_number(const DiagnosisResult& r, const ComparedNumber& n, bool drive, bool named) {
  const double number = drive ? n.drive : n.simulator;
  const Interval& ci95 = drive ? n.drive_ci95 : n.simulator_ci95;
  if (!r.coordinates.rotational() && n.key == "periods_per_turn") {
    const auto period = [](double cycles) { return 2.0 * kPi / cycles; };
    return "period " + plus_minus(period(number), {period(ci95.high), period(ci95.low)}, "m");
  }
  const bool phase = n.key.find("phase") != std::string::npos;  // an angle along a slide, too
  const std::string unit = (phase ? Coordinates() : r.coordinates).shown_unit(n.unit);
  const std::string value = plus_minus(number, ci95, unit);
  return named ? name_of_key(n.key) + " " + value : value;
}

/// Of an effect that a side has not: whether the number says how much there may be of it.
bool leaves_some(const SimulatorRow& row, const ComparedNumber& n, bool drive) {
  const bool exact = says_none(row, n, drive ? n.drive : n.simulator);
  return says_how_much(row, n) && !(exact && std::isnan((drive ? n.drive_ci95 : n.simulator_ci95).low));
}

std::string side_text(const DiagnosisResult& r, const SimulatorRow& row, bool drive) {
  const bool absent =
      row.found_in == FoundIn::kNeither || row.found_in == (drive ? FoundIn::kSimulator : FoundIn::kDrive);
  std::vector<std::string> parts;
  for (const ComparedNumber& n : row.numbers)
    if (!absent || leaves_some(row, n, drive))
      parts.push_back(side_number(r, n, drive, row.numbers.size() > 1));
  return (absent ? parts.empty() ? "none" : "none: " : "") + fmt::format("{}", fmt::join(parts, ", "));
}

/// Whether the interval of what says how much there is of it leaves zero out.
bool is_more_than_none(const SimulatorRow& row, bool drive) {
  if (!row.is_effect || row.numbers.empty()) return false;
  const Interval& ci95 = drive ? row.numbers.front().drive_ci95 : row.numbers.front().simulator_ci95;
  return ci95.low > 0.0 || ci95.high < 0.0;
}

const char* found_words(const SimulatorRow& row) {
  if (row.differs && row.found_in == FoundIn::kDrive) return "only in the drive";
  if (row.differs && row.found_in == FoundIn::kSimulator) return "only in the simulator";
  if (row.differs) return "in both, with other amounts";
  if (row.found_in == FoundIn::kNeither) return "in neither";
  // Where the other recording hardly moves with it, its amount alone tells a side that has it.
  if (row.found_in == FoundIn::kDrive && is_more_than_none(row, true))
    return "probably only in the drive: its amount is clear of zero, the motion that it makes is not clear "
           "of what the model leaves";
  if (row.found_in == FoundIn::kSimulator && is_more_than_none(row, false))
    return "probably only in the simulator: its amount is clear of zero, the motion that it makes is not "
           "clear of what the model leaves";
  return "not separated";
}

std::string row_size(const DiagnosisResult& r, const SimulatorRow& row) {
  if (!(row.floors > 0.01)) return "–";
  return quantity(row.size, r.coordinates.position_unit());
}

/// "68 %"; no minus before a zero.
std::string shrink_percent(double share) { return with_decimals(100.0 * share, 0) + " %"; }

std::string rows_table(const DiagnosisResult& r, const SimulatorComparison& c) {
  std::string text =
      "\n| | in the drive | in the simulator | | size | error shrinks by, if mended alone |\n"
      "|---|---|---|---|---|---|\n";
  for (const SimulatorRow& row : c.rows)
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.name, side_text(r, row, true),
                        side_text(r, row, false), found_words(row), row_size(r, row),
                        row.differs ? shrink_percent(row.shrink) : "–");
  return text;
}

std::string errors_text(const DiagnosisResult& r, const SimulatorComparison& c) {
  const std::string unit = r.coordinates.position_unit();
  std::string text = fmt::format(
      "\nOver the held-out input your simulator is {} rms off the drive. It cannot be run here, so the model "
      "fitted to its recording represents it: that one is {} off the drive and misses your simulator by {}, "
      "which is what the last column is worth.",
      quantity(c.errors.simulator, unit), quantity(c.errors.stand_in, unit),
      quantity(c.errors.stand_in_miss, unit));
  if (std::isfinite(c.errors.mended))
    text += fmt::format(" With all that differ mended it is {} off, with `{}` alone {}.",
                        quantity(c.errors.all_mended, unit), c.rows.front().name,
                        quantity(c.errors.mended, unit));
  return text + "\n";
}

Series simulator_line(const std::string& label, const LineStyle& style, const SimulatorTrace& t,
                      const std::vector<double>& values) {
  Series s{label, style};
  for (std::size_t i = t.scored_from; i < values.size(); ++i)
    s.x.push_back(t.time(i)), s.y.push_back(values[i]);
  return s;
}

std::vector<double> off_by(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(std::min(a.size(), b.size()));
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

Panel simulator_panel(const DiagnosisResult& r, const SimulatorTrace& t, const std::string& title,
                      const std::string& name) {
  return {title,
          {"time $t$", "s", {t.time(t.scored_from), t.time(t.x1.size() - 1)}},
          {name, r.coordinates.position_unit()},
          420.0};
}

}  // namespace

FigureData diagnosis_simulator(const DiagnosisResult& r) {
  FigureData figure{"diagnosis_simulator.png", "Drive, your simulator and the fitted model"};
  if (!r.simulated || r.simulated->traces.empty())
    return missing_figure(figure, "no simulator was given", false);
  const SimulatorTrace& t = r.simulated->traces.front();
  Panel motion = simulator_panel(r, t, "Held-out input", "displacement $x_1$");
  motion.series.push_back(simulator_line("drive", measured_style(), t, t.x1));
  motion.series.push_back(simulator_line("your simulator", simulator_style(), t, t.simulator));
  if (!t.fitted.empty())
    motion.series.push_back(simulator_line("model fitted to the drive", reference_style(), t, t.fitted));
  motion.x_labels = false;
  Panel errors = simulator_panel(r, t, "Difference from the drive", "$x_1$ − drive");
  errors.series.push_back(simulator_line("your simulator", simulator_style(), t, off_by(t.simulator, t.x1)));
  if (!t.fitted.empty())
    errors.series.push_back(
        simulator_line("model fitted to the drive", reference_style(), t, off_by(t.fitted, t.x1)));
  figure.panels = {std::move(motion), std::move(errors)};
  const std::string unit = r.coordinates.position_unit();
  figure.reading = fmt::format("On {} your simulator is {} rms off the drive.", t.file,
                               quantity(r.simulated->errors.simulator, unit));
  return figure;
}

std::string simulator_table(const DiagnosisResult& r) {
  if (!r.simulated) return "";
  const SimulatorComparison& c = *r.simulated;
  std::string text = "\n## Your simulator beside the drive\n\n**" + c.sentence + "**\n";
  if (c.rows.empty()) return text;
  const auto differing =
      std::count_if(c.rows.begin(), c.rows.end(), [](const SimulatorRow& row) { return row.differs; });
  if (differing > 1 && std::isfinite(c.errors.all_mended))
    text += fmt::format("\nAll {} that differ mended: {} to {}.\n", differing,
                        quantity(c.errors.stand_in, r.coordinates.position_unit()),
                        quantity(c.errors.all_mended, r.coordinates.position_unit()));
  text += rows_table(r, c) + errors_text(r, c);
  text += fmt::format(
      "\nOne model with the effects of both was fitted to both, ± is 95 %. *Size* is the motion that neither "
      "recording adopts of the other's numbers, everything else refitted; a row counts where it is more than "
      "twice what the model leaves on that recording anyway, and than twice the floor of {}.\n",
      quantity(c.floor, r.coordinates.position_unit()));
  for (const std::string& warning : c.warnings) text += "\n- " + warning;
  return c.warnings.empty() ? text : text + "\n";
}

}  // namespace gapscope::internal::report
