// How far off an MJCF is that leaves an effect out, and what half and double of the two limits in
// src/exports/left_out.cpp would make of it.
//   study_left_out FIRST_SEED COUNT
// One of two rigs with one of six effects, its amount drawn over five decades. Prints the errors of each
// drive over the encoder's floor and over the travel, then the counts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/random.h"
#include "exports/export.h"
#include "exports/exported_drives.h"

namespace {

using namespace gapscope;

/// With {} for the amount, and the largest one.
struct Drawn {
  const char* effect;
  double most;
};
constexpr std::array kDrawn{Drawn{"cogging_torque: {{amplitude_nm: {:.4g}, periods_per_turn: 24}}", 0.05},
                            Drawn{"torque_ripple: {{ratio: {:.4g}, periods_per_turn: 6}}", 0.5},
                            Drawn{"load_unbalance: {{amplitude_nm: {:.4g}}}", 0.05},
                            Drawn{"quadratic_drag: {{coefficient_nms2: {:.4g}}}", 0.025},
                            Drawn{"input_dead_zone: {{width: {:.4g}}}", 0.25},
                            Drawn{"input_delay: {{delay_s: {:.4g}}}", 0.005}};

Configuration drawn(std::uint64_t seed) {
  auto g = random_stream(seed, "left out study");
  const Drawn& d = kDrawn[seed % kDrawn.size()];
  const double amount = d.most * log_uniform(g, 1e-5, 1.0);
  const bool two = uniform(g, 0.0, 1.0) < 0.5;
  return testing::rig_configuration(two ? testing::kTwoBodies : ", mass_ratio: 0",
                                    "  effects: [{" + fmt::format(fmt::runtime(d.effect), amount) + "}]\n");
}

void print_counts(const char* what, const std::vector<double>& errors, double limit) {
  const auto beyond = [&](double at) {
    return std::count_if(errors.begin(), errors.end(), [&](double e) { return e > at; });
  };
  fmt::print("{}: {} of {} beyond {:g}; half {}, double {}\n", what, beyond(limit), errors.size(), limit,
             beyond(0.5 * limit), beyond(2.0 * limit));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10),
                      count = std::strtoull(argv[2], nullptr, 10);
  std::vector<double> floors, shares;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Certificate c = export_drive(drawn(seed), ExportFormat::kMjcf).certificate;
    double rms = kInfinity;
    for (const TargetError& e : c.errors)
      if (!std::isnan(e.rms)) rms = std::min(rms, e.rms);
    floors.push_back(rms / c.encoder_floor), shares.push_back(rms / c.travel);
    fmt::print("{} {} {:.4g} {:.4g} {}\n", seed,
               std::string(kDrawn[seed % kDrawn.size()].effect).substr(0, 14), floors.back(), shares.back(),
               c.errors.size());
  }
  print_counts("encoder floors", floors, 10.0);
  print_counts("of the travel", shares, 0.01);
}
