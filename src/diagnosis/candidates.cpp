#include "diagnosis/candidates.h"

#include <algorithm>
#include <cmath>

#include "reference/search.h"
#include "reference/starts.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr int kRaceSteps = 2;           ///< to tell which start is worth more
constexpr Work kLight{2, 8, 1e-3};      ///< to tell whether a candidate helps at all
constexpr Work kThorough{5, 25, 3e-4};  ///< of those that do
constexpr Work kNominal{8, 40, 1e-5};
constexpr Work kRetry{8, 40, 1e-4};    ///< of the few that came nearest
constexpr double kPromising = 0.9;     ///< of the mean square without the effect
constexpr double kFurther = 0.995;     ///< of the mean square: a retry that got further
constexpr double kFloorSquare = 1.25;  ///< mean square [floor²] at which no other start can be better
constexpr double kSmallSine = 0.1;     ///< of the start: there it acts in proportion
constexpr int kWeakenings = 2;
constexpr double kWeaker = 0.15;  ///< of the start
constexpr double kClose = 30.0;   ///< a start from elsewhere is followed while it is within this ratio

ParameterSetting& setting(ReferenceModel& model, int number) {
  if (number < kDriveParameterCount) return model.parameters[static_cast<std::size_t>(number)];
  const int rest = number - kDriveParameterCount;
  return model.effects[static_cast<std::size_t>(rest / kMostEffectParameters)]
      .parameters[static_cast<std::size_t>(rest % kMostEffectParameters)];
}

FittedModel with_values(ReferenceModel model, const reference::FitProblem& problem,
                        const reference::Solution& at) {
  const reference::ModelNumbers<double> numbers = problem.numbers(at.q.data());
  for (const reference::Parameter& p : problem.parameters)
    setting(model, p.number).value = numbers[static_cast<std::size_t>(p.number)];
  return model;
}

/// The solver's vector of a model's own values, as far as it has them; else where the problem starts.
std::vector<double> point_of(const reference::FitProblem& problem, ReferenceModel values) {
  std::vector<double> q;
  const std::size_t known = kDriveParameterCount + values.effects.size() * kMostEffectParameters;
  for (std::size_t i = 0; i < problem.free_count(); ++i) {
    const reference::Parameter& p = problem.free_parameter(i);
    const bool has = static_cast<std::size_t>(p.number) < known;
    const double value = has ? setting(values, p.number).value : p.start;
    q.push_back(p.coordinate.solver(std::clamp(std::isnan(value) ? p.start : value, p.low, p.high)));
  }
  return q;
}

/// Keys of the last effect's parameters that have ended at a bound.
std::vector<std::string> at_bounds(const ReferenceModel& model, const reference::FitProblem& problem,
                                   const reference::Solution& at) {
  std::vector<std::string> keys;
  if (model.effects.empty()) return keys;
  const EffectEntry& last = *model.effects.back().entry;
  const int first = kDriveParameterCount + static_cast<int>(model.effects.size() - 1) * kMostEffectParameters;
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    if (const reference::Parameter& p = problem.free_parameter(i); p.number >= first && p.at_bound(at.q[i]))
      keys.emplace_back(last.parameters[static_cast<std::size_t>(p.number - first)].key);
  return keys;
}

Fitted fitted_of(const ReferenceModel& model, const reference::FitProblem& problem,
                 const reference::Solution& best) {
  const auto is_number = [](double q) { return std::isfinite(q); };
  if (!best.usable() || !std::all_of(best.q.begin(), best.q.end(), is_number))
    return {model, {}, kInfinity, {}};
  return {with_values(model, problem, best), best.starts, best.mean_square, at_bounds(model, problem, best)};
}

/// Refined, with the loads' places at the beginning of the recordings chosen before and after.
reference::Solution descend(const reference::FitProblem& problem, reference::Solution point, double hz,
                            const Work& work = kNominal) {
  reference::choose_variants(problem, point, hz);
  reference::Solution found = refine(problem, point, hz, work);
  if (!found.usable() || !reference::choose_variants(problem, found, hz)) return found;
  const reference::Solution again = refine(problem, found, hz, work);
  return again.mean_square < found.mean_square ? again : found;
}

/// A point after the race, and the values that it set out from.
struct Raced {
  reference::Solution at;
  std::size_t origin = 0;
};

/// A refinement that goes on only while it promises to beat the model without the effect.
reference::Solution follow(const reference::FitProblem& problem, const reference::Solution& from, double hz,
                           double without) {
  const reference::Solution light = refine(problem, from, hz, kLight);
  if (!light.usable()) return from;
  if (!(light.mean_square < kPromising * without)) return light;
  const reference::Solution found = refine(problem, light, hz, kThorough);
  return found.mean_square < light.mean_square ? found : light;
}

/// Follows the best of the race, then the best from elsewhere.
/// @param without mean square of the model without the effect
reference::Solution best_of(const reference::FitProblem& problem, std::vector<Raced> raced, double hz,
                            double without) {
  std::stable_sort(raced.begin(), raced.end(),
                   [](const Raced& a, const Raced& b) { return a.at.mean_square < b.at.mean_square; });
  if (raced.empty()) return {};  // nothing to start from
  const Raced* first = &raced.front();
  if (!first->at.usable()) return first->at;
  reference::Solution best = follow(problem, first->at, hz, without);
  for (const Raced& other : raced) {
    if (best.mean_square < kFloorSquare) break;
    if (other.origin == first->origin || other.at.mean_square > kClose * first->at.mean_square) continue;
    const reference::Solution found = follow(problem, other.at, hz, without);
    if (found.mean_square < best.mean_square) best = found;
    break;
  }
  return best;
}

/// Physical values of an effect's start.
std::vector<double> effect_values(const reference::FitProblem& problem, const EffectEntry& entry,
                                  const EffectStart& start) {
  std::vector<double> values;
  const std::size_t first = problem.parameters.size() - entry.parameters.size();
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const reference::Parameter& p = problem.parameters[first + i];
    values.push_back(std::clamp(start[i] * p.high / entry.parameters[i].high, p.low, p.high));
  }
  return values;
}

/// Parameter i nearer to where the effect is absent.
double weaker(const reference::FitProblem& problem, const EffectEntry& entry, std::size_t i, double value) {
  const EffectParameterSpec& spec = entry.parameters[i];
  const reference::Parameter& p = problem.parameters[problem.parameters.size() - entry.parameters.size() + i];
  const double absent = spec.absent * p.high / spec.high;
  return std::isfinite(absent) ? absent + kWeaker * (value - absent) : std::min(value / kWeaker, p.high);
}

/// Whether the model's last effect is the simpler one that this one contains, and so takes the place of.
bool replaces_last(const ReferenceModel& model, const EffectEntry& entry) {
  return !model.effects.empty() && contained_effect(entry) == model.effects.back().entry;
}

ReferenceModel with_effect(ReferenceModel model, const EffectEntry& entry) {
  if (replaces_last(model, entry)) model.effects.pop_back();
  ModelEffect effect;
  effect.entry = &entry;
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) effect.parameters[i].estimate = true;
  model.effects.push_back(effect);
  return model;
}

/// A model with the values of another drive: its own effects stay.
ReferenceModel with_drive(ReferenceModel model, const ReferenceModel& drive) {
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (!std::isnan(drive.parameters[i].value)) model.parameters[i].value = drive.parameters[i].value;
  return model;
}

/// The parent's fit carried over: its drive, and its first parameter for ours.
ReferenceModel from_parent(const ReferenceModel& extended, const Fitted& parent, std::vector<double> values) {
  ReferenceModel point = with_drive(extended, parent.model);
  values[0] = parent.model.effects.back().parameters[0].value;
  for (std::size_t i = 0; i < values.size(); ++i) point.effects.back().parameters[i].value = values[i];
  return point;
}

/// A fitted model once more with more work, from where it stands.
Fitted refined(std::span<const MotorTrace> train, const Fitted& from, const FitOptions& options, double hz) {
  const reference::FitProblem problem = reference::make_problem(train, from.model, options);
  const reference::Solution point{point_of(problem, from.model), from.starts, kInfinity, false};
  return fitted_of(from.model, problem, refine(problem, point, hz, kRetry));
}

}  // namespace

Fitted fit_nominal(std::span<const MotorTrace> train, const ReferenceModel& model, const FitOptions& options,
                   double hz) {
  const reference::FitProblem problem = reference::make_problem(train, model, options);
  reference::Solution best;
  if (reference::values_are_given(problem)) best = descend(problem, reference::given_point(problem), hz);
  if (!(best.mean_square <= kFloorSquare))
    if (const reference::Solution found = reference::find_minima(problem).best(); found.usable())
      if (const reference::Solution other = descend(problem, found, hz); other.mean_square < best.mean_square)
        best = other;
  return fitted_of(model, problem, best);
}

Fitted fit_near(std::span<const MotorTrace> recordings, const FittedModel& from, const FitOptions& options,
                double hz, const Work& work) {
  const reference::FitProblem problem = reference::make_problem(recordings, from, options);
  reference::Solution point = reference::given_point(problem);
  point.starts =
      settled_starts(recordings, from, hz);  // else the numbers would move for the load's first place
  return fitted_of(from, problem, descend(problem, point, hz, work));
}

std::vector<Base> bases_of(std::span<const MotorTrace> train, const Fitted& nominal,
                           const ReferenceModel& sheet, const FitOptions& options, double hz) {
  const reference::FitProblem problem = reference::make_problem(train, nominal.model, options);
  std::vector<Base> bases;
  for (const ReferenceModel& values : {nominal.model, with_drive(nominal.model, sheet)}) {
    Base base{point_of(problem, values), {}};
    base.recordings = linearise(problem, {base.q, nominal.starts, kInfinity, false}, hz);
    if (!base.recordings.empty()) bases.push_back(std::move(base));
  }
  return bases;
}

Fitted fit_candidate(std::span<const MotorTrace> train, const Fitted& nominal, std::span<const Base> bases,
                     const EffectEntry& entry, std::span<const EffectStart> starts, const Fitted* parent,
                     const FitOptions& options, double hz) {
  const ReferenceModel extended = with_effect(nominal.model, entry);
  const reference::FitProblem problem = reference::make_problem(train, extended, options);
  const std::size_t shrinking = replaces_last(nominal.model, entry) ? 1 : 0;  // the base has the first one
  std::vector<Raced> raced;
  const auto race = [&](const ReferenceModel& values, const Base* base) {
    reference::Solution point{point_of(problem, values), nominal.starts, kInfinity, false};
    if (base != nullptr) std::copy(base->q.begin(), base->q.end(), point.q.begin());
    const Base& borrowed = base != nullptr ? *base : bases.front();
    const std::size_t origin = base != nullptr ? static_cast<std::size_t>(base - bases.data()) : bases.size();
    raced.push_back({adjust(problem, point, borrowed.recordings, hz, kRaceSteps), origin});
  };
  const auto race_effect = [&](const std::vector<double>& values, const Base& base) {
    ReferenceModel point = extended;
    for (std::size_t i = 0; i < values.size(); ++i) point.effects.back().parameters[i].value = values[i];
    race(point, &base);
  };
  for (const Base& base : bases) {
    if (entry.start_search != StartSearch::kSine || starts.empty()) break;
    std::vector<double> values = effect_values(problem, entry, starts.front());
    reference::Solution point{point_of(problem, extended), nominal.starts, kInfinity, false};
    std::copy(base.q.begin(), base.q.end(), point.q.begin());
    const auto sine = sine_start(problem, point, base.recordings, kSmallSine * values[0], hz);
    if (sine) race_effect({sine->amplitude, sine->phase}, base);
  }
  for (const EffectStart& start : starts) {
    std::vector<double> values = effect_values(problem, entry, start);
    for (const Base& base : bases) race_effect(values, base);
    if (parent != nullptr && !bases.empty()) {
      race(from_parent(extended, *parent, values), nullptr);
      values[1] = weaker(problem, entry, 1, values[1]);  // nearly the parent itself
      race(from_parent(extended, *parent, values), nullptr);
    }
    // An effect far smaller than the start only hurts there.
    for (int i = 0; parent == nullptr && i < kWeakenings && !bases.empty() &&
                    !(raced.back().at.mean_square < nominal.mean_square);
         ++i) {
      values[shrinking] = weaker(problem, entry, shrinking, values[shrinking]);
      race_effect(values, bases.front());
    }
  }
  return fitted_of(extended, problem, best_of(problem, std::move(raced), hz, nominal.mean_square));
}

Fitted led_by_faster_observer(std::span<const MotorTrace> train, const Fitted& candidate,
                              const FitOptions& options, double hz) {
  const Fitted led = refined(train, candidate, options, kFastHz);
  return led.mean_square < kInfinity ? refined(train, led, options, hz) : led;
}

Fitted retry(std::span<const MotorTrace> train, const Fitted& candidate, const FittedModel& other,
             const ReferenceModel& sheet, const FitOptions& options, double hz) {
  const EffectEntry* mine = candidate.model.effects.back().entry;
  const EffectEntry* others = other.effects.back().entry;
  ReferenceModel moved = with_drive(candidate.model, other);
  if (contained_effect(*others) == mine || contained_effect(*mine) == others)
    moved.effects.back().parameters[0].value = other.effects.back().parameters[0].value;
  // By the numbers of the model without the effect the load may have seemed to start elsewhere.
  const std::vector<reference::RecordingStart> settled = settled_starts(train, candidate.model, hz);
  Fitted best = candidate;
  const auto take = [&](Fitted found) {
    if (found.mean_square < kFurther * best.mean_square) best = std::move(found);
  };
  for (const ReferenceModel& values : {candidate.model, moved, with_drive(candidate.model, sheet)})
    take(refined(train, {values, settled, kInfinity, {}}, options, hz));
  if (!(best.mean_square < kFloorSquare) && hz < kFastHz)
    take(led_by_faster_observer(train, candidate, options, hz));
  return best;
}

bool is_candidate(const EffectEntry& entry, const ReferenceModel& model) {
  for (const ModelEffect& e : model.effects)
    if (e.entry == &entry || contained_effect(*e.entry) == &entry) return false;
  if (entry.stands_for >= 0 && model.parameters[static_cast<std::size_t>(entry.stands_for)].estimate)
    return false;
  const bool has_load = model.structure.has_load;
  const ParameterSetting& gap = model.parameters[place::kGap];
  switch (entry.needs) {
    case EffectNeeds::kNothing:
      return true;
    case EffectNeeds::kNoGap:
      return !has_load || (!gap.estimate && !(gap.value > 0.0));
    case EffectNeeds::kContact:
      return has_load && model.structure.contact == ContactLaw::kCompliant;
    case EffectNeeds::kGap:
      return has_load && gap.value > 0.0;
    case EffectNeeds::kFreeLoad:
      return !has_load || model.structure.load == LoadKind::kFree;
  }
  return true;
}

}  // namespace gapscope::internal::diagnosis
