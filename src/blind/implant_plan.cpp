#include "blind/implant_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/random.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "gapscope/plant/effect.h"

namespace gapscope::blind {
namespace {

constexpr int kMostHalvings = 4;  ///< of a size; less shows nothing

std::optional<implant::Implant> drawn(const implant::ImplantLaw& law, const ImplantHost& host, double& size,
                                      std::uint64_t seed) {
  for (int i = 0; i <= kMostHalvings; ++i, size *= 0.5)
    if (auto found = implant::drawn_implant(law, host.cases, host.receiver, size, seed)) return found;
  return {};
}

std::vector<std::string> possible_effects(const ImplantConfig& config, const ImplantHost& host,
                                          const std::string& file) {
  for (const std::string& effect : config.effects)
    if (const std::string why = why_not_implanted(effect, host); !why.empty())
      throw ConfigError(file, config.line == 0 ? 1 : config.line,
                        fmt::format("implant.effects has {}, which {}; expected others", effect, why));
  if (!config.effects.empty()) return config.effects;
  std::vector<std::string> effects;
  for (const EffectEntry* entry : effect_table()) {
    double size = 1.0;
    if (why_not_implanted(entry->name, host).empty() &&
        drawn(*implant::find_implant_law(entry->name), host, size, 1))
      effects.emplace_back(entry->name);
  }
  if (effects.empty() && config.known > 0)
    throw ConfigError(file, "has a drive that no effect can be implanted into, expected implant: {known: 0}");
  return effects;
}

std::vector<std::string> outside_effects() {
  std::vector<std::string> effects;
  for (const implant::ImplantLaw* law : implant::implant_laws())
    if (!law->in_catalogue) effects.emplace_back(law->name);
  return effects;
}

class ImplantPlanner {
 public:
  ImplantPlanner(const ImplantConfig& config, const ImplantHost& host, const std::string& file)
      : config_(config), host_(host), seed_(config.first_seed) {
    add(config.known, possible_effects(config, host, file));
    add(config.outside, outside_effects());
    add(config.none, {});
    shuffle();
  }
  std::vector<PlannedImplant> cases;

 private:
  void add(int count, const std::vector<std::string>& effects) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      auto g = random_stream(seed_, "implanted case");
      PlannedImplant planned;
      BlindLabel& label = planned.label;
      label.part = "report", label.rig = host_.name;
      label.seed = fmt::format("{}", seed_);
      label.salt = fmt::format("{:016x}{:016x}", g(), g());
      label.implant.emplace();
      label.implant->undisturbed = label.implant->own = host_.added;
      for (const std::string& effect : host_.budget)
        if (!contains(host_.added, effect)) label.implant->own.push_back(effect);
      if (!effects.empty()) {
        const std::size_t place = i % effects.size(), round = i / effects.size();
        const std::string& effect = effects[place];
        double size = config_.sizes[(place + round) % config_.sizes.size()];
        planned.implant = drawn(*implant::find_implant_law(effect), host_, size, seed_);
        if (planned.implant) tell(planned, effect, size);
      }
      ++seed_;
      if (planned.implant || effects.empty()) cases.push_back(std::move(planned));
    }
  }

  static void tell(PlannedImplant& planned, const std::string& effect, double size) {
    BlindLabel& label = planned.label;
    label.effects = {effect};
    label.severity = label.implant->size = size;
    for (std::size_t v = 0; v < implant::kMostValues; ++v) {
      const auto& [key, unit] = planned.implant->law->values[v];
      if (*key == '\0') continue;
      label.implant->values.push_back({key, unit, planned.implant->values[v]});
      if (std::string(key) == "periods_per_turn") label.cycles_per_turn = planned.implant->values[v];
    }
  }

  void shuffle() {
    auto g = random_stream(config_.first_seed, "implanted order");
    for (std::size_t i = cases.size(); i > 1; --i)
      std::swap(cases[i - 1], cases[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(i)))]);
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].label.name = fmt::format("case_{:03}", i + 1);
  }

  const ImplantConfig& config_;
  const ImplantHost& host_;
  std::uint64_t seed_;
};

}  // namespace

std::string why_not_implanted(const std::string& effect, const ImplantHost& host) {
  if (contains(host.in_model, effect) || contains(host.added, effect))
    return "is in the drive already, where more of it would be a larger one";
  return implant::why_not(effect, host.receiver, host.quantum);
}

std::vector<PlannedImplant> plan_implants(const ImplantConfig& config, const ImplantHost& host,
                                          const std::string& file) {
  return ImplantPlanner(config, host, file).cases;
}

}  // namespace gapscope::blind
