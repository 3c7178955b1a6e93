#include "diagnosis/amount_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/normal.h"
#include "diagnosis/candidates.h"
#include "diagnosis/study.h"
#include "diagnosis/tell_budget.h"
#include "diagnosis/tell_intervals.h"
#include "support/thread_time.h"

namespace gapscope::test {
namespace {

using namespace internal::diagnosis;
using blind::LawForm;

constexpr const char *kBest = "best", *kBeside = "beside";

/// Of the value that was drawn, the turn nearest to what is told.
double nearest_turn(const std::string& key, double drawn, double told) {
  if (key != "phase_rad") return drawn;
  return drawn + 2.0 * kPi * std::round((told - drawn) / (2.0 * kPi));
}

const AddedEffect* established(const Diagnosis& d, const std::string& effect) {
  for (const AddedEffect& a : d.added)
    if (d.verdict == DiagnosisVerdict::kEffect && a.established && a.effect == effect) return &a;
  return nullptr;
}

bool is_named(const StudyRow& r) {
  const std::string added = r.details.substr(0, r.details.find(']')) + " ";
  return r.verdict == "effect" && (added.find("[" + r.effect + " ") != std::string::npos ||
                                   added.find(" " + r.effect + " ") != std::string::npos);
}

/// From the numbers that were drawn and those of a drive; led by a faster observer where the plain fit has
/// ended beside the best.
FittedModel fitted_with(const Study& study, const blind::DrawnLaw& law, ReferenceModel drive) {
  drive.effects.push_back(searched_effect(*find_effect(law.effect), study.turns));
  for (std::size_t i = 0; i < law.numbers.size(); ++i)
    drive.effects.back().parameters[i].value = law.numbers[i].value;
  FittedModel fitted = fit_near(study.train, drive, study.options.fit, study.observer_hz);
  if (fitted.mean_cost < kExplained || !std::isfinite(fitted.mean_cost)) return fitted;
  FittedModel led = led_by_faster_observer(study, fitted);
  return led.mean_cost < fitted.mean_cost ? led : fitted;
}

/// Whether another fit leaves less, by as much as one number that is off by two standard errors costs.
bool is_beside(const FittedModel& fitted, const FittedModel& other, std::size_t samples) {
  return static_cast<double>(samples) * (fitted.mean_cost / other.mean_cost - 1.0) > 4.0;
}

void print_number(const StudyRow& r, const ToldNumber& n) {
  fmt::print("{} {} {} ({} added): {} drawn {:.5g}, told {:.5g} [{:.5g}, {:.5g}] {} {:+.2f}\n", r.seed, r.rig,
             r.effect, r.group, n.key, nearest_turn(n.key, n.drawn, n.told), n.told, n.ci95.low, n.ci95.high,
             !n.has_interval() ? "-" : (n.holds() ? "holds" : "DOES NOT HOLD"), n.deviation());
}

void print_count(const std::string& what, const AmountCount& c) {
  if (c.all == 0) return;
  const Interval w = wilson(c.held, c.all);
  fmt::print("{:<44}{:4} of {:4} = {:5.1f} %  [{:.1f}, {:.1f}]; error over its standard error, rms {:.2f}\n",
             what, c.held, c.all, 100.0 * c.held / c.all, 100.0 * std::max(0.0, w.low), 100.0 * w.high,
             std::sqrt(c.squares / c.all));
}

}  // namespace

bool ToldNumber::has_interval() const { return std::isfinite(ci95.low) && std::isfinite(ci95.high); }

bool ToldNumber::holds() const {
  const double value = nearest_turn(key, drawn, told);
  return ci95.low <= value && value <= ci95.high;
}

double ToldNumber::deviation() const {
  return (told - nearest_turn(key, drawn, told)) / ((ci95.high - ci95.low) / (2.0 * kNormal95));
}

std::string told_numbers_in_words(const std::vector<blind::DrawnLaw>& drawn, const Diagnosis& d) {
  std::string text;
  for (const blind::DrawnLaw& law : drawn) {
    const AddedEffect* a = established(d, law.effect);
    if (a == nullptr) continue;
    for (const NamedValue& n : law.numbers)
      for (const NamedValue& t : a->parameters)
        if (t.key == n.key)
          text += fmt::format(" {{{} {:.8g} {:.8g} {:.8g} {:.8g}}}", n.key, n.value, t.value, t.ci95.low,
                              t.ci95.high);
  }
  return text;
}

std::vector<ToldNumber> told_numbers(const StudyRow& row) {
  std::vector<ToldNumber> numbers;
  for (std::size_t at = row.details.find('{'); at != std::string::npos; at = row.details.find('{', at + 1)) {
    std::istringstream words(row.details.substr(at + 1, row.details.find('}', at) - at - 1));
    ToldNumber n;
    std::string drawn, told, low, high;  // may be nan
    if (!(words >> n.key >> drawn >> told >> low >> high)) continue;
    n.drawn = std::stod(drawn), n.told = std::stod(told);
    n.ci95 = {std::stod(low), std::stod(high)};
    numbers.push_back(n);
  }
  return numbers;
}

void AmountCount::add(const ToldNumber& n) {
  ++all, held += n.holds() ? 1 : 0;
  squares += n.deviation() * n.deviation();
}

StudyRow examine_amount(const blind::BlindPair& pair, std::uint64_t seed) {
  DiagnosisOptions options;
  options.threads = 1;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  const MotorTrace train[] = {pair.train.motor_trace()}, held[] = {pair.held_out.motor_trace()};
  const double begin = thread_seconds();
  const Study study = make_study(train, held, pair.sheet, options);
  const blind::DrawnLaw& law = pair.drawn.front();
  const FittedModel fitted = fitted_with(study, law, pair.sheet);
  StudyRow row;
  row.seed = seed, row.rig = pair.rig, row.effect = pair.effect, row.excitations = pair.excitations;
  row.severity = pair.severity;
  row.before = std::sqrt(fitted.mean_cost);
  row.verdict = fitted.mean_cost < kExplained ? "effect" : "unknown";
  if (row.verdict == "effect") {
    Diagnosis d;
    d.verdict = DiagnosisVerdict::kEffect;
    AddedEffect added;
    added.effect = law.effect;
    added.established = true;
    added.parameters = values_in(fitted.model, *find_effect(law.effect));
    d.added = {added};
    tell_intervals(study, fitted, fitted.model, d);
    row.group = 1;
    row.covered = is_beside(fitted, fitted_with(study, law, pair.truth), train[0].size()) ? kBeside : kBest;
    row.details = fmt::format("[{}]{}", law.effect, told_numbers_in_words(pair.drawn, d));
  }
  row.seconds = thread_seconds() - begin;
  return row;
}

void print_amounts(const std::vector<StudyRow>& rows) {
  std::map<std::string, AmountCount> by_effect;
  std::map<std::string, int> another;
  AmountCount same, series, alone, further, further_of_series, best, beside;
  int without = 0;
  for (const StudyRow& r : rows) {
    const LawForm form = blind::form_of(r.effect);
    if (form == LawForm::kAnother && is_named(r)) ++another[r.effect];
    const std::vector<ToldNumber> numbers = told_numbers(r);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const ToldNumber& n = numbers[i];
      print_number(r, n);
      if (!n.has_interval()) without += i == 0 ? 1 : 0;
      if (!n.has_interval()) continue;
      if (i > 0) (form == LawForm::kSame ? further : further_of_series).add(n);
      if (i > 0) continue;
      by_effect[r.effect].add(n);
      (form == LawForm::kSame ? same : series).add(n);
      if (r.group == 1) alone.add(n);
      if (r.covered == kBest) best.add(n);
      if (r.covered == kBeside) beside.add(n);
    }
  }
  fmt::print("95 % intervals of the amount of a named effect that hold what was drawn:\n");
  for (const auto& [effect, c] : by_effect) print_count("  " + effect, c);
  print_count("the same law", same);
  print_count("first harmonic of a law of many", series);
  print_count("the only effect that was added", alone);
  print_count("fits in the minimum that the truth leads to", best);
  print_count("fits in one beside it", beside);
  print_count("further numbers of the same law", further);
  print_count("of the first harmonics of a law of many", further_of_series);
  fmt::print("named without an interval: {}; not named: {} of {}\n", without,
             std::count_if(rows.begin(), rows.end(), [](const StudyRow& r) { return !is_named(r); }),
             rows.size());
  for (const auto& [effect, count] : another)
    fmt::print("left out, of another law by construction: {} {}\n", effect, count);
}

}  // namespace gapscope::test
