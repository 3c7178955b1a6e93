#include "gapscope/campaign/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>

#include "campaign/recorded_data.h"
#include "campaign/store_header.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/parallel.h"
#include "gapscope/run/run_pipeline.h"

namespace gapscope {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void note_model_free(const GapEstimate& g, CampaignRow& row) {
  row.verdict = to_string(g.verdict);
  row.reason = g.reason.text();
  row.reason_codes = g.reason.codes();
  row.gap = g.gap;
  row.std = g.std;
  row.ci95 = g.ci95;
  row.smallest_visible_gap = g.smallest_visible_gap;
  row.events = static_cast<double>(
      std::count_if(g.events.begin(), g.events.end(), [](const GapEvent& e) { return e.accepted; }));
}

void note_reference(const FitSummary& f, CampaignRow& row) {
  row.status = f.status == FitStatus::kConverged ? "converged"
               : f.status == FitStatus::kFailed  ? "failed"
                                                 : "not_converged";
  row.reference_trust = to_string(f.trust);
  row.rmse = f.rmse;
  const FittedParameter* gap = f.find("gap");
  if (gap == nullptr) return;
  row.reference_gap = gap->value;
  row.reference_std = gap->std;
  row.reference_ci95 = gap->ci95;
}

void note_result(const RunResult& r, CampaignRow& row) {
  row.true_gap = r.simulated_gap;
  if (r.model_free) note_model_free(*r.model_free, row);
  if (r.reference) note_reference(*r.reference, row);
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
    const RunOutcome outcome =
        run_pipeline(configuration, {c.model_free, c.reference}, [](const std::string&) {});
    note_result(outcome.result, row);
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
