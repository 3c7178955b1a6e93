#include "gapscope/reference/fit_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gapscope {
namespace {

const char* to_string(FitStatus status) {
  switch (status) {
    case FitStatus::kNotRun:
      return "not run";
    case FitStatus::kConverged:
      return "converged";
    case FitStatus::kNotConverged:
      return "not converged";
    case FitStatus::kFailed:
      return "failed";
  }
  return "";
}

constexpr double kBeyondChance = 2.5;  ///< standard errors
/// Every second row, the least that is known to come about, is a quarter of a row early; what is less is held
/// by the intervals alone.
constexpr double kLeastToldRows = 0.1;
/// Spread of when u may act within its row: from at its beginning to a line between rows, which is half a row
/// early; every second row is a quarter early. It matters where the recordings leave the timing open by more:
/// there the share of it in an interval goes with it. Set by these causes, not by counting; half and double
/// make the gap's interval of `study_rows 3001 3003 FOLDER run` up to 32 % narrower and 63 % wider in one of
/// three drives, as recorded and every second row, change the two others by 3 % at most, and neither misses.
constexpr double kWithinRow = 0.25;

std::string number(double v) { return std::isnan(v) ? "-" : fmt::format("{:.6g}", v); }

std::string test_text(const char* what, const ResidualTest& t) {
  return fmt::format("correlated {} at {} % of the lags (chance: 5 %)", what, number(100.0 * t.outside));
}

std::string note(const FittedParameter& p) {
  if (!p.estimated) return "fixed";
  if (!p.identifiable) return "not identifiable";
  return p.at_bound ? "at its bound" : "";
}

}  // namespace

const char* to_string(FitTrust trust) {
  switch (trust) {
    case FitTrust::kGood:
      return "good";
    case FitTrust::kLimited:
      return "limited";
    case FitTrust::kRejected:
      return "rejected";
  }
  return "";
}

bool InputTiming::is_off() const {
  return std::abs(early_rows) > std::max(kBeyondChance * std_rows, kLeastToldRows);
}

double InputTiming::open_rows() const {
  if (std::isnan(early_rows)) return 0.0;
  const double prior = kWithinRow * kWithinRow, own = std_rows * std_rows;
  return std::hypot(early_rows * prior / (prior + own), std::sqrt(prior * own / (prior + own)));
}

const FittedParameter* FitSummary::find(const std::string& key) const {
  for (const FittedParameter& p : parameters)
    if (p.key == key) return &p;
  return nullptr;
}

std::vector<std::string> FitSummary::at_bound() const {
  std::vector<std::string> keys;
  for (const FittedParameter& p : parameters)
    if (p.estimated && p.at_bound) keys.push_back(p.key);
  return keys;
}

std::vector<std::string> FitSummary::given() const {
  std::vector<std::string> keys;
  for (const FittedParameter& p : parameters)
    if (!p.estimated && std::isfinite(p.value)) keys.push_back(p.key);
  return keys;
}

bool FitSummary::closes_gap() const {
  const FittedParameter* gap = find("gap");
  const bool at_none = gap != nullptr && gap->estimated && gap->at_bound && gap->low == 0.0;
  return at_none && gap->value < 0.5 * gap->high && why.code() == "as_well_without_gap";
}

std::string FitSummary::brief_report() const {
  std::string text = fmt::format("fit: {}", to_string(status));
  if (status == FitStatus::kNotRun || status == FitStatus::kFailed) return text + ": " + message.text();
  if (const FittedParameter* gap = find("gap"); gap != nullptr && gap->estimated) {
    text += fmt::format(", gap {}", number(gap->value));
    text += rejected()          ? " (rejected: " + why.text() + ")"
            : !converged()      ? " (no interval)"
            : gap->identifiable ? fmt::format(" [{}, {}]", number(gap->ci95.low), number(gap->ci95.high))
                                : " (not identifiable)";
  }
  text += fmt::format(", free-run error {} (encoder floor {})", number(rmse), number(floor));
  if (!warnings.empty())
    text += fmt::format(", {} warning{}", warnings.size(), warnings.size() > 1 ? "s" : "");
  return text;
}

std::string FitSummary::full_report() const {
  std::string text = fmt::format("Reference fit: {}. {}\n", to_string(status), message.text());
  if (status == FitStatus::kNotRun) return text;
  text += fmt::format("{:<34} {:>12} {:>12} {:>12} {:>26}  {}\n", "parameter", "start", "value", "std",
                      "95 %", "");
  for (const FittedParameter& p : parameters) {
    const Interval ci95 = shown_interval(p);
    const std::string interval =
        std::isnan(ci95.low) ? "-" : fmt::format("{} .. {}", number(ci95.low), number(ci95.high));
    text +=
        fmt::format("{:<34} {:>12} {:>12} {:>12} {:>26}  {}\n", fmt::format("{} [{}]", p.key, p.unit),
                    number(p.start), number(p.value), rejected() ? "-" : number(p.std), interval, note(p));
  }
  text += fmt::format("trust: {}. {}\nfit {} %, ", to_string(trust), why.text(), number(fit_percent));
  text += fmt::format("free-run error {}, prediction error {} at {} Hz, encoder floor {}\n", number(rmse),
                      number(innovation_rmse), number(observer_hz), number(floor));
  for (const ModeError& m : mode_errors)
    text += fmt::format("  {:<12} {:>8} samples, error {}\n", to_string(m.mode), m.samples, number(m.rmse));
  text += "residual: " + test_text("with itself", whiteness) + ", " +
          test_text("with the input", input_correlation) + "\n";
  text += fmt::format("lag-1 autocorrelation {}, {} starts, {} simulations\n", number(lag1_autocorrelation),
                      starts, simulations);
  for (const Remark& a : advice) text += "advice: " + a.text() + "\n";
  for (const Remark& w : warnings) text += "warning: " + w.text() + "\n";
  return text;
}

}  // namespace gapscope
