#include "torque_view/evidence.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace gapscope::internal::torque_view {

Blocks::Blocks(const Rows& rows, const TorqueViewOptions& options) {
  for (const BandRecord& record : rows.records()) {
    std::size_t last = static_cast<std::size_t>(-1);
    for (const double t : record.row_time) {
      const auto block = static_cast<std::size_t>((t - record.t.front()) / options.block);
      if (block != last) ++count_;
      last = block;
      of_row_.push_back(count_ - 1);
    }
  }
  draw(options);
}

Blocks::Blocks(std::size_t count, const TorqueViewOptions& options) : count_(count) { draw(options); }

void Blocks::draw(const TorqueViewOptions& options) {
  std::mt19937_64 generator = random_stream(options.seed, "torque view blocks");
  draws_.resize(static_cast<std::size_t>(options.draws));
  for (std::vector<std::size_t>& blocks : draws_)
    for (std::size_t i = 0; i < count_; ++i)
      blocks.push_back(static_cast<std::size_t>(uniform(generator, 0.0, static_cast<double>(count_))));
}

Eigen::VectorXd Blocks::squares(const Eigen::VectorXd& residual) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count_));
  for (std::size_t r = 0; r < of_row_.size(); ++r) {
    const double e = residual[static_cast<Eigen::Index>(r)];
    sums[static_cast<Eigen::Index>(of_row_[r])] += e * e;
  }
  return sums;
}

Evidence Blocks::compare(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
  Evidence evidence;
  if (count_ == 0 || before.sum() <= 0.0) return evidence;
  evidence.share = 1.0 - after.sum() / before.sum();
  evidence.better =
      static_cast<double>((after.array() < before.array()).count()) / static_cast<double>(count_);
  std::vector<double> shares;
  for (const auto& draw : draws_) {
    double b = 0.0, a = 0.0;
    for (const std::size_t i : draw)
      b += before[static_cast<Eigen::Index>(i)], a += after[static_cast<Eigen::Index>(i)];
    shares.push_back(1.0 - a / b);
  }
  evidence.interval = {quantile(shares, 0.025), quantile(shares, 0.975)};
  return evidence;
}

double Blocks::leading(const Eigen::VectorXd& squares, const Eigen::VectorXd& other) const {
  int ahead = 0;
  for (const auto& draw : draws_) {
    double difference = 0.0;
    for (const std::size_t i : draw)
      difference += other[static_cast<Eigen::Index>(i)] - squares[static_cast<Eigen::Index>(i)];
    if (difference > 0.0) ++ahead;
  }
  return static_cast<double>(ahead) / static_cast<double>(draws_.size());
}

}  // namespace gapscope::internal::torque_view
