// Random drives of the independent plant for the detector: how often it answers, how well, and how honest its
// intervals are.  study_sliding_mode FIRST_SEED COUNT gap|gap_free sine|triangle|trapezoid|multisine [each]
// [wide] [stream] [rubs] [pushed] [held] [slides]: wide: other contacts, torques and lengths; stream: as a
// stream, which learns from the first two periods; rubs: the motor has dry friction, too, of 0.02 to 0.3 of
// the torque's amplitude; pushed: the load has an unbalance of 0.5 to 5 times its dry friction, 1 to 20
// periods a turn; held: 0.3 to 1 of that friction is elastic, and holds on over 0.03 to 1 of the gap; slides:
// a load of 0.1 to 0.5 of the motor with at most 0.02 of the torque as friction
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"
#include "sliding_mode/as_stream.h"

namespace gapscope {
namespace {

struct Outcome {
  std::uint64_t seed = 0;
  std::string kind;
  double gap = 0.0, quantum = 0.0, mass_ratio = 0.0, coasting = 0.0;  // coasting: load travel over the gap
  GapEstimate estimate;
};

independent_plant::Waveform waveform_of(const std::string& name) {
  const std::map<std::string, independent_plant::Waveform> names{
      {"sine", independent_plant::Waveform::kSine},
      {"triangle", independent_plant::Waveform::kTriangle},
      {"trapezoid", independent_plant::Waveform::kTrapezoid},
      {"multisine", independent_plant::Waveform::kMultisine}};
  return names.at(name);
}

double median_coasting(const independent_plant::BlindTruth& truth) {
  std::vector<double> shares;
  for (const independent_plant::GapPassage& p : truth.passages)
    if (p.from_flank * p.to_flank < 0) shares.push_back(std::abs(p.load_travel) / p.gap);
  return shares.empty() ? 0.0 : median(std::move(shares));
}

/// What the drive has beside the laws of random_drive().
struct Extras {
  bool rubs = false, pushed = false, held = false, slides = false;
};

Outcome run(std::uint64_t seed, bool with_gap, independent_plant::Waveform waveform,
            independent_plant::DriveLaws laws, const Extras& extras, bool streamed) {
  independent_plant::BlindCase c =
      with_gap ? independent_plant::random_drive(seed, waveform, laws)
               : independent_plant::random_gap_free_drive(
                     seed, static_cast<int>(seed % independent_plant::kGapFreeKinds), waveform, laws);
  if (std::mt19937_64 g = random_stream(seed, "dry friction of the motor"); extras.rubs)
    c.drive.effects.motor.friction.level_nm =
        c.drive.torque_constant * c.excitation.amplitude * std::uniform_real_distribution(0.02, 0.3)(g);
  if (std::mt19937_64 g = random_stream(seed, "unbalance of the load"); extras.pushed) {
    c.drive.effects.load.unbalance_nm = c.drive.load_coulomb * log_uniform(g, 0.5, 5.0);
    c.drive.effects.load.unbalance_periods = log_uniform(g, 1.0, 20.0);
  }
  if (std::mt19937_64 g = random_stream(seed, "light load that slides"); extras.slides) {
    c.drive.load_inertia = c.drive.motor_inertia * log_uniform(g, 0.1, 0.5);
    c.drive.load_coulomb = c.drive.torque_constant * c.excitation.amplitude * log_uniform(g, 0.0002, 0.02);
    c.drive.load_damping = c.drive.motor_damping * log_uniform(g, 0.01, 1.0);
  }
  if (std::mt19937_64 g = random_stream(seed, "elastic friction of the load"); extras.held) {
    independent_plant::BristleFriction& bristle = c.drive.effects.load.bristle;
    bristle.level_nm = c.drive.load_coulomb * std::uniform_real_distribution(0.3, 1.0)(g);
    bristle.length_rad = c.drive.gap * log_uniform(g, 0.03, 1.0);
    bristle.damping_nms =
        log_uniform(g, 0.01, 1.0) * std::sqrt(bristle.level_nm / bristle.length_rad * c.drive.load_inertia);
    c.drive.load_coulomb -= bristle.level_nm;
  }
  c.options.tolerance = independent_plant::kFastTolerance;
  const independent_plant::BlindRun r = independent_plant::simulate_blind(c);
  MotorTrace trace = r.recording.motor_trace();
  trace.quantum = c.sensor.quantum;
  Outcome o{seed, c.kind, with_gap ? c.drive.gap : 0.0, c.sensor.quantum, 0.0, 0.0, {}};
  o.mass_ratio = c.drive.load == independent_plant::BlindLoad::kNone
                     ? 0.0
                     : c.drive.load_inertia / c.drive.motor_inertia;
  o.coasting = with_gap ? median_coasting(r.truth) : 0.0;
  o.estimate = streamed ? as_stream(trace).estimate : detect_gap({&trace, 1});
  return o;
}

struct Tally {
  int cases = 0, accepted = 0, covered = 0, none = 0;
  int good = 0, good_covered = 0;
  int wrong_none = 0;  // although the gap is above what would have shown, light loads included
  int loops = 0;       // drives whose u and x1 make a loop
  std::vector<double> errors;

  void add(const Outcome& o) {
    const GapEstimate& e = o.estimate;
    ++cases;
    none += e.verdict == GapVerdict::kNone;
    wrong_none += e.verdict == GapVerdict::kNone && e.smallest_visible_gap < o.gap;
    loops += e.lost_motion.read();
    if (e.verdict != GapVerdict::kBacklash) return;
    ++accepted;
    const bool holds = e.ci95.low <= o.gap && o.gap <= e.ci95.high;
    covered += holds;
    good += e.trust == GapTrust::kGood;
    good_covered += holds && e.trust == GapTrust::kGood;
    if (o.gap > 0.0) errors.push_back(100.0 * std::abs(e.gap / o.gap - 1.0));
  }

  void print(const std::string& name) const {
    const auto share = [](int count, int of) {
      const Interval w = wilson(count, of);
      return fmt::format("{}/{} = {:.1f} [{:.1f}, {:.1f}] %", count, of, of ? 100.0 * count / of : 0.0,
                         100.0 * w.low, 100.0 * w.high);
    };
    fmt::print("{:36s} backlash {}", name, share(accepted, cases));
    if (!errors.empty())
      fmt::print("; error median {:.2f}, 95 % {:.1f}, max {:.1f} %; covered {}", median(errors),
                 quantile(errors, 0.95), quantile(errors, 1.0), share(covered, accepted));
    if (accepted > 0) fmt::print("; good {}, covered {}", good, share(good_covered, good));
    fmt::print("; none {}, above the visible gap {}; loops {}\n", share(none, cases),
               share(wrong_none, cases), loops);
  }
};

std::vector<std::string> classes(const Outcome& o) {
  const auto bits = static_cast<int>(std::lround(std::log2(2.0 * kPi / o.quantum)));
  std::vector<std::string> names{"0 all", fmt::format("1 {} bit", bits)};
  if (o.gap <= 0.0) {
    names.push_back("2 " + o.kind);
    if (bits >= 16) names.push_back("3 16 bit and more");
    return names;
  }
  const std::string width = o.gap >= 100.0 * o.quantum ? "100 quanta and more" : "below 100 quanta";
  names.push_back((o.coasting < 0.01 ? "2 at rest, " : "3 coasting, ") + width);
  if (o.coasting >= 0.01) names.push_back(o.coasting < 0.3 ? "4 coasting 1-30 %" : "5 coasting above 30 %");
  if (o.coasting >= 0.01) names.push_back("6 coasting, all");
  return names;
}

void print_case(const Outcome& o) {
  const GapEstimate& e = o.estimate;
  std::string failed;
  for (const ReadingTest& test : e.tested)
    if (!test.passed) failed += fmt::format(", not {}", test.what.code());
  fmt::print(
      "{} gap {:.3f} mrad ({:.0f} quanta), mass ratio {:.2f}, coasting {:.3f}: {} {:.3f} [{:.3f}, {:.3f}], "
      "above {:.3f} visible; {}; trust {}{}\n",
      o.seed, 1e3 * o.gap, o.gap / o.quantum, o.mass_ratio, o.coasting, to_string(e.verdict), 1e3 * e.gap,
      1e3 * e.ci95.low, 1e3 * e.ci95.high, 1e3 * e.smallest_visible_gap, e.reason.text(), to_string(e.trust),
      failed);
}

int main_study(int argc, char** argv) {
  if (argc < 5) {
    fmt::print(stderr,
               "study_sliding_mode FIRST_SEED COUNT gap|gap_free sine|triangle|trapezoid|multisine [each] "
               "[wide] [stream] [rubs] [pushed] [held] [slides]\n");
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t count = std::strtoull(argv[2], nullptr, 10);
  const bool with_gap = std::string(argv[3]) == "gap";
  const independent_plant::Waveform waveform = waveform_of(argv[4]);
  const auto asked = [&](const char* word) {
    return std::find(argv + 5, argv + argc, std::string(word)) != argv + argc;
  };
  const auto laws =
      asked("wide") ? independent_plant::DriveLaws::kWide : independent_plant::DriveLaws::kStated;
  std::map<std::string, Tally> tallies;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Outcome o = run(seed, with_gap, waveform, laws,
                          {asked("rubs"), asked("pushed"), asked("held"), asked("slides")}, asked("stream"));
    if (asked("each")) print_case(o);
    for (const std::string& name : classes(o)) tallies[name].add(o);
  }
  for (const auto& [name, tally] : tallies) tally.print(name);
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }
