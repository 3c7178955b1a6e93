#include "diagnosis/law_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "diagnosis/added_in_words.h"
#include "diagnosis/amount_study.h"
#include "diagnosis/diagnose.h"
#include "diagnosis/mismatch_size.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "support/thread_time.h"

namespace gapscope::test {
namespace {

using namespace internal::diagnosis;

constexpr const char* kBeyond = "-beyond";  ///< the next recording leaves the law's table

/// What the outside effects are functions of.
std::string true_variable(const std::string& effect) {
  static const std::map<std::string, std::string> kVariables = {
      {"friction_hump", "speed"}, {"cable_pull", "position"}, {"one_sided_gain", "input"}};
  const auto at = kVariables.find(effect);
  return at == kVariables.end() ? "" : at->second;
}

/// A recording that the diagnosis has not seen, held out; it has to outlive the study.
Study next_study(const blind::BlindPair& pair, const Recording& last, const DiagnosisOptions& options) {
  const MotorTrace train[] = {pair.train.motor_trace()}, next[] = {last.motor_trace()};
  return make_study(train, next, pair.sheet, options);
}

/// What the law takes of it.
double next_shrink(const Study& study, const Diagnosis& d) {
  const auto size = [&](const ReferenceModel& model) {
    return judge(nullptr, {model, {}, 0.0, {}}, study.held_out, d.observer_hz).median_free;
  };
  return shrink_of(size(d.fitted), size(d.laws.front().fitted));
}

/// Whether more than a tenth of its samples lie beyond the law's table.
bool leaves_table(const Study& study, const Diagnosis& d) {
  const LastResortLaw& law = d.laws.front();
  const MotorTrace& next = study.held_out.traces.front();
  const auto moved = play(d.fitted, study.held_out, d.observer_hz, true);
  const bool periodic = law.variable == "position" && law.fitted.effects.back().parameters[0].estimate;
  if (periodic || moved.empty()) return false;
  const std::span<const double> at = law.variable == "speed"   ? std::span(moved.front().w1)
                                     : law.variable == "input" ? std::span(next.u)
                                                               : std::span(next.x1);
  const auto beyond = std::count_if(
      at.begin(), at.end(), [&](double v) { return v < law.curve.front().at || v > law.curve.back().at; });
  return 10 * beyond > std::ssize(at);
}

}  // namespace

WholeDiagnosis diagnosed(const blind::BlindPair& pair, const ReferenceModel& sheet, std::uint64_t seed) {
  DiagnosisOptions options;
  options.threads = 1;
  const MotorTrace train[] = {pair.train.motor_trace()}, held[] = {pair.held_out.motor_trace()};
  const double begin = thread_seconds();
  WholeDiagnosis whole{diagnose(train, held, sheet, options), {}};
  StudyRow& row = whole.row;
  row.seconds = thread_seconds() - begin;
  row.seed = seed, row.rig = pair.rig, row.effect = pair.effect, row.excitations = pair.excitations;
  row.severity = pair.severity;
  row.verdict = to_string(whole.diagnosis.verdict);
  row.before = whole.diagnosis.mismatch.before / whole.diagnosis.mismatch.floor;
  row.group = static_cast<int>(whole.diagnosis.effects.size());
  return whole;
}

StudyRow examine_laws(const blind::BlindPair& pair, std::uint64_t seed) {
  auto [d, row] = diagnosed(pair, pair.sheet, seed);
  row.details =
      fmt::format("[{}] leaves {:.3g}", fmt::join(d.effects, " "), d.mismatch.after / d.mismatch.floor);
  if (!d.added.empty()) row.details += "; " + added_in_words(d) + ";" + told_numbers_in_words(pair.drawn, d);
  if (d.laws.empty()) return row;
  const LastResortLaw& law = d.laws.front();
  row.first = law.law;
  row.in_group = law.variable == true_variable(pair.effect);
  row.shrink = law.shrink;
  const Recording last = pair.next();
  const DiagnosisOptions options;
  const Study next_one = next_study(pair, last, options);
  const double next = next_shrink(next_one, d);
  row.covered = !std::isfinite(next) || !std::isfinite(law.shrink_ci95.low)   ? "-"
                : law.shrink_ci95.low <= next && next <= law.shrink_ci95.high ? "yes"
                                                                              : "no";
  if (row.covered != "-" && leaves_table(next_one, d)) row.covered += kBeyond;
  row.details += fmt::format(" {} [{:.3g}, {:.3g}] next {:.3g}, {}", law.shrink, law.shrink_ci95.low,
                             law.shrink_ci95.high, next, fmt::join(law.group, " "));
  return row;
}

void print_laws(const std::vector<StudyRow>& rows) {
  int functions = 0, told = 0, right = 0, any = 0, judged = 0, covered = 0, within = 0, covered_within = 0;
  std::vector<double> shrinks;
  for (const StudyRow& r : rows) {
    any += r.first != "-" ? 1 : 0;
    if (true_variable(r.effect).empty() || !r.relevant()) continue;
    ++functions;
    if (r.first == "-") continue;
    ++told, right += r.in_group ? 1 : 0;
    if (r.in_group) shrinks.push_back(r.shrink);
    if (r.covered == "-") continue;
    const int yes = r.covered.starts_with("yes") ? 1 : 0;
    ++judged, covered += yes;
    if (!r.covered.ends_with(kBeyond)) ++within, covered_within += yes;
  }
  fmt::print("{} cases, a law told in {}\n", rows.size(), any);
  for (const char* const verdict : {"none", "effect", "helps", "unknown"})
    fmt::print(
        "  {}: {}, the true effect among those added in {}\n", verdict,
        std::count_if(rows.begin(), rows.end(), [&](const StudyRow& r) { return r.verdict == verdict; }),
        std::count_if(rows.begin(), rows.end(), [&](const StudyRow& r) {
          const std::string added = r.details.substr(0, r.details.find(']'));
          return r.verdict == verdict && added.find(r.effect) != std::string::npos;
        }));
  if (functions == 0) return;
  fmt::print(
      "functions of speed, position or input above 2 floors: {}; law told {}, of the right variable {}\n",
      functions, told, right);
  if (!shrinks.empty()) fmt::print("shrink of the right ones, median: {:.3f}\n", median(shrinks));
  fmt::print("next recording's shrink in the interval: {} of {}; of those within the table {} of {}\n",
             covered, judged, covered_within, within);
}

}  // namespace gapscope::test
