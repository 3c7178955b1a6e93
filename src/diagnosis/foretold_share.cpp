#include "diagnosis/foretold_share.h"

#include <algorithm>

#include "diagnosis/torque_search.h"

namespace gapscope {

using namespace internal::diagnosis;
namespace view = internal::torque_view;

struct ForetoldShares::Undisturbed {
  std::vector<MotorTrace> train, held_out;
  DiagnosisOptions options;
  ReferenceModel model;
  std::optional<view::Budget> budget;

  /// What the terms of the budget, without those of an effect, leave of the held-out rows: mean square.
  double left_of(std::span<const MotorTrace> fit, std::span<const MotorTrace> rest,
                 const std::string& effect) const {
    const Study study = make_study(fit, rest, model, options);
    view::Bench bench = view::bench_of(in_torque(study, model), budget->band, {});
    view::Model terms = budget->model;
    std::erase_if(terms, [&](const view::Term& t) { return !effect.empty() && effect == t.law->effect; });
    const Eigen::VectorXd left = bench.left(view::fitted(bench.fit, std::move(terms)));
    return left.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, left.size()));
  }
};

ForetoldShares::ForetoldShares(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                               const ReferenceModel& model, const DiagnosisOptions& options)
    : undisturbed_(std::make_unique<Undisturbed>(Undisturbed{
          {train.begin(), train.end()}, {held_out.begin(), held_out.end()}, options, model, {}})) {
  const Study study = make_study(train, held_out, model, undisturbed_->options);
  undisturbed_->budget = torque_budget(study, model);
}

ForetoldShares::~ForetoldShares() = default;

double ForetoldShares::of(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                          const std::string& effect) const {
  const Undisturbed& u = *undisturbed_;
  if (!u.budget) return kNaN;
  const double with = u.left_of(train, held_out, effect), without = u.left_of(u.train, u.held_out, effect);
  return std::clamp(1.0 - without / with, 0.0, 1.0);
}

}  // namespace gapscope
