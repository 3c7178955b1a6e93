#include "torque_view/foretold_rung.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::torque_view {
namespace {

/// The share of y that columns say.
double share_said(const Eigen::VectorXd& y, const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd scale = columns.colwise().norm().transpose().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = columns * scale.asDiagonal();
  const Eigen::VectorXd against = scaled.transpose() * y;
  const Eigen::MatrixXd gram = scaled.transpose() * scaled;
  const double square = y.squaredNorm();
  return square > 0.0 ? against.dot(gram.completeOrthogonalDecomposition().solve(against)) / square : 0.0;
}

ForetoldRival rival_of(const Contest& contest, const Signature& law, const Signature& rival,
                       const Eigen::VectorXd& unit, const Eigen::VectorXd& fit_left,
                       const Eigen::VectorXd& judge_left) {
  ForetoldRival r;
  r.signature = &rival;
  r.constant = rival.basis.transpose() * fit_left;
  r.linear = rival.basis.transpose() * (law.fit * unit);
  const Eigen::MatrixXd shown = rival.judge * rival.coefficients;
  const Eigen::VectorXd takes = shown * r.linear, whole = law.judge * unit;
  r.after = Parabola(contest.blocks, judge_left - shown * r.constant, whole - takes);
  r.says = share_said(whole, rival.judge);
  r.said = share_said(takes, law.judge);
  return r;
}

double share_of(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  return 1.0 - after.sum() / before.sum();
}

}  // namespace

Parabola::Parabola(const Blocks& blocks, const Eigen::VectorXd& p, const Eigen::VectorXd& q)
    : constant_(blocks.squares(p)), square_(blocks.squares(q)) {
  linear_ = blocks.squares(p + q) - constant_ - square_;
}

Eigen::VectorXd Parabola::at(double theta) const {
  return (constant_ + theta * linear_ + theta * theta * square_).cwiseMax(0.0);
}

bool ForetoldRival::is_there(double theta) const {
  const Eigen::VectorXd c = signature->coefficients * (constant + theta * linear);
  return has_its_sign(*signature->law, c[signature->own], kInfinity);
}

ForetoldRung::ForetoldRung(const Contest& contest, const Signature& law, const Eigen::VectorXd& unit)
    : contest_(contest), law_(law) {
  const Eigen::VectorXd own = law.coefficients * (law.basis.transpose() * contest.fit_left);
  const Eigen::VectorXd fit_left = contest.fit_left - law.fit * own;
  const Eigen::VectorXd judge_left = contest.judge_left - law.judge * own;
  after_ = contest.blocks.squares(judge_left);
  before_ = Parabola(contest.blocks, judge_left, law.judge * unit);
  for (const Signature& s : contest.signatures)
    if (!is_same_torque(*s.law, *law.law))
      rivals_.push_back(rival_of(contest, law, s, unit, fit_left, judge_left));
}

/// Every rival at the shape that its fit prefers, best first.
std::vector<ForetoldRung::Standing> ForetoldRung::standings(double theta,
                                                            const Eigen::VectorXd& before) const {
  std::vector<Standing> all;
  for (const ForetoldRival& r : rivals_) {
    if (!r.is_there(theta)) continue;
    const bool same_law = !all.empty() && all.back().rival->signature->law == r.signature->law;
    if (!same_law)
      all.push_back({&r, {}, {}});
    else if (r.gain(theta) > all.back().rival->gain(theta))
      all.back().rival = &r;
  }
  for (Standing& s : all) {
    s.squares = s.rival->after.at(theta);
    s.evidence.share = share_of(before, s.squares);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Standing& a, const Standing& b) { return a.evidence.share > b.evidence.share; });
  return all;
}

/// A leader in whose place the law is chosen all the same: one that contains it, or is of a group with it and
/// less simple, and does not clearly lead.
bool ForetoldRung::yields(const Standing& leader, const Evidence& own) const {
  const Signature& s = *leader.rival->signature;
  if (adds_to(*s.law, *law_.law)) return is_worth_having(own, contest_.options);
  return leader.rival->said >= contest_.options.same_group && law_.law->parameters() < s.law->parameters() &&
         contest_.blocks.leading(leader.squares, after_) < contest_.options.least_leading;
}

/// A rival that is simpler and chosen in the law's place although that leads.
bool ForetoldRung::takes_its_place(const Standing& rival, const Eigen::VectorXd& before) const {
  const Law& other = *rival.rival->signature->law;
  if (adds_to(*law_.law, other))
    return is_worth_having(contest_.blocks.compare(before, rival.squares), contest_.options);
  return rival.rival->says >= contest_.options.same_group && other.parameters() < law_.law->parameters() &&
         contest_.blocks.leading(after_, rival.squares) < contest_.options.least_leading;
}

/// One of a group with the law, or that says less of the same.
bool ForetoldRung::is_no_rival(const Standing& rival) const {
  const Law& other = *rival.rival->signature->law;
  if (adds_to(*law_.law, other) || adds_to(other, *law_.law)) return true;
  if (rival.rival->says >= contest_.options.same_group) return true;
  return rival.rival->said >= contest_.options.same_group &&
         contest_.blocks.leading(after_, rival.squares) >= contest_.options.least_leading;
}

Foretold ForetoldRung::among(const std::vector<Standing>& all, const Eigen::VectorXd& before,
                             const Evidence& own) const {
  const TorqueViewOptions& options = contest_.options;
  bool first_rival = true;
  for (const Standing& s : all) {
    const Law& other = *s.rival->signature->law;
    if (is_free_form(other)) {
      if (s.evidence.share >= (1.0 - options.least_margin) * own.share &&
          contest_.follows_another(other, *law_.law))
        return {false, &other};
      continue;
    }
    const bool leads = s.evidence.share > own.share;
    if (leads ? !yields(s, own) : takes_its_place(s, before)) return {false, &other};
    if (leads || !first_rival || is_no_rival(s)) continue;
    first_rival = false;
    if (margin_over(own, s.evidence) < options.least_margin ||
        contest_.blocks.leading(after_, s.squares) < options.least_leading)
      return {false, &other};
  }
  return {true, nullptr};
}

Foretold ForetoldRung::at(double theta) const {
  const TorqueViewOptions& options = contest_.options;
  const Eigen::VectorXd before = before_.at(theta);
  const double encoder =
      contest_.encoder * contest_.encoder * static_cast<double>(contest_.judge_left.size());
  if (encoder >= options.most_encoder * before.sum()) return {};
  const Evidence own = contest_.blocks.compare(before, after_);
  if (!is_clear(own, options)) return {};
  return among(standings(theta, before), before, own);
}

}  // namespace gapscope::internal::torque_view
