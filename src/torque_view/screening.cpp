#include "torque_view/screening.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "torque_view/spring_search.h"

namespace gapscope::internal::torque_view {
namespace {

Model with(Model model, const Law& law, const Shape& shape) {
  model.push_back({&law, shape, Eigen::VectorXd::Zero(law.columns)});
  return model;
}

/// A law may come again only as a further line, and a harmonic with its line only.
bool is_open(const Bench& bench, const Model& model, const Law& l) {
  if (*l.effect != '\0' &&
      std::find(bench.closed.begin(), bench.closed.end(), l.effect) != bench.closed.end())
    return false;
  if (l.harmonic > 0 && lacks_simpler(model, l)) return false;
  // One spring; with friction that it brings along as long as the model has none.
  if (l.sign == Sign::kShareOfInertia && (spring_of(model) || (l.simpler && !lacks_simpler(model, l))))
    return false;
  return l.name != std::string_view("inertia") &&
         (find_term(model, l.name) == nullptr || l.shapes == line_grid);
}

/// Whether the model's torque is worth reading: it makes most of the input's.
bool says_most(Bench& bench, const Model& model, const TorqueViewOptions& options) {
  return residual(bench.fit, model, false).norm() < options.most_left * std::sqrt(bench.fit.input_square());
}

/// How much of the last term's torque on the fitted rows the terms before it could say.
double absorbed(Bench& bench, const Model& model) {
  const Term& last = model.back();
  set_torque(bench.fit, model);
  Eigen::MatrixXd g(bench.fit.size(), last.law->columns);
  fill_columns(bench.fit, *last.law, last.shape, g);
  const Eigen::VectorXd torque = g * last.theta;
  return 1.0 -
         Projection(bench.fit, {model.begin(), model.end() - 1}, torque).square() / torque.squaredNorm();
}

/// The model with its spring asked anew: friction that was the load's may be the motor's with a further law.
void ask_spring_again(Bench& bench, Model& model) {
  const auto spring = std::find_if(model.begin(), model.end() - 1,
                                   [](const Term& t) { return t.law->sign == Sign::kShareOfInertia; });
  if (spring == model.end() - 1) return;
  Model beside = model;
  beside.erase(beside.begin() + (spring - model.begin()));
  Projection projection(bench.fit, beside);
  const BestShape best = refined_spring(bench.fit, projection, *spring->law, bench.scales, spring->shape);
  if (!std::isnan(best.gain)) spring->shape = best.shape;
}

Candidate judged(Bench& bench, const Law& l, Model model, const Eigen::VectorXd& before,
                 const TorqueViewOptions& options) {
  Candidate c{&l, fitted(bench.fit, std::move(model)), {}, {}};
  if (!has_its_sign(l, c.model.back().theta[0], first_coefficient(c.model, "inertia"))) return c;
  if (absorbed(bench, c.model) > options.most_absorbed) return c;
  c.squares = bench.squares(c.model);
  c.evidence = bench.blocks.compare(before, c.squares);
  return c;
}

/// A law at its best shape beside the model; nothing where it has none.
/// @param below the model with what the law adds to
std::optional<Candidate> tried(Bench& bench, const Law& l, const Model& model, const Model& below,
                               Projection beside, const Eigen::VectorXd& before,
                               const TorqueViewOptions& options) {
  set_torque(bench.fit, model);
  const BestShape best = best_shape(bench.fit, beside, l, bench.scales);
  if (std::isnan(best.gain)) return {};
  Candidate c = judged(bench, l, with(below, l, best.shape), before, options);
  if (!std::isfinite(c.evidence.share)) return {};
  return c;
}

std::vector<Candidate> screened(Bench& bench, const Model& model, const TorqueViewOptions& options) {
  const Eigen::VectorXd before = bench.squares(model);
  std::vector<const Law*> open = open_laws(bench, model, options);
  set_torque(bench.fit, model);
  const Projection plain(bench.fit, model);
  std::stable_partition(open.begin(), open.end(),
                        [](const Law* l) { return l->shapes == line_grid; });  // long
  // The only simpler law of the table is Coulomb friction.
  const auto bringing =
      std::find_if(open.begin(), open.end(), [&](const Law* l) { return lacks_simpler(model, *l); });
  Model with_simpler = model, below_simpler = model;
  std::optional<Projection> beside_simpler;
  if (bringing != open.end()) {
    with_simpler = with(model, law((*bringing)->simpler), kNaN);
    ask_spring_again(bench, with_simpler);
    below_simpler.assign(with_simpler.begin(), with_simpler.end() - 1);
    beside_simpler.emplace(bench.fit, with_simpler);
  }
  std::vector<std::optional<Candidate>> found(open.size());
  const std::size_t side_by_side =
      std::min(open.size(), static_cast<std::size_t>(thread_count(bench.threads)));
  std::atomic<std::size_t> next = 0;
  parallel_for(side_by_side, bench.threads, [&](std::size_t) {
    Bench own = bench;  // laws are filled into its rows
    for (std::size_t i = next++; i < open.size(); i = next++) {
      const bool brings = lacks_simpler(model, *open[i]);
      const bool simpler = open[i] == with_simpler.back().law;
      found[i] = tried(own, *open[i], model,
                       brings    ? with_simpler
                       : simpler ? below_simpler
                                 : model,
                       brings ? *beside_simpler : plain, before, options);
    }
  });
  std::vector<Candidate> ranking;
  for (std::optional<Candidate>& c : found)
    if (c) ranking.push_back(std::move(*c));
  std::stable_sort(ranking.begin(), ranking.end(), [](const Candidate& a, const Candidate& b) {
    return a.evidence.share > b.evidence.share;
  });
  return ranking;
}

/// Torque on the held-out rows of what a candidate has beyond the model below.
Eigen::VectorXd added_torque(Bench& bench, const Candidate& c, std::size_t below) {
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(bench.judge.size());
  set_torque(bench.judge, c.model);
  for (std::size_t i = below; i < c.model.size(); ++i) {
    Eigen::MatrixXd g(bench.judge.size(), c.model[i].law->columns);
    fill_columns(bench.judge, *c.model[i].law, c.model[i].shape, g);
    torque += g * c.model[i].theta;
  }
  return torque;
}

/// o_ij: the share of what i adds, away from the model, that j says as well.
double overlap(Bench& bench, Projection& of_i, const Candidate& j, std::size_t below) {
  int columns = 0;
  for (std::size_t t = below; t < j.model.size(); ++t) columns += j.model[t].law->columns;
  Eigen::MatrixXd g(bench.judge.size(), columns);
  set_torque(bench.judge, j.model);
  int first = 0;
  for (std::size_t t = below; t < j.model.size(); ++t) {
    const Law& l = *j.model[t].law;
    fill_columns(bench.judge, l, j.model[t].shape, g.middleCols(first, l.columns));
    first += l.columns;
  }
  return of_i.gain(g).share;
}

int parameters(const Candidate& c, std::size_t below) {
  int count = 0;
  for (std::size_t t = below; t < c.model.size(); ++t) count += c.model[t].law->parameters();
  return count;
}

/// Members of the leader's group, itself left out.
std::vector<std::size_t> group_of(Bench& bench, const Rung& rung, const Model& model,
                                  const TorqueViewOptions& options) {
  const Candidate& leader = rung.choice();
  const Eigen::VectorXd added = added_torque(bench, leader, model.size());
  set_torque(bench.judge, model);
  Projection of_leader(bench.judge, model, added);
  std::vector<std::size_t> group;
  for (std::size_t j = 0; j < rung.ranking.size(); ++j)
    if (j != rung.chosen && !is_free_form(*rung.ranking[j].law) &&
        overlap(bench, of_leader, rung.ranking[j], model.size()) >= options.same_group)
      group.push_back(j);
  return group;
}

/// Whether a law of the ranking goes before the leader, which contains it.
bool goes_first(const Bench& bench, const Candidate& leader, const Candidate& simpler, bool in_group) {
  if (adds_to(*leader.law, *simpler.law)) return true;
  return in_group && simpler.law == bench.simpler_line && contains_line(*leader.law, *simpler.law);
}

/// The simplest of a group that the leader does not clearly lead; a law that the leader contains comes first.
std::size_t simplest(const Bench& bench, const Rung& rung, const std::vector<std::size_t>& group,
                     std::size_t below, const TorqueViewOptions& options) {
  const Candidate& leader = rung.choice();
  for (std::size_t j = 0; j < rung.ranking.size(); ++j)
    if (goes_first(bench, leader, rung.ranking[j], std::find(group.begin(), group.end(), j) != group.end()) &&
        is_worth_having(rung.ranking[j].evidence, options))
      return j;
  std::size_t best = rung.chosen;
  for (const std::size_t j : group)
    if (parameters(rung.ranking[j], below) < parameters(rung.ranking[best], below) &&
        bench.blocks.leading(leader.squares, rung.ranking[j].squares) < options.least_leading)
      best = j;
  return best;
}

/// The choice says all that the rival says, and clearly more.
bool says_more(Bench& bench, const Candidate& c, const Candidate& rival, const Model& model,
               const TorqueViewOptions& options) {
  if (bench.blocks.leading(c.squares, rival.squares) < options.least_leading) return false;
  const Eigen::VectorXd added = added_torque(bench, rival, model.size());
  set_torque(bench.judge, model);
  Projection of_rival(bench.judge, model, added);
  return overlap(bench, of_rival, c, model.size()) >= options.same_group;
}

void decide(Bench& bench, Rung& rung, const Model& model, const std::vector<std::size_t>& group,
            const TorqueViewOptions& options) {
  const Candidate& c = rung.choice();
  rung.leading = rung.margin = 1.0;
  for (const std::size_t j : group) rung.group.emplace_back(rung.ranking[j].law->name);
  for (std::size_t j = 0; j < rung.ranking.size(); ++j) {
    const Candidate& rival = rung.ranking[j];
    if (j == rung.chosen || is_free_form(*rival.law) || is_same_torque(*rival.law, *c.law) ||
        adds_to(*rival.law, *c.law) || adds_to(*c.law, *rival.law) ||
        std::find(group.begin(), group.end(), j) != group.end() || says_more(bench, c, rival, model, options))
      continue;
    rung.rival = rival.law->name;
    rung.margin = margin_over(c.evidence, rival.evidence);
    rung.leading = bench.blocks.leading(c.squares, rival.squares);
    break;
  }
  rung.helps = is_worth_having(c.evidence, options);
  rung.named = is_clear(c.evidence, options) && rung.margin >= options.least_margin &&
               rung.leading >= options.least_leading;
}

}  // namespace

bool is_free_form(const Law& law) { return std::string_view(law.name).starts_with("free_"); }

bool lacks_simpler(const Model& model, const Law& law) {
  return law.simpler != nullptr && find_term(model, law.simpler) == nullptr;
}

bool adds_to(const Law& law, const Law& other) {
  return law.simpler != nullptr && law.simpler == std::string_view(other.name);
}

bool contains_line(const Law& searched, const Law& given) {
  return given.fill == searched.fill && given.parameters() < searched.parameters();
}

bool is_worth_having(const Evidence& evidence, const TorqueViewOptions& options) {
  return evidence.share >= options.last_share && evidence.interval.low > 0.0;
}

bool is_clear(const Evidence& evidence, const TorqueViewOptions& options) {
  return is_worth_having(evidence, options) && evidence.share >= options.least_share &&
         evidence.interval.low >= options.least_low && evidence.better >= options.least_better;
}

double margin_over(const Evidence& choice, const Evidence& rival) {
  return (choice.share - rival.share) / std::min(choice.share, 1.0 - rival.share);
}

std::vector<const Law*> open_laws(Bench& bench, const Model& model, const TorqueViewOptions& options) {
  const bool torque_is_there = says_most(bench, model, options);
  std::vector<const Law*> open;
  for (const Law& l : laws())
    if (is_open(bench, model, l) && (l.kind != Kind::kOnTorque || torque_is_there)) open.push_back(&l);
  return open;
}

Rung next_rung(Bench& bench, const Model& model, const TorqueViewOptions& options) {
  Rung rung;
  rung.ranking = screened(bench, model, options);
  while (rung.chosen < rung.ranking.size() && is_free_form(*rung.choice().law)) ++rung.chosen;
  if (rung.chosen == rung.ranking.size()) return rung;
  std::vector<std::size_t> group = group_of(bench, rung, model, options);
  const std::size_t simpler = simplest(bench, rung, group, model.size(), options);
  if (simpler != rung.chosen) {
    rung.chosen = simpler;
    group = group_of(bench, rung, model, options);
  }
  decide(bench, rung, model, group, options);
  return rung;
}

Visibility visibility(Bench& bench, const Model& without, const Term& term,
                      const TorqueViewOptions& options) {
  set_torque(bench.judge, without);
  Eigen::MatrixXd g(bench.judge.size(), term.law->columns);
  fill_columns(bench.judge, *term.law, term.shape, g);
  const Eigen::VectorXd torque = g * term.theta;
  const double away = Projection(bench.judge, without, torque).square();
  Model full = without;
  full.push_back(term);
  const double left = bench.squares(fitted(bench.fit, full)).sum();
  const double odds = options.least_share / (1.0 - options.least_share);
  return {away / (away + left), 1.0 - away / torque.squaredNorm(), std::sqrt(odds * left / away)};
}

}  // namespace gapscope::internal::torque_view
