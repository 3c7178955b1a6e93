// `campaign`: one configuration, thousands of runs; its export and the merging of its shards.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "campaign/runner.h"
#include "campaign/summary.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "gapscope/base/errors.h"
#include "report/campaign_report.h"
#include "results/campaign_summary.h"
#include "results/report_folder.h"

namespace gapscope::cli {
namespace {

struct CampaignArguments {
  std::string config;
  std::string folder;
  int threads = 0;
  std::string shard;
  bool dry_run = false;
  bool quiet = false, untitled = false;
  FigureFormats figures;
};

/// "K/N" with 1 ≤ K ≤ N.
CampaignShard shard_of(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  const auto number = [&](const std::string& part) -> std::uint64_t {
    const bool digits =
        !part.empty() && part.size() < 10 && part.find_first_not_of("0123456789") == part.npos;
    return digits ? std::stoull(part) : 0;
  };
  const CampaignShard shard{number(text.substr(0, slash)),
                            slash == text.npos ? 0 : number(text.substr(slash + 1))};
  if (shard.number < 1 || shard.number > shard.of)
    throw ConfigError(fmt::format("gapscope: --shard is '{}', expected K/N with K from 1 to N", text));
  return shard;
}

std::string default_folder(const CampaignConfig& c, const CampaignShard& shard) {
  const std::string folder = "reports/" + c.name;
  return shard.of == 1 ? folder : fmt::format("{}_shard_{}_of_{}", folder, shard.number, shard.of);
}

/// "45 s", "12 min", "3.5 h"
std::string duration(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

/// One line on a terminal that is written over and over, at most five times a second.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() {
    if (begun_) fmt::print(stderr, "\n");
  }
  void operator()(const CampaignProgress& p) {
    const auto now = std::chrono::steady_clock::now();
    const bool last = p.done == p.runs;
    if (!shown_ || (!last && begun_ && now - told_ < std::chrono::milliseconds(200))) return;
    told_ = now;
    begun_ = true;
    const std::string left =
        p.fresh > 0 ? fmt::format(", {:.2f} runs/s, about {} left", p.rate(), duration(p.left_s())) : "";
    fmt::print(stderr, "\r{:>5}  {} of {} runs{}{}\033[K", stopwatch(p.elapsed_s), p.done, p.runs, left,
               p.failed > 0 ? fmt::format(", {} failed", p.failed) : "");
    std::fflush(stderr);
  }

 private:
  bool shown_, begun_ = false;
  std::chrono::steady_clock::time_point told_;
};

void dry_run(const CampaignConfig& c, const CampaignShard& shard, int threads) {
  const std::uint64_t runs = shard.size(c.runs());
  say("runs", shard.of == 1 ? fmt::format("{}", runs)
                            : fmt::format("{} of {} (shard {})", runs, c.runs(), to_string(shard)));
  const CampaignForecast f = forecast(c, shard, threads);
  say("time", fmt::format("about {} on {} threads ({} runs tried, {:.2f} s each)", duration(f.total_s),
                          thread_count(threads), f.measured, f.run_s));
  std::uint64_t shown = 0;
  for (std::uint64_t run = 0; run < c.runs() && shown < 3; ++run)
    if (shard.holds(run)) {
      fmt::print("---\n{}", resolved_yaml(campaign_run(c, run)));
      ++shown;
    }
}

/// The report of a campaign of which every run is there, else the list of what is there.
void report_whole(ReportFolder& report, const std::string& folder, const CampaignTimes& times,
                  const CampaignSummary& summary, const FigureFormats& figures) {
  const bool whole = summary.done >= summary.runs;
  if (whole) {
    write_campaign_summary(report.path(), summary);
    write_campaign_times(report.path(), times);
    write_campaign_report(report.path(), figures);
  }
  stop_point();
  report.commit();
  if (!whole) return;
  say("report", folder + "/report.html");
  for (const std::string& line : which_estimator(summary)) fmt::print("{}\n", line);
}

CampaignSummary run_and_summarise(const CampaignConfig& c, const CampaignShard& shard,
                                  const std::string& folder, const CampaignArguments& a) {
  CampaignStore store(folder, campaign_header(c, shard));
  ProgressLine line(a.quiet);
  const CampaignProgress p = run_campaign(c, store, a.threads, std::ref(line));
  say("store", folder + "/results.sqlite");
  say("runs", fmt::format("{} ({} of them now{})", p.done, p.fresh,
                          p.failed > 0 ? fmt::format(", {} failed", p.failed) : ""));
  return shard.of == 1 ? summarise(store) : CampaignSummary();
}

void run(const CampaignArguments& a) {
  const CampaignConfig c = load_campaign(a.config);
  const CampaignShard shard = shard_of(a.shard);
  if (a.dry_run) return dry_run(c, shard, a.threads);
  const std::string folder = a.folder.empty() ? default_folder(c, shard) : a.folder;
  const std::vector<std::string> inputs = {a.config};
  ReportFolder(folder, FolderKind::kCampaign, inputs).leave();  // the store keeps others out from here on
  const auto summary = run_and_summarise(c, shard, folder, a);
  ReportFolder report(folder, FolderKind::kCampaign, inputs);
  const CampaignTimes times = times_of(CampaignStore(folder));  // closed again before its folder is listed
  if (shard.of == 1) return report_whole(report, folder, times, summary, a.figures);
  report.commit();
}

void add_export(CommandLine& campaign) {
  auto folder = std::make_shared<std::string>();
  auto times = std::make_shared<bool>(false);
  CommandLine command = campaign.add_command("export", "The runs of a campaign as CSV on standard output");
  command.add_option("DIR", *folder, "folder of a campaign").required();
  command.add_flag("--times", *times,
                   "with the wall times of each run, which differ from machine to machine");
  command.footer(
      "One row per run, in the order of the runs, whatever order they finished in; no wall times unless asked for.\n"
      "Of each estimator (literal, model_free, reference): whether it answers, gap, interval [rad], "
      "quantity, method,\n"
      "trust, what it was told of the drive, and its passes over the recording.\n\n"
      "Example: gapscope campaign export reports/sampling_resolution > runs.csv");
  command.action([folder, times] {
    export_campaign(CampaignStore(*folder), *times, [](const std::string& text) { fmt::print("{}", text); });
  });
}

void add_merge(CommandLine& campaign) {
  struct MergeArguments {
    std::vector<std::string> folders;
    std::string target;
  };
  auto a = std::make_shared<MergeArguments>();
  const auto require_new_store = [](const MergeArguments& merge) {
    namespace fs = std::filesystem;
    for (const std::string& folder : merge.folders)
      if (fs::exists(merge.target) && fs::exists(folder) && fs::equivalent(folder, merge.target))
        throw ConfigError(merge.target, "is one of the folders to merge, expected another one to merge into");
    for (const char* end : {"", "-wal", "-shm", "-journal"})
      if (fs::exists(merge.target + "/results.sqlite" + end))
        throw ConfigError(
            merge.target,
            fmt::format("has a store already (results.sqlite{}), expected a folder without one to merge into",
                        end));
  };
  CommandLine command = campaign.add_command("merge", "One store from the shards of a campaign");
  command.add_option("DIR", a->folders, "folders of the shards").required();
  command.add_option("-o,--output", a->target, "folder of the whole campaign").required().value("DIR");
  command.footer(
      "Shards of another campaign or version are refused. Where runs are missing, `gapscope campaign CONFIG -o DIR`\n"
      "does them.\n\n"
      "Example: gapscope campaign merge shard_1 shard_2 shard_3 -o reports/sampling_resolution");
  command.action([a, require_new_store] {
    require_new_store(*a);
    ReportFolder report(a->target, FolderKind::kCampaign);
    const std::uint64_t merged = merge_campaigns(a->folders, report.path());
    const CampaignSummary summary = summarise(CampaignStore(report.path()));
    say("store", a->target + "/results.sqlite");
    say("runs", fmt::format("{} of {}", merged, summary.runs));
    const CampaignTimes times = times_of(CampaignStore(report.path()));
    report_whole(report, a->target, times, summary, {});
  });
}

}  // namespace

void add_campaign(CommandLine& app) {
  auto a = std::make_shared<CampaignArguments>();
  CommandLine command =
      app.add_command("campaign", "Many runs of one configuration over axes of its parameters");
  command.add_option("CONFIG", a->config, "campaign (YAML)");
  command.add_option("-o,--output", a->folder, "folder of the campaign (default: reports/<name>)")
      .value("DIR");
  command.add_option("--shard", a->shard, "only part K of N, into a folder of its own").value("K/N");
  command.add_flag("--dry-run", a->dry_run, "number of runs, time, and the first three configurations");
  command.add_flag("--svg", a->figures.svg, kSvgHelp);
  command.add_flag("--no-title", a->untitled, kUntitledHelp);
  add_work_options(command, a->threads, a->quiet);
  command.may_have_command();
  command.footer(
      "Keys of a campaign:\n"
      "  name          of the report folder (default: of the file)\n"
      "  base          a configuration, or the file of one\n"
      "  axes          {path: values}, e.g. simulation.rate: [1000, 5000]; values are a list,\n"
      "                {range: [low, high], count: n}, {log_range: [low, high], count: n} or {repeat: n, seed: first}\n"
      "  drawn         {path: {uniform: [low, high]}} or log_uniform: a number of its own for each run\n"
      "  sampling      full_factorial (default) or {latin_hypercube: {samples: n, seed: s}}\n"
      "  estimators    [literal, model_free, reference] (default: all; literal, S1 to S6 of the paper as\n"
      "                printed, where the base or an axis has its bound, detector: {literal: L})\n\n"
      "Writes DIR/results.sqlite, a row per run as it finishes, and at the end campaign.json, report.md and figures.\n"
      "Stopped or killed, the same command goes on.\n\n"
      "Example: gapscope campaign configs/04_sampling_resolution_campaign.yaml -o "
      "reports/sampling_resolution");
  add_export(command);
  add_merge(command);
  command.action([command, a] {
    if (command.has_command()) return;
    if (a->config.empty()) throw_missing("CONFIG");
    a->figures.title = !a->untitled;
    run(*a);
  });
}

}  // namespace gapscope::cli
