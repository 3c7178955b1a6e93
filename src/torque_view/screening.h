#pragma once

#include <string>
#include <vector>

#include "torque_view/evidence.h"
#include "torque_view/search.h"

namespace gapscope::internal::torque_view {

/// What is fitted, what is held out, and what all comparisons need of them.
struct Bench {
  Rows fit, judge;
  Scales scales;
  Blocks blocks;
  bool new_phase = false;
  std::vector<std::string> closed;  ///< effects that are no candidates
  int threads = 1;                  ///< on which laws are tried side by side
  /// Goes before the line that contains it, though that one's period fits better while others are missing.
  const Law* simpler_line = nullptr;

  Eigen::VectorXd left(const Model& model) { return residual(judge, model, new_phase); }
  Eigen::VectorXd squares(const Model& model) { return blocks.squares(left(model)); }
};

/// A law on top of a model, fitted jointly with it and judged on what was held out.
struct Candidate {
  const Law* law = nullptr;
  Model model;
  Eigen::VectorXd squares;  ///< of the held-out residual, by blocks
  Evidence evidence;        ///< against the model below
};

/// One step of the ladder, taken or not.
struct Rung {
  std::vector<Candidate> ranking;      ///< all that were tried, by share
  std::size_t chosen = 0;              ///< in the ranking
  std::vector<std::string> group;      ///< with it: what this recording cannot tell apart
  std::string rival;                   ///< the best one outside the group
  double margin = 0.0, leading = 0.0;  ///< over it: see least_margin; in how many draws
  bool named = false;                  ///< the whole rule holds
  bool helps = false;                  ///< it takes a share worth having, whatever its cause

  double rms = kNaN;  ///< of the held-out residual after it [unit of u]

  const Candidate& choice() const { return ranking[chosen]; }
};

/// Every law of the table at its best shape on top of the model, and the step that they support.
Rung next_rung(Bench& bench, const Model& model, const TorqueViewOptions& options);

/// What a term, which the model does not have, would show on the held-out rows.
Visibility visibility(Bench& bench, const Model& without, const Term& term, const TorqueViewOptions& options);

/// Whether a law is drawn from the data and stands for no cause.
bool is_free_form(const Law& law);

// The parts of the rule that names the choice of a rung.
/// The laws that a step may add to the model.
std::vector<const Law*> open_laws(Bench& bench, const Model& model, const TorqueViewOptions& options);
/// Whether a law brings another one along that the model does not have yet.
bool lacks_simpler(const Model& model, const Law& law);
/// Whether a law adds to the other one.
bool adds_to(const Law& law, const Law& other);
/// Whether a line whose period is searched comes, at one of them, to the other law, of a given period.
bool contains_line(const Law& searched, const Law& given);
bool is_worth_having(const Evidence& evidence, const TorqueViewOptions& options);
/// Whether the evidence alone suffices to be named, whatever its rivals show.
bool is_clear(const Evidence& evidence, const TorqueViewOptions& options);
/// See least_margin.
double margin_over(const Evidence& choice, const Evidence& rival);

}  // namespace gapscope::internal::torque_view
