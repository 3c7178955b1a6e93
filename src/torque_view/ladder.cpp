#include "torque_view/ladder.h"

#include <algorithm>
#include <cmath>

#include "torque_view/floors.h"

namespace gapscope::internal::torque_view {
namespace {

double rms_of(const Eigen::VectorXd& v) {
  return std::sqrt(v.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, v.size())));
}

Model without(Model model, std::size_t term) {
  model.erase(model.begin() + static_cast<std::ptrdiff_t>(term));
  return model;
}

/// Another term adds to this one.
bool carries_another(const Model& model, std::size_t term) {
  return std::any_of(model.begin(), model.end(), [&](const Term& t) {
    return t.law->simpler != nullptr && t.law->simpler == std::string_view(model[term].law->name);
  });
}

/// Terms that the others say as well are taken out again.
void step_back(Bench& bench, Budget& budget) {
  for (std::size_t i = budget.model.size(); i-- > budget.nominal.size();) {
    if (carries_another(budget.model, i)) continue;
    const Model less = fitted(bench.fit, without(budget.model, i));
    if (bench.squares(less).sum() > bench.squares(budget.model).sum()) continue;
    budget.dropped.emplace_back(budget.model[i].law->name);
    budget.model = less;
  }
}

/// What is left is mostly noise of the encoder: J that it attenuates would pass for a resonance.
bool is_at_the_floor(const SplitRecordings& data, Bench& bench, const Model& model,
                     const TorqueViewOptions& options) {
  const double left = rms_of(bench.left(model));
  const double floor = encoder_torque_floor(data, bench.scales.hz, first_coefficient(model, "inertia"));
  return floor * floor >= options.most_encoder * left * left;
}

void climb(const SplitRecordings& data, Bench& bench, Budget& budget, const TorqueViewOptions& options) {
  while (static_cast<int>(budget.rungs.size()) < options.most_rungs &&
         !is_at_the_floor(data, bench, budget.model, options)) {
    budget.rungs.push_back(next_rung(bench, budget.model, options));
    const Rung& rung = budget.rungs.back();
    if (!rung.helps) return;
    budget.model = rung.choice().model;
    take_line(bench, budget.model);
    step_back(bench, budget);
    budget.rungs.back().rms = rms_of(bench.left(budget.model));
  }
}

/// Whether a model leaves less than another by what a step of the ladder must take.
bool is_clearly_below(Bench& bench, const Model& model, const Model& other,
                      const TorqueViewOptions& options) {
  return is_clear(bench.blocks.compare(bench.squares(other), bench.squares(model)), options);
}

/// A line whose period was searched while other effects were missing may be bent by them: a simpler law of a
/// given period that its rung could not tell from it; nullptr: there is none.
const Law* simpler_line(const Budget& budget) {
  for (const Rung& rung : budget.rungs)
    for (const std::string& name : rung.group)
      if (rung.helps && contains_line(*rung.choice().law, law(name))) return &law(name);
  return nullptr;
}

/// The ladder once more from its foot, now with the simpler line first, unless that leaves clearly more.
void climb_with_simpler_line(const SplitRecordings& data, Bench& bench, Budget& budget,
                             const TorqueViewOptions& options) {
  bench.simpler_line = simpler_line(budget);
  if (bench.simpler_line == nullptr) return;
  Budget again = budget;
  again.rungs.clear(), again.dropped.clear();
  again.model = budget.nominal;
  bench.scales = budget.scales;
  take_line(bench, again.model);
  climb(data, bench, again, options);
  if (!is_clearly_below(bench, budget.model, again.model, options)) budget = std::move(again);
  take_line(bench, budget.model);
}

/// The first rung is asked again with all that came after it in the model, where each of those is named: what
/// it could not be told from may be one of them. Later rungs are not: what they take is small, and patches
/// the form of those before.
void ask_first_again(Bench& bench, Budget& budget, const TorqueViewOptions& options) {
  if (budget.rungs.empty() || !budget.rungs.front().helps || budget.rungs.front().named) return;
  Rung& first = budget.rungs.front();
  const Law* const law = first.choice().law;
  const auto is_it = [&](const Term& t) { return t.law == law; };
  const bool others = std::all_of(budget.rungs.begin() + 1, budget.rungs.end(),
                                  [](const Rung& r) { return r.named || !r.helps; });
  if (!is_clear(first.choice().evidence, options) || !others ||
      std::count_if(budget.model.begin(), budget.model.end(), is_it) != 1)
    return;
  const auto at = static_cast<std::size_t>(std::find_if(budget.model.begin(), budget.model.end(), is_it) -
                                           budget.model.begin());
  if (carries_another(budget.model, at)) return;
  Rung again = next_rung(bench, fitted(bench.fit, without(budget.model, at)), options);
  if (!again.named || !is_same_torque(*again.choice().law, *law)) return;
  first.named = true;
  first.group = std::move(again.group), first.rival = std::move(again.rival);
  first.margin = again.margin, first.leading = again.leading;
}

Share share_of(Bench& bench, const Budget& budget, std::size_t i, const TorqueViewOptions& options) {
  const Term& term = budget.model[i];
  Share share{term.law, term.shape, term.theta, {}, {}, {}};
  Model alone = budget.nominal;
  alone.push_back(term);
  share.alone = bench.blocks.compare(bench.squares(budget.nominal), bench.squares(fitted(bench.fit, alone)));
  const Model less = fitted(bench.fit, without(budget.model, i));
  share.last = bench.blocks.compare(bench.squares(less), bench.squares(budget.model));
  share.seen = visibility(bench, less, term, options);
  return share;
}

}  // namespace

/// The terms that the caller's model can have, refitted.
void keep_addable(const SplitRecordings& data, Bench& bench, Budget& budget) {
  const auto can = [&](const Term& term) {
    return std::find(data.addable.begin(), data.addable.end(), term.law->effect) != data.addable.end();
  };
  budget.addable = budget.nominal;
  for (std::size_t i = budget.nominal.size(); i < budget.model.size(); ++i)
    if ((budget.model[i].law->values != nullptr || budget.model[i].law->harmonic > 0) && can(budget.model[i]))
      budget.addable.push_back(budget.model[i]);
  budget.addable = fitted(bench.fit, std::move(budget.addable));
  for (std::size_t i = budget.addable.size();
       i-- > budget.nominal.size();) {  // without the others it may turn round
    const Term& term = budget.addable[i];
    if (has_its_sign(*term.law, term.theta[0], first_coefficient(budget.addable, "inertia"))) continue;
    budget.addable = fitted(bench.fit, without(budget.addable, i));
  }
  double square = 0.0, count = 0.0;
  for (const std::vector<double>& tau : bench.fit.tau)
    for (const double torque : tau) square += torque * torque, count += 1.0;
  budget.torque_rms = std::sqrt(square / std::max(1.0, count));
  budget.addable_rms = rms_of(bench.left(budget.addable));
}

Bench bench_of(const SplitRecordings& data, const FrequencyBand& band, const TorqueViewOptions& options) {
  Bench bench{stacked(data.fit, band.hz, band.free_constant, options),
              stacked(data.judge, band.hz, band.free_constant, options),
              {},
              {},
              data.new_phase,
              data.closed,
              data.threads};
  bench.scales = scales_of(bench.fit, data.turns, data.held_output);
  bench.scales.lines = data.lines;
  bench.blocks = Blocks(bench.judge, options);
  return bench;
}

void take_line(Bench& bench, const Model& model) {
  if (const Term* line = find_term(model, "cogging_torque")) bench.scales.line = line->shape;
  if (const Term* line = find_term(model, "torque_ripple")) bench.scales.ripple = line->shape;
}

Budget error_budget(const SplitRecordings& data, const TorqueViewOptions& options) {
  Budget budget;
  Scales known;
  known.turns = data.turns, known.held_output = data.held_output, known.lines = data.lines;
  budget.band = choose_band(data.fit, known, options, data.threads);
  if (std::isnan(budget.band.hz)) return budget;
  Bench bench = bench_of(data, budget.band, options);
  budget.scales = bench.scales;
  Model nominal = nominal_model();
  nominal.insert(nominal.end(), data.known.begin(), data.known.end());
  budget.nominal = budget.model = fitted(bench.fit, std::move(nominal));
  take_line(bench, budget.model);
  budget.input_rms = std::sqrt(bench.judge.input_square() /
                               static_cast<double>(std::max<Eigen::Index>(1, bench.judge.size())));
  budget.nominal_rms = rms_of(bench.left(budget.nominal));
  climb(data, bench, budget, options);
  climb_with_simpler_line(data, bench, budget, options);
  ask_first_again(bench, budget, options);
  budget.rms = rms_of(bench.left(budget.model));
  for (std::size_t i = budget.nominal.size(); i < budget.model.size(); ++i)
    budget.shares.push_back(share_of(bench, budget, i, options));
  keep_addable(data, bench, budget);
  budget.says_most = budget.addable_rms < options.most_left * budget.input_rms;
  budget.floors = floors_of(data, bench, budget.model, options);
  return budget;
}

}  // namespace gapscope::internal::torque_view
