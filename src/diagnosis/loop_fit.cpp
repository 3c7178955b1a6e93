#include "gapscope/diagnosis/loop_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "base/text.h"
#include "diagnosis/few_recordings.h"
#include "diagnosis/loop_additions.h"
#include "diagnosis/loop_fitter.h"
#include "diagnosis/loop_numbers.h"
#include "recording/supply.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

constexpr double kWorthHaving = 0.02;  ///< of the error, that an addition takes
constexpr int kFirstSteps = 8, kTrySteps = 4, kLastSteps = 20;
constexpr std::size_t kTriedOn = 4;      ///< beginnings of additions that come nearest after one step
constexpr double kBetweenRows = 1000.0;  ///< rate of a firmware's own loop [Hz]
/// Rates of a firmware's own loop that are tried: whole parts of 2 kHz [Hz]. Turns of another rate slip past
/// the rows within a recording and leave as much as no phase at all.
constexpr double kRates[] = {2000.0, kBetweenRows, 500.0, 400.0, 1000.0 / 3.0, 250.0, 200.0};
/// Of the error, that the next best rate leaves more where the rate is told. Of 12 servos of one simulator
/// whose margins were read, all with the right rate first, it tells 9, half 10, double 4; 2 % told one of 15
/// wrong.
constexpr double kTellsRate = 0.05;
constexpr int kTurnRounds = 3;         ///< of phases and numbers with each rate
constexpr int kTurnSteps = 2;          ///< of the numbers' fit in each
constexpr std::size_t kLastRates = 3;  ///< that get as many rounds again, and as many without delays
constexpr double kSlips = 0.25;  ///< of a turn, by which a rate that is off slips in a recording at least

double longest(std::span<const MotorTrace> recordings) {
  double seconds = 0.0;
  for (const MotorTrace& t : recordings) seconds = std::max(seconds, t.elapsed(t.size() - 1));
  return seconds;
}

/// What the recordings ask for, one after the other.
class LoopBuilder {
 public:
  LoopBuilder(std::span<const MotorTrace> all, const DriveController& declared, const LoopFitOptions& options)
      : all_(all),
        few_(few_of(all)),
        fitter_(few_, options.threads),
        declared_(declared),
        options_(options) {}

  /// All that they ask for. A limit that was not reached is looked for once more when all else is there.
  void complete(Loop& loop, std::vector<LoopPart>& parts) const {
    add_to(loop, parts);
    settle_rate(loop);
    thin_out(loop, parts);
  }

  /// At the rows, or between them: once what is missing is there, as an update at the rows alone is late,
  /// too.
  void settle_rate(Loop& loop) const {
    if (!options_.rate_is_sought) return;
    Loop other = loop;
    other.controller.rate = loop.controller.rate > 0.0 ? 0.0 : kBetweenRows;
    const double least = refine(loop, kTrySteps);
    if (refine(other, kTrySteps) < (1.0 - kWorthHaving) * least) loop = other;
  }

  /// Adds what helps most, until nothing does.
  void add_to(Loop& loop, std::vector<LoopPart>& parts) const {
    std::vector<Loop> from{loop};
    double least = refine(loop, kFirstSteps);
    from.push_back(loop);
    if (std::optional<Loop> held = held_at_rest(loop, few_)) {
      from.push_back(*held);
      const double error = refine(*held, kFirstSteps);
      if (error * (1.0 - kWorthHaving) < least) loop = *held, least = error;
    }
    while (least > all_.front().quantum) {
      const std::vector<LoopAddition> left = additions_to(loop, few_);
      options_.progress(
          fmt::format("fitting the closed loop: {} added, {} to try", parts.size(), left.size()));
      const Try best = best_of(left, from);
      if (!(best.error < (1.0 - kWorthHaving) * least)) return;
      loop = best.loop, least = best.error, from = {loop};
      const std::vector<LoopPart>& added = left[best.which].parts;
      parts.insert(parts.end(), added.begin(), added.end());
    }
  }

  /// What came first may be what a later part is: each is left out once, and stays out where nothing is lost.
  void thin_out(Loop& loop, std::vector<LoopPart>& parts) const {
    double least = refine(loop, kFirstSteps);
    for (auto part = parts.begin(); part != parts.end();) {
      Loop without = loop;
      part->take_out(without);
      const double error = refine(without, kFirstSteps);
      const bool is_needed = least < (1.0 - kWorthHaving) * error;
      if (!is_needed) loop = without, least = error;
      part = is_needed ? part + 1 : parts.erase(part);
    }
  }

  /// What came first may be what stood for another: each is left out once, and what explains most takes its
  /// place.
  void exchange(Loop& loop, std::vector<LoopPart>& parts) const {
    double least = refine(loop, kFirstSteps);
    for (std::size_t p = 0, count = parts.size(); p < count; ++p) {
      Loop without = loop;
      parts[p].take_out(without);
      const std::vector<LoopAddition> others = additions_to(without, few_);
      const Try best = best_of(others, {without});
      if (!(best.error < (1.0 - kWorthHaving) * least)) continue;
      loop = best.loop, least = best.error;
      const std::vector<LoopPart>& of = others[best.which].parts;
      parts[p] = of.front();
      parts.insert(parts.end(), of.begin() + 1, of.end());
    }
  }

  /// The rate of the firmware's own turns: goals take effect at turns alone, which shows in a recording that
  /// has one phase from its first row to its last. With free delays, or none: a goal that arrives at a turn
  /// is taken up in it, or with the least delay a turn later.
  /// @param bare  the loop without the delays that were left free
  /// @returns whether the recordings tell it from the others that are tried
  bool settle_turns(Loop& loop, const Loop& bare) const {
    if (!options_.rate_is_sought || loop.controller.rate == 0.0) return false;
    options_.progress("looking for the turns of the firmware");
    std::vector<Turns> tried;
    for (const double rate : kRates) tried.push_back(turns_of(at_rate(rate, loop)));
    const auto nearer = [](const Turns& a, const Turns& b) { return a.error < b.error; };
    std::ranges::stable_sort(tried, nearer);
    for (std::size_t k = 0; k < kLastRates; ++k) {
      const double rate = tried[k].loop.controller.rate;
      tried.push_back(turns_of(at_rate(rate, bare)));
      tried[k] = turns_of(tried[k].loop);
    }
    std::ranges::stable_sort(tried, nearer);
    loop = tried[0].loop;
    const auto other = std::ranges::find_if(
        tried, [&](const Turns& t) { return t.loop.controller.rate != loop.controller.rate; });
    const double rounding = 0.25 * few_.front().quantum;  // of a count, in the mean
    return std::max(tried[0].error, rounding) < (1.0 - kTellsRate) * std::max(other->error, rounding);
  }

  /// Share of the error that its law leaves, over the law that was declared.
  double left_by_law(const Loop& loop, const std::vector<LoopPart>& parts) const {
    Loop declared = loop;
    for (const LoopPart& part : parts)
      if (part.of_law) part.take_out(declared);
    return fitter_.error(loop) / refine(declared, kFirstSteps);
  }

 private:
  struct Try {
    Loop loop;
    std::size_t which = 0;  ///< of the additions
    double error = kLost;
  };

  double refine(Loop& loop, int steps) const {
    return fitter_.refine(loop, places_of(loop, declared_, options_), steps);
  }

  struct Turns {
    Loop loop;
    double error;
  };

  /// Phases and numbers in turn, as each waits for the other.
  Turns turns_of(Loop loop) const {
    LoopFitter fitter = fitter_;
    double error = kLost;
    for (int round = 0; round < kTurnRounds; ++round) {
      fitter.find_phases(loop);
      error = fitter.refine(loop, places_of(loop, declared_, options_), kTurnSteps);
    }
    return {loop, error};
  }

  /// Every one gets a step, and those that come nearest the others.
  Try best_of(const std::vector<LoopAddition>& additions, const std::vector<Loop>& from) const {
    std::vector<Try> tries;
    for (std::size_t a = 0; a < additions.size(); ++a)
      for (const double start : additions[a].starts)
        for (const Loop& loop : from) {
          Try t{loop, a};
          additions[a].put(t.loop, start);
          t.error = refine(t.loop, 1);
          tries.push_back(std::move(t));
        }
    const auto nearer = [](const Try& a, const Try& b) { return a.error < b.error; };
    std::ranges::stable_sort(tries, nearer);
    tries.resize(std::min(tries.size(), kTriedOn));
    for (Try& t : tries) t.error = refine(t.loop, kTrySteps);
    return tries.empty() ? Try() : *std::ranges::min_element(tries, nearer);
  }

  std::span<const MotorTrace> all_;
  std::vector<MotorTrace> few_;
  LoopFitter fitter_;
  const DriveController& declared_;
  const LoopFitOptions& options_;
};

}  // namespace
}  // namespace internal::diagnosis

namespace id = internal::diagnosis;

std::optional<LoopFit> fit_in_loop(std::span<const MotorTrace> recordings, const ReferenceModel& model,
                                   const DriveController& controller, const LoopFitOptions& options) {
  GAPSCOPE_REQUIRE(!recordings.empty());
  id::LoopFitter fitter(recordings, options.threads);
  id::Loop loop{id::bounded(model), controller};
  LoopFit fit;
  fit.mae_before = fitter.error(loop);
  if (options.rate_is_sought) loop.controller.rate = id::kBetweenRows;
  if (!(fit.mae_before < id::kLost)) return {};
  options.progress("fitting the closed loop");
  const id::LoopBuilder builder(recordings, controller, options);
  std::vector<id::LoopPart> parts;
  builder.complete(loop, parts);
  builder.exchange(loop, parts);
  builder.complete(loop, parts);
  fit.left_by_law = builder.left_by_law(loop, parts);
  for (const id::LoopPart& part : parts) fit.added.push_back(part.key);
  const id::Loop bare = loop;
  id::free_timing(loop, controller, recordings.front().dt);
  if (builder.settle_turns(loop, bare)) {
    const double rate = loop.controller.rate, slip = id::kSlips / id::longest(recordings);
    fit.added.push_back("controller.rate");
    fit.numbers.push_back({fit.added.back(), "Hz", rate, {rate - slip, rate + slip}});
  }
  const std::vector<id::LoopPlace> free = id::places_of(loop, controller, options);
  fitter.find_phases(loop);
  fit.mae_after = fitter.refine(loop, free, id::kLastSteps);
  const Eigen::VectorXd spread = fitter.spread(loop, free);
  for (std::size_t k = 0; k < free.size(); ++k)
    fit.numbers.push_back(free[k].told(loop, spread(static_cast<Eigen::Index>(k))));
  if (is_supplied(*recordings.front().command))
    for (LoopNumber& n : fit.numbers)
      if (n.key.starts_with("controller.")) n.unit = replaced(n.unit, "unit of u", "duty");
  fit.model = loop.model, fit.controller = loop.controller;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    fit.model.parameters[i].low = model.parameters[i].low;
  for (const MotorTrace& trace : recordings)
    fit.fitted_runs.push_back(run_in_loop(trace, fit.model, fit.controller));
  return fit;
}

HeldOutRun run_in_loop(const MotorTrace& recording, const ReferenceModel& model,
                       const DriveController& controller) {
  HeldOutRun run;
  run.file = recording.file, run.closed = true;
  run.from = recording.time(0), run.to = recording.time(recording.size() - 1);
  const id::Loop loop{model, controller};
  const std::vector<double> x = id::positions_at(id::phase_of(loop, recording), loop, recording);
  if (x.empty()) return run;
  const double centre = mean(recording.x1);
  double square = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    square += std::pow(recording.x1[i] - x[i], 2);
    moved += std::pow(recording.x1[i] - centre, 2);
  }
  run.rmse = std::sqrt(square / static_cast<double>(x.size()));
  run.mae = id::mean_error(recording, x);
  if (moved > 0.0) run.fit = 100.0 * (1.0 - std::sqrt(square / moved));
  return run;
}

}  // namespace gapscope
