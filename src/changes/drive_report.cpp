#include "changes/drive_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "base/normal.h"
#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording.h"
#include "results/diagnosis_result.h"
#include "results/file_list.h"
#include "results/run_result.h"
#include "signals/torque_cycles.h"

namespace gapscope {
namespace {

constexpr double kReach = 0.95;      ///< of the amplitude that a branch is followed over
constexpr double kSameRamps = 1.15;  ///< amplitudes of one level
constexpr std::size_t kSteps = 190;  ///< of a branch: a hundredth of the amplitude each
constexpr std::size_t kLoaded = 35;  ///< of them at its end: the flank, from 0.6 of the amplitude on
constexpr std::size_t kDrawn = 5;    ///< one step of so many is drawn
constexpr double kFree = 0.5;        ///< share of the lost motion over which x1 runs free: mostly

double variance_of_mean(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - centre) * (v - centre);
  const auto n = static_cast<double>(values.size());
  return sum / (n - 1.0) / n;
}

/// What the branches of one level say, one number each.
struct Branches {
  std::vector<double> rising, falling;  ///< ∫ x1 du along u from −A to A [rad · unit of u]
  std::vector<double> travel;           ///< [rad]
  std::vector<double> stiffness;        ///< [unit of u per rad]
  std::vector<double> up = std::vector<double>(kSteps + 1), down = up;  ///< sums of x1 along u [rad]

  void add(const std::vector<double>& along, double amplitude, bool rises) {
    const double step = 2.0 * amplitude / static_cast<double>(kSteps);
    double sum = 0.0;
    for (std::size_t k = 1; k < along.size(); ++k) sum += 0.5 * (along[k] + along[k - 1]) * step;
    // Of a falling branch both are counted the other way round: x1 there is −along.
    (rises ? rising : falling).push_back(rises ? sum : -sum);
    for (std::size_t k = 0; k <= kSteps; ++k)
      (rises ? up[k] : down[kSteps - k]) += rises ? along[k] : -along[k];
    travel.push_back(along.back() - along.front());
    const double flank = along.back() - along[along.size() - 1 - kLoaded];
    if (flank > 0.0) stiffness.push_back(step * static_cast<double>(kLoaded) / flank);
  }
  bool enough() const { return rising.size() > 1 && falling.size() > 1 && mean(travel) > 0.0; }
};

LoopMean mean_of(const std::vector<double>& values) {
  if (values.size() < 3) return {};
  return {mean(values),
          student_975(static_cast<double>(values.size()) - 1.0) * std::sqrt(variance_of_mean(values))};
}

/// The area of the loop over twice the travel.
LoopMean friction_of(const Branches& b) {
  const double per = 1.0 / (2.0 * mean(b.travel));
  const double freedom = static_cast<double>(b.rising.size() + b.falling.size()) - 2.0;
  const double error = std::sqrt(variance_of_mean(b.rising) + variance_of_mean(b.falling));
  return {(mean(b.falling) - mean(b.rising)) * per, student_975(freedom) * error * per};
}

/// Up and down again.
void draw(const Branches& b, double reach, LoopFacts& f) {
  const auto place = [&](std::size_t k) { return reach * (2.0 * double(k) / double(kSteps) - 1.0); };
  for (std::size_t k = 0; k <= kSteps; k += kDrawn)
    f.u.push_back(place(k)), f.x1.push_back(b.up[k] / double(b.rising.size()));
  for (std::size_t k = 0; k <= kSteps; k += kDrawn)
    f.u.push_back(place(kSteps - k)), f.x1.push_back(b.down[kSteps - k] / double(b.falling.size()));
  f.u.push_back(f.u.front()), f.x1.push_back(f.x1.front());
  const auto [low, high] = std::ranges::minmax(f.x1);
  const double middle = 0.5 * (low + high);
  for (double& x : f.x1) x -= middle;
}

void add_branches(const MotorTrace& trace, double level, Branches& all) {
  const internal::signals::TorqueCycles cycles = internal::signals::torque_cycles(trace);
  for (std::size_t k = 0; k < cycles.crossings.size(); ++k) {
    const internal::signals::ZeroCrossing& c = cycles.crossings[k];
    const double least = std::min(c.before, c.after), most = std::max(c.before, c.after);
    if (least < level / kSameRamps || most > level * kSameRamps) continue;
    const double reach = kReach * std::min(least, level);
    const auto along = internal::signals::branch_positions(trace, cycles, k, reach, kSteps);
    if (!along.empty()) all.add(along, reach, c.rising);
  }
}

/// Friction and stiffness of the loops that a lost motion was read from, level by level.
std::vector<LoopFacts> loop_facts(const LostMotion& lost_motion, const std::vector<Recording>& recordings) {
  std::vector<LoopFacts> facts;
  for (const LostMotionLevel& level : lost_motion.levels) {
    Branches branches;
    for (const Recording& r : recordings)
      if (!r.u.empty()) add_branches(r.motor_trace(), level.amplitude, branches);
    LoopFacts f;
    f.amplitude = level.amplitude;
    f.runs_free = level.free_run > kFree * level.lost_motion;
    if (branches.enough()) {
      f.friction = friction_of(branches), f.stiffness = mean_of(branches.stiffness);
      draw(branches, kReach * level.amplitude, f);
    }
    facts.push_back(f);
  }
  return facts;
}

constexpr double kHysteresis = 0.3;  ///< of the amplitude of u, against noise at the crossings

/// Half the rate at which u crosses the middle of its range [Hz].
double crossing_frequency(const Recording& r) {
  const auto [low, high] = std::minmax_element(r.u.begin(), r.u.end());
  const double middle = 0.5 * (*low + *high), level = kHysteresis * 0.5 * (*high - *low);
  if (!(level > 0.0)) return 0.0;
  int side = 0, crossings = 0;
  for (const double u : r.u) {
    if (std::abs(u - middle) < level) continue;
    const int now = u > middle ? 1 : -1;
    crossings += side == -now;
    side = now;
  }
  return 0.5 * crossings / r.duration();
}

ExcitationFacts excited(const Recording& r) {
  constexpr double kPeak = 0.99;  // of all samples: of noise alone the largest is another in each recording
  ExcitationFacts e;
  e.file = r.file;
  e.samples = static_cast<int>(r.size());
  e.rate = 1.0 / r.dt;
  e.quantum = r.quantum;
  e.position_rms = rms(r.position());
  if (r.u.empty()) return e;
  e.input_rms = rms(r.u);
  std::vector<double> sizes;
  for (const double u : r.u) sizes.push_back(std::abs(u));
  e.input_peak = quantile(std::move(sizes), kPeak);
  e.input_frequency = crossing_frequency(r);
  return e;
}

void doubt_outside(const std::string& name, double value, const Interval& ci95, DriveReport& report) {
  const double slack = 1e-9 * std::abs(value);  // of decimals
  if (value < ci95.low - slack || value > ci95.high + slack)
    report.doubts.push_back(fmt::format(
        "{} is {:.6g} in result.json, outside its own interval of {:.6g} to {:.6g}: no estimate says that, "
        "the file was changed",
        name, value, ci95.low, ci95.high));
}

/// What only a file that was changed since can say.
void add_doubts(const std::string& folder, DriveReport& report) {
  constexpr const char* kResult = "result.json";
  const auto list = internal::results::read_file_list(folder);
  if (list && !list->wrote(folder, kResult))
    report.doubts.emplace_back(
        "result.json was changed since gapscope wrote it (files.json has its SHA-256)");
  if (report.model_free) {
    doubt_outside("the gap", report.model_free->gap, report.model_free->ci95, report);
    const LostMotion& m = report.model_free->lost_motion;
    doubt_outside("the lost motion", m.value, m.ci95, report);
  }
  if (!report.reference) return;
  for (const FittedParameter& p : report.reference->parameters)
    doubt_outside(p.key, p.value, report.reference->shown_interval(p), report);
}

void take_estimate(const std::string& folder, DriveReport& report) {
  RunResult run = read_run_result(folder);
  report.name = run.name, report.version = run.version;
  report.configuration = std::move(run.configuration);
  report.coordinates = run.coordinates;
  report.answer = std::move(run.answer), report.input = std::move(run.input);
  report.model_free = std::move(run.model_free);
  report.reference = std::move(run.reference);
  for (const Recording& r : run.recordings) report.recordings.push_back(excited(r));
  if (report.model_free) {
    report.loops = loop_facts(report.model_free->lost_motion, run.recordings);
    report.model_free->traces.clear();
  }
  if (report.reference) report.reference->traces.clear();
  add_doubts(folder, report);
}

/// @param alone  there is no estimate in the folder
void take_diagnosis(const std::string& folder, bool alone, DriveReport& report) {
  DiagnosisResult diagnosed = read_diagnosis_result(folder);
  if (alone) {
    report.name = diagnosed.name, report.version = diagnosed.version;
    report.configuration = std::move(diagnosed.configuration);
    report.coordinates = diagnosed.coordinates, report.input = std::move(diagnosed.input);
  }
  if (diagnosed.answer) report.answer = std::move(diagnosed.answer);
  report.diagnosis = std::move(diagnosed.diagnosis);
}

}  // namespace

DriveReport read_drive_report(const std::string& folder) {
  const bool diagnosed = std::filesystem::exists(folder + "/diagnosis.json");
  const bool estimated = std::filesystem::exists(folder + "/result.json");
  DriveReport report;
  report.folder = folder;
  if (estimated || !diagnosed) take_estimate(folder, report);
  if (diagnosed) take_diagnosis(folder, !estimated, report);
  return report;
}

}  // namespace gapscope
