// How far reading, fit and card can be trusted on drives of other laws (tests/drives/family.h).
//   study_trust FAMILY FIRST COUNT [gap_free] [each] [reading] [x2] [in=FOLDER]
// e.g. study_trust grease 1 12 reading each; study_trust all 1 12 gap_free
// gap_free: the same drives with their gaps closed; each: a line for each drive; reading: `detect` alone,
// else `run`; x2: the recording has a load encoder; in: recordings and configurations stay there. A drive
// that takes more than 60 s of processor time is skipped and counted as such.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>
#include <thread>

#include "base/interrupt.h"
#include "gapscope/base/errors.h"
#include "run/run_pipeline.h"
#include "run/trust_case.h"
#include "run/trust_count.h"

namespace gapscope::test {
namespace {

namespace fs = std::filesystem;
using namespace independent_plant;

constexpr double kMostSeconds = 60.0;  ///< of processor time for a drive

/// Asks the work to stop once it has taken too long.
class TimeLimit {
 public:
  TimeLimit() : watch_([this] { watch(); }) {}
  ~TimeLimit() {
    done_ = true;
    watch_.join();
    clear_stop_request();
  }
  bool passed() const { return passed_; }

 private:
  void watch() {
    const std::clock_t start = std::clock();
    for (; !done_; std::this_thread::sleep_for(std::chrono::milliseconds(5)))
      if (!passed_ && static_cast<double>(std::clock() - start) > kMostSeconds * CLOCKS_PER_SEC) {
        passed_ = true;
        request_stop();
      }
  }
  std::atomic<bool> done_{false}, passed_{false};
  std::thread watch_;
};

struct StudyOptions {
  bool gap_free = false, each = false, reading = false, with_x2 = false;
  std::string folder;
};

struct FamilyCounts {
  TrustCount reading, fit, card;
  int skipped = 0, failed = 0;
};

/// What `detect` or `run` finds; nothing where it takes too long.
std::optional<RunResult> result_of(const std::string& configuration, bool reading_alone) {
  const TimeLimit limit;
  try {
    RunOutcome outcome = run_pipeline(
        load_configuration(configuration), {true, !reading_alone}, [](const std::string&) {}, 1);
    if (outcome.stopped || limit.passed()) return std::nullopt;
    return std::move(outcome.result);
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

void count(const RunResult& result, const ChainCase& c, bool each, FamilyCounts& counts) {
  const Interval truth = total_gap(c.drive);
  std::string line = fmt::format("{} {} of {:.4g}", c.family, c.options.seed, 1e3 * truth.low);
  if (truth.high > truth.low) line += fmt::format(" to {:.4g}", 1e3 * truth.high);
  if (c.drive.joints.size() > 1) line += fmt::format(" (first {:.4g})", 1e3 * first_gap(c.drive).low);
  const auto add = [&](const char* name, const ToldGap& told, const Interval& of, TrustCount& to) {
    to.add(told, of);
    line += fmt::format(" | {} {}", name, in_words(told, of));
  };
  const bool first = result.model_free->quantity == GapQuantity::kFirstGap;
  add("reading", told_by(*result.model_free), first ? first_gap(c.drive) : truth, counts.reading);
  if (result.reference) add("fit", told_by(*result.reference), truth, counts.fit);
  add("card", told_by(*result.answer), truth, counts.card);
  if (each) fmt::print("{}\n", line);
}

void study_drive(const std::string& family, std::uint64_t seed, const StudyOptions& o, FamilyCounts& counts) {
  const ChainCase c = draw_family(family, seed, o.gap_free);
  const std::string name = fmt::format("{}_{}{}", family, seed, o.gap_free ? "_gap_free" : "");
  const std::string configuration = write_case(o.folder, name, c, o.with_x2);
  try {
    const std::optional<RunResult> result = result_of(configuration, o.reading);
    if (result) return count(*result, c, o.each, counts);
    ++counts.skipped;
    fmt::print("{} {} skipped after {:g} s\n", family, seed, kMostSeconds);
  } catch (const ConfigError& error) {
    ++counts.failed;
    fmt::print("{} {} is not taken: {}\n", family, seed, error.what());
  }
}

void study_family(const std::string& family, std::uint64_t first, std::uint64_t drives,
                  const StudyOptions& o) {
  FamilyCounts counts;
  for (std::uint64_t seed = first; seed < first + drives; ++seed) {
    study_drive(family, seed, o, counts);
    std::fflush(stdout);
  }
  fmt::print("== {}{}, {} drives from {}, {} skipped, {} not taken\n", family, o.gap_free ? " gap_free" : "",
             drives, first, counts.skipped, counts.failed);
  fmt::print("{}", counts.reading.text("reading"));
  if (!o.reading) fmt::print("{}", counts.fit.text("fit"));
  fmt::print("{}", counts.card.text("card"));
  std::fflush(stdout);
}

int main_study(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr,
               "study_trust FAMILY|all FIRST COUNT [gap_free] [each] [reading] [x2] [in=FOLDER]\n"
               "families: {}\n",
               fmt::join(family_names(), " "));
    return 2;
  }
  const std::vector<std::string> words(argv + 4, argv + argc);
  const auto asked = [&](const char* word) { return std::count(words.begin(), words.end(), word) > 0; };
  StudyOptions o{asked("gap_free"), asked("each"), asked("reading"), asked("x2"), ""};
  for (const std::string& word : words)
    if (word.starts_with("in=")) o.folder = word.substr(3);
  const bool stays = !o.folder.empty();
  if (!stays) o.folder = (fs::temp_directory_path() / fmt::format("study_trust_{}", getpid())).string();
  fs::create_directories(o.folder);
  const std::vector<std::string> one{argv[1]};
  for (const std::string& family : one[0] == "all" ? family_names() : one)
    study_family(family, std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10), o);
  if (!stays) fs::remove_all(o.folder);
  return 0;
}

}  // namespace
}  // namespace gapscope::test

int main(int argc, char** argv) { return gapscope::test::main_study(argc, argv); }
