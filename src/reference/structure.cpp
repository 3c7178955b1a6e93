#include "reference/structure.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "plant/rival_laws.h"

namespace gapscope::internal::reference {
namespace {

constexpr RefineEffort kNear{2, 8, 1e-3};    ///< from afar under the observer, whose minima are wide
constexpr RefineEffort kAfar{5, 16, 1e-4};   ///< of the free run from there
constexpr RefineEffort kBeside{2, 8, 1e-4};  ///< of the free run where the optimum is near

/// No further law is tried once fit and laws have taken so many times what the fit took.
constexpr double kMostWork = 2.0;

/// A law, and where the search for its numbers begins, in units of their scales; NaN: held.
struct Rival {
  std::string_view effect, words;
  std::array<double, 2> begins;
  bool afar = false;                      ///< it is not the model's own law by a small step
  double stiffness = 1.0, damping = 1.0;  ///< of the contact where it begins, over those of the own law
};
constexpr Rival kRivals[] = {{"hunt_crossley_contact", "Hunt-Crossley contact", {kNaN, kNaN}, true, 2.0, 3.0},
                             {"contact_hardening", "hardening contact", {2.0, 1.5}, true},
                             {"load_breakaway", "load that needs more to break away", {0.05, 0.1}}};

const EffectEntry& law_of(const Rival& rival) {
  for (const EffectEntry* entry : rival_law_table())
    if (rival.effect == entry->name) return *entry;
  return *find_effect(rival.effect);
}

bool contains(const FitProblem& problem, const EffectEntry& law) {
  return std::find(problem.effects.begin(), problem.effects.end(), &law) != problem.effects.end();
}

bool has_place(const FitProblem& problem, const EffectEntry& law) {
  if (contains(problem, law)) return false;
  if (law.needs == EffectNeeds::kContact) return problem.structure.contact == ContactLaw::kCompliant;
  return !problem.locked() && problem.load_may_stick;
}

/// χ² in what one number gains by chance.
double in_chances(const FitOutcome& outcome, double square) {
  return square / (kBeyondChance * outcome.information.variance * outcome.information.inflation);
}

/// In the free run, from afar under the observer before.
RivalFit refit(const FitProblem& other, FitPoint from, bool afar, std::size_t more, FitOutcome& outcome) {
  RivalFit told;
  if (afar) {
    const RefinedFit near = refine(other, from, other.options.observer_hz, kNear);
    outcome.simulations += near.simulations;
    if (!near.usable()) return told;
    from = near;
  }
  const RefinedFit to = refine(other, from, 0.0, afar ? kAfar : kBeside);
  outcome.simulations += to.simulations;
  if (!to.usable()) return told;
  const Square left = mean_square_with_priors(other, to, 0.0);
  outcome.simulations += left.simulations;
  double samples = 0.0;
  for (const MotorTrace& r : other.recordings) samples += static_cast<double>(r.size());
  told.gap = other.numbers<double>(to.q.data()).drive(place::kGap);
  told.advantage = in_chances(outcome, samples * (outcome.solution.mean_square_with_priors - left.value)) /
                   static_cast<double>(std::max<std::size_t>(1, more));
  return told;
}

/// Multiplies a number of a point, where it is free, within its bounds.
void scale(const FitProblem& problem, ParameterId id, double factor, FitPoint& at) {
  for (std::size_t i = 0; i < problem.free_count(); ++i) {
    const Parameter& p = problem.free_parameter(i);
    if (p.id == id)
      at.q[i] = p.coordinate.solver(std::clamp(factor * p.coordinate.physical(at.q[i]), p.low, p.high));
  }
}

/// Whether the cost falls beyond the bound at which a number stands, by a Gauss–Newton step of all numbers.
bool falls_beyond(const FitOutcome& outcome, Eigen::Index i) {
  const Information& info = outcome.information;
  const Eigen::VectorXd scale = info.normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * info.normal * scale.asDiagonal();
  const Eigen::VectorXd row = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(scaled).solve(
      Eigen::VectorXd::Unit(scaled.rows(), i));
  const double slope = info.score[i] * scale[i];
  return in_chances(outcome, slope * slope * row[i]) > 1.0;
}

/// Whether a start with that number well within its bounds ends lower.
bool falls_from_within(const FitProblem& problem, std::size_t i, FitOutcome& outcome) {
  FitPoint from = outcome.solution;
  const Parameter& p = problem.free_parameter(i);
  from.q[i] = p.coordinate.solver(std::min(p.typical, 0.5 * (p.low + p.high)));
  return refit(problem, from, true, 1, outcome).explains_better();
}

}  // namespace

void try_rival_laws(const FitProblem& problem, FitOutcome& outcome) {
  if (outcome.objective_hz != 0.0 || !problem.structure.has_load || !outcome.solution.converged) return;
  const double most = kMostWork * outcome.simulations;
  for (const Rival& rival : kRivals) {
    const EffectEntry& law = law_of(rival);
    if (!has_place(problem, law) || outcome.simulations > most) continue;
    FitPoint from = outcome.solution;
    const FitProblem other = with_law(problem, law, rival.begins, from);
    scale(other, drive_number(place::kContactStiffness), rival.stiffness, from);
    scale(other, drive_number(place::kContactDamping), rival.damping, from);
    RivalFit found = refit(other, from, rival.afar, other.free_count() - problem.free_count(), outcome);
    found.law = rival.words;
    outcome.rivals.push_back(found);
  }
}

void find_pressed(const FitProblem& problem, FitOutcome& outcome) {
  if (outcome.objective_hz != 0.0 || !outcome.information.valid) return;
  for (std::size_t i = 0; i < problem.free_count(); ++i) {
    const Parameter& p = problem.free_parameter(i);
    const double value = p.coordinate.physical(outcome.solution.q[i]);
    if (!p.at_bound(outcome.solution.q[i])) continue;
    const bool at_zero = p.low == 0.0 && value < 0.5 * p.high;
    if (!at_zero || falls_beyond(outcome, static_cast<Eigen::Index>(i)) ||
        falls_from_within(problem, i, outcome))
      outcome.pressed.push_back(p.key);
  }
}

void tell_structure(const FitProblem& problem, const FitOutcome& outcome, FitSummary& summary) {
  const auto gap = std::find_if(summary.parameters.begin(), summary.parameters.end(),
                                [](const FittedParameter& p) { return p.key == "gap"; });
  if (outcome.rivals.empty() || gap == summary.parameters.end() || !gap->estimated) return;
  const bool hardens = contains(problem, *find_effect("contact_hardening"));
  FitStructure s{{hardens ? "hardening contact" : "linear contact"}, gap->value, gap->value};
  for (const RivalFit& rival : outcome.rivals) {
    if (!rival.explains()) continue;
    s.laws.push_back(rival.law);
    s.gap_low = std::min(s.gap_low, rival.gap), s.gap_high = std::max(s.gap_high, rival.gap);
  }
  for (Interval* i : {&gap->ci95, &gap->profile_ci95}) {
    i->low -= gap->value - s.gap_low, i->high += s.gap_high - gap->value;
    i->low = std::max(i->low, gap->low), i->high = std::min(i->high, gap->high);
  }
  summary.structure = s;
}

}  // namespace gapscope::internal::reference
