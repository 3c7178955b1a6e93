// `blind drives`: recordings of drives that no estimator shares code with.
#include <fmt/format.h>

#include <cstdint>
#include <memory>

#include "blind/random_drives.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "gapscope/base/errors.h"

namespace gapscope::cli {
namespace {

constexpr std::uint64_t kMostDrives = 100000;

struct DrivesArguments {
  std::string kind = "gap";
  std::string seeds;
  std::string folder;
  bool quiet = false;
};

/// "A..B" or "A".
std::pair<std::uint64_t, std::uint64_t> seed_range(const std::string& text) {
  const auto wrong = [&]() -> ConfigError {
    return ConfigError(fmt::format("gapscope: --seeds is '{}', expected FIRST..LAST with at most {} seeds",
                                   text, kMostDrives));
  };
  const auto number = [&](const std::string& part) {
    if (part.empty() || part.size() > 18 || part.find_first_not_of("0123456789") != std::string::npos)
      throw wrong();
    return std::stoull(part);
  };
  const std::size_t dots = text.find("..");
  const std::uint64_t first = number(text.substr(0, dots));
  const std::uint64_t last = dots == std::string::npos ? first : number(text.substr(dots + 2));
  if (last < first || last - first >= kMostDrives) throw wrong();
  return {first, last};
}

void make_drives(const DrivesArguments& a) {
  const auto [first, last] = seed_range(a.seeds);
  const auto progress = progress_on_terminal(a.quiet);
  const std::uint64_t count = last - first + 1;
  write_random_drives(a.kind == "gap" ? RandomDriveKind::kGap : RandomDriveKind::kGapFree, first, last,
                      a.folder,
                      [&](std::uint64_t done) { progress(fmt::format("drive {} of {}", done, count)); });
  fmt::print("{:<12}{} in {}\n", "drives", count, a.folder);
}

}  // namespace

void add_blind_drives(CommandLine& blind) {
  auto arguments = std::make_shared<DrivesArguments>();
  CommandLine command = blind.add_command("drives", "Records random drives on the independent plant");
  command.add_option("--kind", arguments->kind, "gap: drives with backlash; gap_free: drives without")
      .one_of({"gap", "gap_free"});
  command.add_option("--seeds", arguments->seeds, "FIRST..LAST, one drive a seed").required();
  command.add_option("-o", arguments->folder, "folder to write into").required().value("DIR");
  command.add_flag("--quiet", arguments->quiet, "no progress");
  command.footer(
      "Writes per drive a recording (CSV: t [s], u, x1 [rad]) and a configuration whose model is a data sheet off\n"
      "by up to 20 %, and truth.csv with what the sheets do not say. Gap log-uniform 5 to 50 mrad, mass ratio\n"
      "log-uniform 0.1 to 10, contact stiffness log-uniform 50 to 5000 N m/rad, load Coulomb friction 2 to 60 % of\n"
      "the torque, dampers log-uniform x0.2 to x2 of the paper's rig, sine of 0.5 to 3 Hz with a travel of at least\n"
      "1.5 gaps, 1 to 10 kHz, 20/16/14/12 bit in equal shares, half with noise of 0.3 to 1.5 quanta.\n\n"
      "Example: gapscope blind drives --seeds 1..600 -o drives");
  command.action([arguments] { make_drives(*arguments); });
}

}  // namespace gapscope::cli
