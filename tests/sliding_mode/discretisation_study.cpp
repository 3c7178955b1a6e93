// The discretisations of the differentiator compared by event time: t1 and t2 of the source paper's S3 and S4
// on one e_x against the independent plant's, on its rig (2β = 18.8 mrad, 20 bit). Prints a Markdown table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gapscope/base/statistics.h"
#include "independent_plant/simulate.h"
#include "signals/signal_facts.h"
#include "sliding_mode/marks/bank_run.h"
#include "sliding_mode/published/paper_method.h"

namespace gapscope {
namespace {

using independent_plant::GapPassage;

constexpr Discretisation kAll[] = {Discretisation::kForwardEuler, Discretisation::kSemiImplicit,
                                   Discretisation::kImplicit, Discretisation::kMatched};

struct Setting {
  double torque, frequency;    // [N m], [Hz]
  std::vector<double> bounds;  // [rad/s²]
};

independent_plant::BlindRun record(const Setting& s, double dt) {
  const independent_plant::BlindDrive rig;
  independent_plant::BlindExcitation sine;
  sine.amplitude = s.torque / rig.torque_constant;
  sine.frequency = s.frequency;
  independent_plant::BlindOptions options;
  options.rate = 1.0 / dt;
  options.duration = 10.0 / s.frequency;
  options.tolerance = independent_plant::kFastTolerance;
  return simulate_blind(rig, sine, independent_plant::BlindSensor::with_bits(20), options);
}

/// From one flank to the other, after the first period.
std::vector<GapPassage> passages_of(const independent_plant::BlindTruth& truth, double from) {
  std::vector<GapPassage> passages;
  for (const GapPassage& p : truth.passages)
    if (p.from_flank * p.to_flank < 0 && p.t1 > from) passages.push_back(p);
  return passages;
}

/// Errors over all passages that were read.
struct Errors {
  std::vector<double> t1, t2, gap;
};

Errors errors_of(const internal::sliding_mode::PaperReading& reading,
                 const std::vector<GapPassage>& passages) {
  Errors errors;
  for (const GapPassage& p : passages)
    for (const GapEvent& e : reading.events) {
      if (!e.accepted || std::abs(e.t2 - p.t2) > 0.5 * (p.t2 - p.t1)) continue;
      errors.t1.push_back(std::abs(e.t1 - p.t1));
      errors.t2.push_back(std::abs(e.t2 - p.t2));
      errors.gap.push_back(std::abs(e.gap / p.gap - 1.0));
      break;
    }
  return errors;
}

/// Median height of e_x within 10 ms after the impacts, over its floor.
double spike_over_floor(const MotorTrace& trace, const internal::signals::SignalFacts& facts, double bound,
                        Discretisation d, const std::vector<GapPassage>& passages) {
  const internal::sliding_mode::BankErrors run = internal::sliding_mode::run_bank(trace, facts, {bound}, d);
  std::vector<double> heights;
  for (const GapPassage& p : passages) {
    double height = 0.0;
    for (auto i = static_cast<std::size_t>(p.t2 / trace.dt); trace.time(i) < p.t2 + 0.01 && i < trace.size();
         ++i)
      height = std::max(height, std::abs(run.error(i, 0)));
    heights.push_back(height / run.floor[0]);
  }
  return median(std::move(heights));
}

std::string cell(const MotorTrace& trace, const internal::signals::SignalFacts& facts, double bound,
                 Discretisation d, const std::vector<GapPassage>& passages) {
  const Errors e = errors_of(internal::sliding_mode::read_with_bound(trace, facts, bound, d), passages);
  if (2 * e.gap.size() >= passages.size())
    return fmt::format("{:.1f} / {:.2f} / {:.1f} %", 1e3 * median(e.t1), 1e3 * median(e.t2),
                       100.0 * median(e.gap));
  return fmt::format("s {:.0f}", spike_over_floor(trace, facts, bound, d, passages));
}

void print_table(const Setting& s) {
  fmt::print(
      "\n{} N·m, {} Hz: median error of t1 [ms] / t2 [ms] / gap; s n: no t1, the spike is n × floor\n\n",
      s.torque, s.frequency);
  fmt::print("| T | L |");
  for (const Discretisation d : kAll) fmt::print(" {} |", to_string(d));
  fmt::print("\n|---|---|---|---|---|---|\n");
  for (const double dt : {0.05e-3, 0.1e-3, 0.4e-3, 1e-3}) {
    const independent_plant::BlindRun run = record(s, dt);
    const MotorTrace trace = run.recording.motor_trace();
    const internal::signals::SignalFacts facts = internal::signals::read_facts(trace);
    const auto passages = passages_of(run.truth, 1.0 / s.frequency);
    for (const double bound : s.bounds) {
      fmt::print("| {} ms | {} |", 1e3 * dt, bound);
      for (const Discretisation d : kAll) fmt::print(" {} |", cell(trace, facts, bound, d, passages));
      fmt::print("\n");
    }
  }
}

}  // namespace
}  // namespace gapscope

int main() {
  gapscope::print_table({0.1, 1.0, {3.0, 4.0, 5.0, 8.0, 15.0, 40.0, 100.0}});
  gapscope::print_table({0.5, 2.0, {40.0, 60.0, 80.0, 150.0}});
}
