#include "campaign/runner.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "campaign/recorded_data.h"
#include "campaign/store_header.h"
#include "config/configuration.h"
#include "gapscope/base/errors.h"
#include "gapscope/reference/fit_summary.h"
#include "results/sha256.h"
#include "run/run_pipeline.h"
#include "sliding_mode/bound_bank.h"

namespace gapscope {
namespace {

/// " (1.25 of the plant's)" for a number that is not the plant's.
std::string how_far_off(const FittedParameter& p, const SimulatedPlant& plant) {
  constexpr double kSame = 1e-9;
  for (int i = 0; i < kDriveParameterCount; ++i) {
    if (kDriveParameters[i].key != p.key || !has_parameter(plant.structure, i)) continue;
    const double own = drive_parameter(plant.drive, i);
    if (std::abs(p.value - own) <= kSame * std::abs(own)) return "";
    return own != 0.0 ? fmt::format(" ({:.3g} of the plant's)", p.value / own)
                      : fmt::format(" ({:.3g}, the plant has 0)", p.value);
  }
  return "";
}

bool has(const std::vector<EffectConfig>& effects, std::string_view name) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](const EffectConfig& e) { return name == e.effect.entry->name; });
}

std::string_view bytes_of(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

/// The numbers that the fit was told, with how far they are off where the plant has others:
/// "motor_inertia, contact_stiffness (1.25 of the plant's)".
std::string told_to(const FitSummary& fit, const Configuration& c) {
  std::vector<std::string> told;
  for (const std::string& key : fit.given())
    told.push_back(key + (c.simulation ? how_far_off(*fit.find(key), c.simulation->plant) : ""));
  return fmt::format("{}", fmt::join(told, ", "));
}

/// Effects, and the law of the contact, that the simulated plant has and the model has not:
/// "contact_adhesion". Empty where there are none, or where nobody knows the drive.
std::string lacked_by_model(const Configuration& c) {
  if (!c.simulation) return "";
  const SimulatedPlant& plant = c.simulation->plant;
  std::vector<std::string> lacks;
  for (const EffectConfig& e : plant.effects)
    if (const bool there = e.effect.parameters[0].value != 0.0;
        there && !has(c.model.effects, e.effect.entry->name))
      lacks.emplace_back(e.effect.entry->name);
  if (plant.structure.has_load && plant.structure.contact != c.model.structure.contact)
    lacks.emplace_back(plant.structure.contact == ContactLaw::kRigid ? "rigid contact" : "compliant contact");
  return fmt::format("{}", fmt::join(lacks, ", "));
}

/// Of the samples that the estimators read: the same text for the same samples alone.
std::string data_of(const std::vector<Recording>& recordings) {
  constexpr std::size_t kDigits = 16;
  std::string all;
  for (const Recording& r : recordings)
    for (const std::vector<double>* column : {&r.u, &r.x1}) all += sha256(bytes_of(*column));
  return sha256(all).substr(0, kDigits);
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A bound is no gap, nor is a play at zero torque, nor the first of several gaps.
bool tells_the_gap(const GapEstimate& g) {
  const bool has_interval = std::isfinite(g.ci95.low) && std::isfinite(g.ci95.high);
  return g.verdict == GapVerdict::kBacklash && g.quantity == GapQuantity::kGap &&
         (g.method == GapMethod::kLiteral || has_interval);
}

/// @param bound   that it was given; nothing: it takes its own from the recording
/// @param passes  differentiators that it runs over the recording
CampaignEstimate noted(const GapEstimate& g, const std::optional<double>& bound, double passes) {
  const bool found = g.verdict == GapVerdict::kBacklash;
  CampaignEstimate e;
  e.outcome = to_string(g.verdict);
  e.answers = tells_the_gap(g);
  e.reason = g.reason.text();
  e.reason_codes = g.reason.codes();
  e.gap = g.gap;
  e.std = g.std;
  e.ci95 = g.ci95;
  if (found) e.quantity = to_string(g.quantity);
  e.method = to_string(g.method);
  e.trust = to_string(g.trust);
  if (bound) e.told = fmt::format("L = {:.4g} rad/s^2", *bound);
  e.passes = passes;
  return e;
}

void note_model_free(const GapEstimate& g, const Configuration& c, CampaignRow& row) {
  row.model_free = noted(g, c.detector.bound, g.by_one_bound() ? 1.0 : static_cast<double>(kBankBounds));
  row.smallest_visible_gap = g.smallest_visible_gap;
  row.gap_at_most = g.gap_at_most;
  row.events = static_cast<double>(
      std::count_if(g.events.begin(), g.events.end(), [](const GapEvent& e) { return e.accepted; }));
}

CampaignEstimate noted(const FitSummary& f, const Configuration& c) {
  CampaignEstimate e;
  e.outcome = f.status == FitStatus::kConverged ? "converged"
              : f.status == FitStatus::kFailed  ? "failed"
                                                : "not_converged";
  e.reason = f.why.text();
  e.reason_codes = f.why.codes();
  e.method = "fit";
  e.trust = to_string(f.trust);
  e.told = told_to(f, c);
  e.passes = static_cast<double>(f.simulations);
  e.answers = false;
  const FittedParameter* gap = f.find("gap");
  if (gap == nullptr) return e;
  e.gap = gap->value;
  e.std = gap->std;
  e.ci95 = gap->ci95;
  e.quantity = to_string(GapQuantity::kGap);
  const Interval shown = f.shown_interval(*gap);
  e.answers = f.converged() && gap->estimated && std::isfinite(shown.low) && std::isfinite(shown.high);
  return e;
}

void note_result(const RunResult& r, const Configuration& c, CampaignRow& row) {
  row.data = data_of(r.recordings);
  row.samples = row.recorded = 0.0;
  for (const Recording& recording : r.recordings) {
    row.samples += static_cast<double>(recording.size());
    row.recorded += recording.duration();
  }
  row.true_gap = r.simulated_gap;
  if (r.literal) row.literal = noted(*r.literal, c.detector.literal, 1.0);
  if (r.model_free) note_model_free(*r.model_free, c, row);
  if (r.reference) {
    row.reference = noted(*r.reference, c);
    row.rmse = r.reference->rmse;
    row.lacks = lacked_by_model(c);
  }
  if (!r.comparison) return;
  row.difference = r.comparison->difference;
  row.joint_std = r.comparison->joint_std;
  row.agree = r.comparison->agree;
}

/// What went wrong, without the way to the configuration: a result does not depend on where it was made.
std::string reason_of(const std::exception& error, const CampaignConfig& c) {
  std::string text = error.what();
  const std::string name = std::filesystem::path(c.base_file).filename().string();
  if (text.starts_with(c.base_file)) text.replace(0, c.base_file.size(), name);
  return text;
}

std::vector<std::uint64_t> pending(const CampaignConfig& c, const CampaignStore& store) {
  const std::set<std::uint64_t> done = store.done();
  std::vector<std::uint64_t> runs;
  for (std::uint64_t i = 0; i < c.runs(); ++i)
    if (store.header().shard.holds(i) && !done.contains(i)) runs.push_back(i);
  return runs;
}

/// A run may have failed because a recording went away since the campaign began: that is no result of it.
void require_same_recordings(const CampaignConfig& c, const CampaignStore& store) {
  const CampaignHeader now = campaign_header(c, store.header().shard);
  if (const std::string what = internal::campaign::header_difference(store.header(), now); !what.empty())
    throw std::runtime_error("a recording changed while the campaign ran: its store " + what);
}

/// Reading may fail by passing trouble, of a disk or a network: only what fails alike once more is a result.
CampaignRow same_failure(const CampaignConfig& c, CampaignRow first, CampaignTiming& timing) {
  CampaignRow again = run_of_campaign(c, first.run, timing);
  if (!again.error.empty() && again.error != first.error)
    throw MachineError("reading fails in changing ways: " + first.error + "; " + again.error);
  return again;
}

}  // namespace

CampaignRow run_of_campaign(const CampaignConfig& c, std::uint64_t run, CampaignTiming& timing) {
  const auto begin = Clock::now();
  CampaignRow row;
  row.run = run;
  for (const AxisValue& value : campaign_point(c, run)) row.point.push_back(value.yaml);
  try {
    const Configuration configuration = campaign_run(c, run);
    row.configuration = resolved_yaml(configuration);
    row.seed =
        fmt::format("{}", configuration.simulation ? configuration.simulation->seed : configuration.fit.seed);
    const RunOutcome outcome = run_pipeline(
        configuration, {.model_free = c.model_free, .reference = c.reference, .literal = c.literal},
        [](const std::string&) {});
    note_result(outcome.result, configuration, row);
    timing.literal_s = outcome.timing.literal_s;
    timing.model_free_s = outcome.timing.model_free_s;
    timing.reference_s = outcome.timing.reference_s;
  } catch (const Interrupted&) {
    throw;
  } catch (const MachineError&) {  // no result: another time it may be one
    throw;
  } catch (const std::system_error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    row.error = reason_of(error, c);
  }
  timing.run_s = seconds_since(begin);
  return row;
}

CampaignProgress run_campaign(const CampaignConfig& c, CampaignStore& store, int threads,
                              const std::function<void(const CampaignProgress&)>& tell) {
  const auto begin = Clock::now();
  const std::vector<std::string> recordings = internal::campaign::recorded_files(c);
  const std::string state = internal::campaign::state_of(recordings);
  if (!recordings.empty()) require_same_recordings(c, store);
  const std::vector<std::uint64_t> runs = pending(c, store);
  CampaignProgress progress;
  progress.runs = store.header().shard.size(c.runs());
  progress.done = progress.runs - runs.size();
  std::mutex mutex;
  if (!runs.empty()) tell(progress);
  parallel_for(runs.size(), threads, [&](std::size_t i) {
    stop_point();
    CampaignTiming timing;
    CampaignRow row = run_of_campaign(c, runs[i], timing);
    const auto unchanged = [&] { return internal::campaign::state_of(recordings) == state; };
    if (!row.error.empty() && !recordings.empty() && unchanged())
      row = same_failure(c, std::move(row), timing);
    const bool failed = !row.error.empty();
    if (failed) require_same_recordings(c, store);
    if (!unchanged())
      throw std::runtime_error(
          "a recording changed while the campaign ran: where it is as before, the same command goes on");
    store.add(std::move(row), timing);
    const std::lock_guard lock(mutex);
    ++progress.done;
    ++progress.fresh;
    progress.failed += failed ? 1 : 0;
    progress.elapsed_s = seconds_since(begin);
    tell(progress);
  });
  return progress;
}

CampaignForecast forecast(const CampaignConfig& c, const CampaignShard& shard, int threads) {
  constexpr std::uint64_t kMost = 8;  // runs to try
  constexpr double kPatience = 20.0;  // [s]
  const std::uint64_t tried = std::min(kMost, c.runs());
  const auto begin = Clock::now();
  CampaignForecast f;
  for (std::uint64_t k = 0; k < tried && seconds_since(begin) < kPatience; ++k) {
    stop_point();
    CampaignTiming timing;
    run_of_campaign(c, tried > 1 ? k * (c.runs() - 1) / (tried - 1) : 0, timing);
    ++f.measured;
  }
  f.run_s = seconds_since(begin) / f.measured;
  f.total_s = f.run_s * static_cast<double>(shard.size(c.runs())) / thread_count(threads);
  return f;
}

}  // namespace gapscope
