// Inputs that are none: random drives of the independent plant, in open and closed loop, some of them heavily
// damped, 50 Hz to 2 kHz, 12 to 16 bit; each as it was recorded and with one thing wrong, through check.
//   study_inputs FIRST LAST FOLDER [KIND] [each]
// e.g. study_inputs 1 24 inputs; study_inputs 1 24 inputs late each
// Prints for each kind how many there are, in how many check names it, and in how many it says that something
// else spoils: of those without a fault, how many are said to have one.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/random.h"
#include "drives/closed_loop.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "gapscope/inspection/inspection.h"
#include "gapscope/recording/recording_file.h"
#include "independent_plant/random_drive.h"

namespace gapscope {
namespace {

using independent_plant::BlindCase;
using independent_plant::BlindRun;
using independent_plant::Waveform;

template <class T>
T one_of(std::mt19937_64& g, std::initializer_list<T> values) {
  return values.begin()[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(values.size())))];
}

struct Drawn {
  std::string what;  ///< "damped sine 100 Hz 14 bit"
  BlindRun run;
  bool loop = false;
};

constexpr const char* kWaves[] = {"sine", "multisine", "swept", "triangle", "trapezoid", "steps"};

BlindRun in_closed_loop(std::mt19937_64& g, const BlindCase& c) {
  using independent_plant::Course;
  const double update = std::max(1000.0, c.options.rate),
               inertia = c.drive.motor_inertia + c.drive.load_inertia;
  auto controller = independent_plant::tuned_controller(inertia, c.drive.torque_constant,
                                                        log_uniform(g, 5.0, 30.0), update);
  controller.position_gain = log_uniform(g, 5.0, 20.0);
  independent_plant::ReferenceMotion motion;
  motion.course = one_of(g, {Course::kSCurve, Course::kTriangle, Course::kTrapezoid, Course::kSines});
  motion.travel = uniform(g, 0.5, 6.0), motion.speed = uniform(g, 2.0, 8.0);
  independent_plant::LoopRecorder recorder;
  recorder.rate = c.options.rate, recorder.lead_s = 0.5;
  return simulate_closed_loop(c.drive, motion, controller, c.sensor, recorder, c.options).run;
}

Drawn drawn(std::uint64_t seed, double load_share) {
  std::mt19937_64 g = random_stream(seed, "inputs study");
  Drawn d;
  const int family = static_cast<int>(seed % 5);
  d.loop = family == 4 || (family == 3 && uniform(g, 0.0, 1.0) < 0.5);
  const auto wave = one_of(g, {Waveform::kSine, Waveform::kMultisine, Waveform::kTriangle,
                               Waveform::kTrapezoid, Waveform::kSteps});
  const bool gap = family == 0 || family == 4;
  BlindCase c = gap ? independent_plant::random_drive(seed, wave, independent_plant::DriveLaws::kWide)
                    : independent_plant::random_gap_free_drive(
                          seed, static_cast<int>(uniform(g, 0.0, independent_plant::kGapFreeKinds)), wave,
                          independent_plant::DriveLaws::kWide);
  c.options.rate = one_of(g, {50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0});
  c.options.duration = std::max(c.options.duration, 80.0 / c.options.rate);
  c.options.tolerance = independent_plant::kFastTolerance;
  const int bits = one_of(g, {12, 14, 16});
  c.sensor = independent_plant::BlindSensor::with_bits(bits, uniform(g, 0.0, 0.5));
  if (family == 2) c.drive.motor_damping *= log_uniform(g, 5.0, 40.0), c.excitation.amplitude *= 4.0;
  if (load_share != 0.0) {
    double swing = c.excitation.amplitude;
    if (d.loop) {
      std::mt19937_64 same = g;
      const auto& u = in_closed_loop(same, c).recording.u;
      const auto [low, high] = std::minmax_element(u.begin(), u.end());
      swing = 0.5 * (*high - *low);
    }
    const double load = load_share * c.drive.torque_constant * swing;
    c.drive.effects.load.constant_torque_nm = -load;
    c.excitation.offset = load_share * c.excitation.amplitude;
  }
  d.run = d.loop ? in_closed_loop(g, c) : simulate_blind(c.drive, c.excitation, c.sensor, c.options);
  d.what =
      fmt::format("{} {} {:g} Hz {} bit {:.1f} s", family == 2 ? "damped" : c.kind,
                  d.loop ? "loop" : kWaves[static_cast<int>(wave)], c.options.rate, bits, c.options.duration);
  return d;
}

/// What a row has acted `rows` before it (later, if negative).
Recording moved(Recording r, int rows) {
  const std::vector<double> u = r.u;
  const auto n = static_cast<std::ptrdiff_t>(u.size());
  for (std::ptrdiff_t i = 0; i < n; ++i)
    r.u[static_cast<std::size_t>(i)] =
        u[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i - rows, 0, n - 1))];
  return r;
}

struct Kind {
  const char* name;
  std::function<Recording(const Drawn&)> change;
  const char* rule;    ///< that names it
  const char* advice;  ///< and a word of what it proposes
  double load = 0.0;   ///< constant, over the swing of u
  int all = 0, named = 0, others = 0;
};

Recording speed_of(const Drawn& d, bool measured) {
  Recording r = d.run.recording;
  const auto& x = measured ? d.run.recording.x1 : d.run.truth.x1;
  for (std::size_t i = r.x1.size(); i-- > 1;) r.x1[i] = (x[i] - x[i - 1]) / r.dt;
  r.x1[0] = r.x1[1];
  return r;
}

std::vector<Kind> kinds() {
  const auto late = [](int rows) { return [rows](const Drawn& d) { return moved(d.run.recording, rows); }; };
  return {{"faultless", [](const Drawn& d) { return d.run.recording; }, "", ""},
          {"magnitude",
           [](const Drawn& d) {
             Recording r = d.run.recording;
             for (double& u : r.u) u = std::abs(u);
             return r;
           },
           "input", "with its sign"},
          {"late1", late(1), "scale of u", "--input-rows -1"},
          {"late2", late(2), "scale of u", "--input-rows -2"},
          {"early1", late(-1), "scale of u", "--input-rows 1"},
          {"early2", late(-2), "scale of u", "--input-rows 2"},
          {"speed", [](const Drawn& d) { return speed_of(d, true); }, "unit of x1", "--speed"},
          {"true_speed", [](const Drawn& d) { return speed_of(d, false); }, "unit of x1", "--speed"},
          {"load", [](const Drawn& d) { return d.run.recording; }, "input", "constant_load_torque", 0.8}};
}

/// The rules whose findings speak of an input or a position that is not what it is called.
bool is_of_inputs(const Finding& f) {
  return f.rule == "input" || f.rule == "scale of u" || f.rule == "unit of x1" || f.rule == "sign";
}

void count(std::uint64_t seed, const std::string& folder, bool each, Kind& kind) {
  const Drawn d = drawn(seed, kind.load);
  const std::string file = fmt::format("{}/{}_{}.csv", folder, kind.name, seed);
  write_csv(file, kind.change(d));
  std::string found = "nothing";
  bool named = false, other = false;
  try {
    for (const Finding& f : inspect(file).findings) {
      const bool it = f.rule == kind.rule && f.severity != Severity::kFine && *kind.rule != '\0' &&
                      f.advice.find(kind.advice) != std::string::npos;
      named = named || it;
      if (!it && f.severity == Severity::kSpoils && is_of_inputs(f))
        other = true, found = f.rule + ": " + f.found;
    }
  } catch (const ConfigError& problem) {
    found = problem.what();
  }
  ++kind.all, kind.named += named, kind.others += other;
  if (each)
    fmt::print("{} {} {}: {}{}\n", kind.name, seed, d.what, named ? "named" : "-", other ? ", " + found : "");
  std::fflush(stdout);
}

int study(std::uint64_t first, std::uint64_t last, const std::string& folder, const std::string& only,
          bool each) {
  for (Kind& kind : std::vector<Kind>(kinds())) {
    if (!only.empty() && only != "all" && only != kind.name) continue;
    for (std::uint64_t seed = first; seed <= last; ++seed) count(seed, folder, each, kind);
    fmt::print("{:<10} {:3} drawn, {:3} named, {:3} told another fault\n", kind.name, kind.all, kind.named,
               kind.others);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "study_inputs FIRST LAST FOLDER [KIND|all] [each]\n"), 2;
  return gapscope::study(std::stoull(argv[1]), std::stoull(argv[2]), argv[3], argc > 4 ? argv[4] : "",
                         argc > 5);
}
