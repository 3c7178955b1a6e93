#include "blind/case_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/random.h"
#include "engine_plant/mujoco_plant.h"
#include "independent_plant/severity.h"

namespace gapscope::blind {
namespace {

using Names = std::vector<std::string>;

/// `backlash` has no place: every rig has a gap.
Names effect_names(bool in_catalogue, BlindPlant plant) {
  Names names;
  const auto told = engine_plant::mujoco_effects();
  for (const independent_plant::DrawnEffect& e : independent_plant::effect_entries())
    if ((plant == BlindPlant::kIndependent || std::find(told.begin(), told.end(), e.name) != told.end()) &&
        e.in_catalogue == in_catalogue && e.name != "backlash")
      names.emplace_back(e.name);
  return names;
}

/// Three laws of one and the same bearing: a drive has one of them.
bool same_bearing(const std::string& a, const std::string& b) {
  const auto of_the_bearing = [](const std::string& name) {
    return independent_plant::find_drawn_effect(name)->traits.of_the_bearing;
  };
  return of_the_bearing(a) && of_the_bearing(b);
}

std::string another_effect(const Names& names, const std::string& first, std::mt19937_64& g) {
  std::string second = first;
  while (second == first || same_bearing(first, second))
    second = names[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(names.size())))];
  return second;
}

class Planner {
 public:
  explicit Planner(const BlindConfig& config) : rigs_(config.rigs), plant_(config.plant) {
    plan_part("calibration", config.calibration);
    plan_part("report", config.report);
    shuffle(config.calibration.first_seed, config.report.first_seed);
  }
  std::vector<PlannedCase> cases;

 private:
  void plan_part(const std::string& part, const BlindPartConfig& p) {
    seed_ = p.first_seed;
    add(part, p.known, effect_names(true, plant_), false);
    add(part, p.outside, effect_names(false, plant_), false);
    add(part, p.none, {}, false);
    add(part, p.pairs, effect_names(true, plant_), true);
  }

  void add(const std::string& part, int count, const Names& names, bool pairs) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      auto g = random_stream(seed_, "blind check");
      BlindLabel label;
      label.part = part;
      label.rig = rigs_[(i + i / std::max<std::size_t>(1, names.size())) % rigs_.size()];
      label.severity = names.empty() ? 0.0 : uniform(g, 0.0, 1.0);
      if (!names.empty()) label.effects = {names[i % names.size()]};
      if (pairs) label.effects.push_back(another_effect(names, label.effects.front(), g));
      label.seed = fmt::format("{}", seed_);
      label.salt = fmt::format("{:016x}{:016x}", g(), g());
      cases.push_back({label, seed_++});
    }
  }

  void shuffle(std::uint64_t a, std::uint64_t b) {
    auto g = random_stream(a ^ (b << 1), "blind order");
    for (std::size_t i = cases.size(); i > 1; --i)
      std::swap(cases[i - 1], cases[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(i)))]);
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].label.name = fmt::format("case_{:03}", i + 1);
  }

  std::vector<std::string> rigs_;
  BlindPlant plant_;
  std::uint64_t seed_ = 0;
};

}  // namespace

std::vector<PlannedCase> plan_cases(const BlindConfig& config) { return Planner(config).cases; }

}  // namespace gapscope::blind
