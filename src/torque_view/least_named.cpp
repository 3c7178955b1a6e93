#include "torque_view/least_named.h"

#include <algorithm>
#include <cmath>

#include "torque_view/foretold_rung.h"

namespace gapscope::internal::torque_view {
namespace {

constexpr double kStep = 1.25;  ///< between amounts that are tried
constexpr int kHalvings = 3;    ///< of the last step

/// What one unit of a law is, in coefficients: ratios of what the model has for the two of an asymmetry, each
/// phase for a line.
std::vector<Eigen::VectorXd> directions(const Law& law, const Model& model) {
  if (law.columns == 1) return {Eigen::VectorXd::Ones(1)};
  if (law.line) return {Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY()};
  return {Eigen::Vector2d(first_coefficient(model, law.simpler), first_coefficient(model, "viscous"))};
}

bool is_told(const Law& law, const Model& model) {
  return law.values != nullptr && !lacks_simpler(model, law) && find_term(model, law.name) == nullptr;
}

/// The signature in the middle of those of its law, by the amount that the held-out rows could show.
const Signature& middle(const std::vector<const Signature*>& of_law) {
  std::vector<const Signature*> by_size = of_law;
  std::stable_sort(by_size.begin(), by_size.end(), [](const Signature* a, const Signature* b) {
    return a->judge.squaredNorm() > b->judge.squaredNorm();
  });
  return *by_size[(by_size.size() - 1) / 2];
}

struct Range {
  double first = kNaN, last = kNaN;
};

/// The least amount, geometrically, to a few per cent; NaN if there is none, and what hid it last.
double least_amount(const ForetoldRung& rung, const Range& range, const Law*& hidden_by) {
  double before = kNaN;
  for (double amount = range.first; amount <= range.last; before = amount, amount *= kStep) {
    const Foretold seen = rung.at(amount);
    hidden_by = seen.hidden_by;
    if (!seen.named) continue;
    for (int i = 0; i < kHalvings && before < amount; ++i) {
      const double between = std::sqrt(before * amount);
      (rung.at(between).named ? amount : before) = between;
    }
    return amount;
  }
  return kNaN;
}

class Search {
 public:
  Search(Bench& bench, const Budget& budget, double encoder, const FollowsAnother& follows_another,
         const TorqueViewOptions& options)
      : budget_(budget),
        options_(options),
        below_(bench, budget.model),
        signatures_(below_.all_signatures(options)),
        contest_{bench.blocks, below_.fit_left(), below_.judge_left(), signatures_, follows_another, encoder,
                 options} {}

  std::vector<LeastNamed> all() const {
    std::vector<const Law*> told;
    for (const Signature& s : signatures_)
      if (is_told(*s.law, budget_.model) && (told.empty() || told.back() != s.law)) told.push_back(s.law);
    std::vector<LeastNamed> least(told.size());
    for (std::size_t i = 0; i < told.size(); ++i) least[i] = of(*told[i]);
    return least;
  }

 private:
  LeastNamed of(const Law& law) const {
    std::vector<const Signature*> of_law;
    for (const Signature& s : signatures_)
      if (s.law == &law) of_law.push_back(&s);
    const Signature& g = middle(of_law);
    LeastNamed worst{&law, g.shape, {}, 0.0, false, nullptr};
    for (const Eigen::VectorXd& unit : directions(law, budget_.model)) {
      const LeastNamed one = along(g, unit);
      if (!one.exists()) return one;
      if (one.torque > worst.torque) worst = one;
    }
    return worst;
  }

  LeastNamed along(const Signature& g, const Eigen::VectorXd& unit) const {
    LeastNamed least{g.law, g.shape, {}, kNaN, false, nullptr};
    const Eigen::VectorXd fitted = g.fit * unit, shown = g.judge * unit;
    least.said_by_model =
        !(fitted.squaredNorm() > (1.0 - options_.most_absorbed) * (g.whole * unit).squaredNorm());
    if (least.said_by_model) return least;
    const double torque = (g.judge_whole * unit).norm() / std::sqrt(static_cast<double>(shown.size()));
    const ForetoldRung rung(contest_, g, unit);
    const double odds = options_.least_share / (1.0 - options_.least_share);
    const double first = 0.5 * std::sqrt(odds * rung.after().sum() / shown.squaredNorm());
    const double amount = least_amount(rung, {first, budget_.input_rms / torque}, least.hidden_by);
    if (std::isfinite(amount)) least.theta = amount * unit, least.torque = amount * torque;
    return least;
  }

  const Budget& budget_;
  const TorqueViewOptions& options_;
  Below below_;
  std::vector<Signature> signatures_;
  Contest contest_;
};

}  // namespace

std::vector<LeastNamed> least_named(const SplitRecordings& data, const Budget& budget,
                                    const FollowsAnother& follows_another, const TorqueViewOptions& options) {
  Bench bench = bench_of(data, budget.band, options);
  take_line(bench, budget.model);
  const double encoder =
      encoder_torque_floor(data, budget.band.hz, first_coefficient(budget.model, "inertia"));
  return Search(bench, budget, encoder, follows_another, options).all();
}

}  // namespace gapscope::internal::torque_view
