#include "diagnosis/drawn_case.h"

#include "base/random.h"

namespace gapscope::test {

namespace {

/// Of the catalogue's law, and by the motion: counts of an encoder are read without a fit.
bool has_fitted_amount(std::string_view effect) {
  return blind::form_of(effect) != blind::LawForm::kAnother && effect != "encoder_quantization";
}

}  // namespace

std::vector<std::string> effects_of_kind(const std::string& kind) {
  if (kind == "none" || kind == "lawless") return {"none"};
  const bool known =
      kind == "known" || kind == "one" || kind == "whole" || kind == "unstarted" || kind == "amount";
  std::vector<std::string> names;
  for (const independent_plant::DrawnEffect& e : independent_plant::effect_entries())
    if (e.in_catalogue == known && e.name != "backlash" && (kind != "amount" || has_fitted_amount(e.name)))
      names.emplace_back(e.name);
  return names;
}

DrawnCase drawn_case(std::uint64_t seed, const std::vector<std::string>& effects, const std::string& rig) {
  auto g = random_stream(seed, "diagnosis study");
  return {seed, rig.empty() ? blind::kRigs[(seed / effects.size()) % std::size(blind::kRigs)] : rig,
          effects[seed % effects.size()], uniform(g, 0.0, 1.0)};
}

std::vector<std::uint64_t> open_seeds(std::uint64_t first, std::uint64_t count,
                                      const std::set<std::uint64_t>& done) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = first; seed < first + count; ++seed)
    if (!done.contains(seed)) seeds.push_back(seed);
  return seeds;
}

}  // namespace gapscope::test
