#include "gapscope/diagnosis/next_experiment.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/text.h"
#include "diagnosis/candidates.h"
#include "diagnosis/counted.h"
#include "diagnosis/experiment_library.h"
#include "diagnosis/held_out.h"
#include "gapscope/simulation/simulate.h"
#include "signals/encoder.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

constexpr std::uint64_t kSeed = 1;  // of phases, levels and noise
const std::size_t kConfirmed =
    SearchEffort{}.leaders;   // inputs whose separation is checked from a second start
constexpr int kHalvings = 5;  // of an input that travels too far

/// Whether the law of one effect contains that of the other.
bool contains_law(const std::string& large, const std::string& small) {
  const EffectEntry* entry = find_effect(large);
  const EffectEntry* parent = entry != nullptr ? contained_effect(*entry) : nullptr;
  return parent != nullptr && parent->name == small;
}

struct Bench {
  std::span<const Rival> rivals;
  MotorTrace like;
  double noise = 0.0;  ///< of the encoder before it counts, rms [rad]
  double hz = kMeasure.slow_hz;
  std::size_t samples = 0;

  /// What the encoder would record of a rival; empty where its motion diverges.
  Recording play(const Rival& truth, const Excitation& input) const {
    SimulationOptions options;
    options.rate = 1.0 / like.dt;
    options.seed = kSeed;
    options.encoder = {like.quantum, noise};
    try {
      Recording r =
          simulate(stepper_of(truth.model, {&like, 1}), sample(input, options.rate, samples, kSeed), options);
      r.quantum = like.quantum;
      return r;
    } catch (const std::runtime_error&) {
      return {};
    }
  }

  /// Mean square of a rival's innovations once it is refitted, drive and effect [σ²].
  double left_by(const Rival& rival, const MotorTrace& seen, const ReferenceModel* drive) const {
    ReferenceModel from = rival.model;
    if (drive != nullptr)
      for (std::size_t i = 0; i < from.parameters.size(); ++i)
        from.parameters[i].value = drive->parameters[i].value;
    return fit_near({&seen, 1}, from, {}, hz, SearchEffort{}.quick).mean_cost;
  }

  Separation separate(const Rival& truth, const Rival& rival, const Recording& recorded, bool confirm) const {
    Separation s{truth.effect, rival.effect, kNaN, contains_law(rival.effect, truth.effect)};
    if (recorded.position().empty() || s.contained) return s;
    const MotorTrace seen = recorded.motor_trace();
    double left = left_by(rival, seen, nullptr);
    if (confirm) left = std::min(left, left_by(rival, seen, &truth.model));
    const double own = left_by(truth, seen, nullptr);
    s.excess = std::sqrt(std::max(0.0, left - own));
    return s;
  }

  TriedInput attempt(const Excitation& input, double most_travel, bool confirm) const {
    TriedInput tried{input, describe(input), 0.0, {}, kNaN};
    std::vector<Recording> recordings;
    for (int i = 0; i <= kHalvings; ++i) {
      stop_point();
      recordings.clear();
      tried.travel = 0.0;
      for (const Rival& truth : rivals) {
        recordings.push_back(play(truth, tried.excitation));
        const std::vector<double>& x1 = recordings.back().position();
        if (x1.empty()) return tried;
        const auto [low, high] = std::minmax_element(x1.begin(), x1.end());
        tried.travel = std::max(tried.travel, *high - *low);
      }
      if (tried.travel <= most_travel) break;
      if (i == kHalvings) return tried;
      tried.excitation = scaled(tried.excitation, 0.5);
      tried.input = describe(tried.excitation);
    }
    double worst = kInfinity;
    for (std::size_t t = 0; t < rivals.size(); ++t)
      for (std::size_t r = 0; r < rivals.size(); ++r) {
        if (r == t) continue;
        tried.separations.push_back(separate(rivals[t], rivals[r], recordings[t], confirm));
        const Separation& s = tried.separations.back();
        if (!s.contained) worst = std::min(worst, s.excess);
      }
    tried.worst = std::isfinite(worst) ? worst : kNaN;
    return tried;
  }
};

void sort_by_worst(std::vector<TriedInput>& tried) {
  std::stable_sort(tried.begin(), tried.end(), [](const TriedInput& a, const TriedInput& b) {
    return !std::isnan(a.worst) && (std::isnan(b.worst) || a.worst > b.worst);
  });
}

/// Inputs that were halved to stay within the travel may have become another one of the library.
void keep_each_once(std::vector<TriedInput>& tried) {
  std::vector<std::string> seen;
  std::erase_if(tried, [&](const TriedInput& t) {
    if (contains(seen, t.input)) return true;
    seen.push_back(t.input);
    return false;
  });
}

double peak_of(const MotorTrace& t) {
  double peak = 0.0;
  for (const double u : t.u) peak = std::max(peak, std::abs(u));
  return peak;
}

double travel_of(const MotorTrace& t) {
  const auto [low, high] = std::minmax_element(t.x1.begin(), t.x1.end());
  return *high - *low;
}

}  // namespace
}  // namespace internal::diagnosis

bool NextExperiment::separates() const {
  return proposes() && tried.front().worst >= internal::diagnosis::kTelling.separated;
}

NextExperiment next_experiment(std::span<const Rival> rivals, const MotorTrace& like,
                               const ExperimentLimits& limits, double observer_hz, int threads,
                               const std::function<void(const std::string&)>& progress) {
  using namespace internal::diagnosis;
  GAPSCOPE_REQUIRE(rivals.size() >= 2);
  const double floor = internal::signals::encoder_floor(like),
               counts = internal::signals::rounding_noise(like.quantum);
  const auto samples = static_cast<std::size_t>(limits.duration / like.dt);
  const Bench bench{rivals, like, std::sqrt(std::max(0.0, floor * floor - counts * counts)), observer_hz,
                    samples};
  const double most_travel = limits.travel.value_or(travel_of(like));
  const std::vector<Excitation> library = experiment_library(limits, limits.input.value_or(peak_of(like)));
  NextExperiment next;
  next.rate = 1.0 / like.dt, next.duration = limits.duration;
  next.tried.resize(library.size());
  Counted counted(progress, library.size() + std::min(kConfirmed, library.size()));
  const auto tell = [&] { counted.begin("looking for the experiment that would decide"); };
  parallel_for(library.size(), threads, [&](std::size_t i) {
    tell();
    if (excitation_problem(library[i], next.rate, next.duration).empty())
      next.tried[i] = bench.attempt(library[i], most_travel, false);
    else
      next.tried[i] = {library[i], describe(library[i]), kNaN, {}, kNaN};
  });
  sort_by_worst(next.tried);
  parallel_for(std::min(kConfirmed, next.tried.size()), threads, [&](std::size_t i) {
    tell();
    if (!std::isnan(next.tried[i].worst))
      next.tried[i] = bench.attempt(next.tried[i].excitation, most_travel, true);
  });
  std::stable_sort(next.tried.begin(), next.tried.begin() + std::min(kConfirmed, next.tried.size()),
                   [](const TriedInput& a, const TriedInput& b) { return a.worst > b.worst; });
  std::erase_if(next.tried, [](const TriedInput& t) { return std::isnan(t.worst); });
  keep_each_once(next.tried);
  if (next.proposes()) next.u = sample(next.tried.front().excitation, next.rate, samples, kSeed);
  return next;
}

}  // namespace gapscope
