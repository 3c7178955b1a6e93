#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "changes/two_groups.h"
#include "changes/which.h"

namespace gapscope {
namespace {

using internal::changes::TwoGroups;
using internal::changes::which_differs;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

const std::vector<std::string> kNumbers = {"gap", "motor_damping", "load_coulomb_friction"};
constexpr int kPieceCount = 6, kSamples = 200;

/// Least squares of y = X v + noise of one floor, in pieces. The last two columns of X are alike but for a
/// part.
DriveReport least_squares(const Eigen::Vector3d& truth, double unlike, std::uint64_t seed) {
  std::mt19937_64 g = random_stream(seed, "a linear drive");
  const int n = kPieceCount * kSamples;
  Eigen::MatrixXd x(n, 3);
  Eigen::VectorXd y(n);
  for (int i = 0; i < n; ++i) {
    x.row(i) << normal(g), normal(g), 0.0;
    x(i, 2) = x(i, 1) + unlike * normal(g);
    y[i] = x.row(i).dot(truth) + normal(g);
  }
  const Eigen::Matrix3d inverse = (x.transpose() * x).inverse();
  const Eigen::Vector3d values = inverse * x.transpose() * y;
  DriveReport r;
  r.reference.emplace();
  r.reference->status = FitStatus::kConverged;
  r.reference->trust = FitTrust::kGood;
  r.reference->innovation_rmse = r.reference->floor = 1e-5;
  for (int k = 0; k < 3; ++k) {
    FittedParameter p;
    p.key = kNumbers[static_cast<std::size_t>(k)], p.value = values[k], p.std = std::sqrt(inverse(k, k));
    p.ci95 = {p.value - 1.96 * p.std, p.value + 1.96 * p.std};
    p.estimated = p.identifiable = true;
    r.reference->parameters.push_back(p);
  }
  for (int k = 0; k < kPieceCount; ++k) {
    const Eigen::MatrixXd rows = x.middleRows(k * kSamples, kSamples);
    const Eigen::VectorXd left = rows * values - y.segment(k * kSamples, kSamples);
    const Eigen::Matrix3d square = rows.transpose() * rows;
    const Eigen::Vector3d slope = rows.transpose() * left;
    FitPiece piece{k, kSamples, left.squaredNorm(), {slope[0], slope[1], slope[2]}, {}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) piece.normal.push_back(square(i, j));
    r.reference->pieces.push_back(piece);
  }
  return r;
}

const Eigen::Vector3d kTruth(1.0, 2.0, 3.0);

TEST(TwoGroups, AJointFitForetellsWhatItHasNotSeenOnceTheRightNumberMayDiffer) {
  const DriveReport a = least_squares(kTruth, 1.0, 1),
                    b = least_squares(kTruth + Eigen::Vector3d(0.5, 0.0, 0.0), 1.0, 2);
  const TwoGroups groups(*a.reference, *b.reference, kNumbers);
  const double off_shared = groups.held_out({false, false, false});
  EXPECT_NEAR(groups.held_out({true, false, false}), 1.0, 0.05);  // the noise of 2400 samples: ±0.015
  EXPECT_NEAR(off_shared, std::sqrt(1.0 + 0.25 * 0.25), 0.03);    // half of the difference in either group
  EXPECT_GT(groups.held_out({false, true, false}), 0.99 * off_shared);
  EXPECT_GT(groups.p_if_only({true, false, false}), 0.01);
  EXPECT_LT(groups.p_if_only({false, true, true}), 1e-10);
}

TEST(TwoGroups, WhatOnlyOneOfTwoAlikeNumbersExplainsIsToldAsOneOfThem) {
  // Each alone is within its error of 1/(0.03 √1200), their sum is far beyond.
  const DriveReport a = least_squares(kTruth, 0.03, 3),
                    b = least_squares(kTruth + Eigen::Vector3d(0.0, 0.4, 0.0), 0.03, 4);
  const WhichDiffers w = which_differs(a, b);
  EXPECT_EQ(w.verdict, WhichVerdict::kUntold);
  EXPECT_THAT(w.numbers, IsEmpty());
  EXPECT_THAT(w.one_of, UnorderedElementsAre("motor_damping", "load_coulomb_friction"));
  EXPECT_GT(w.off_shared, w.off_free);
}

TEST(TwoGroups, OfDrivesThatAreTheSameSomethingIsToldInOneOfTwenty) {
  int told = 0;
  for (std::uint64_t i = 0; i < 200; ++i)
    told += which_differs(least_squares(kTruth, 0.3, 100 + 2 * i), least_squares(kTruth, 0.3, 101 + 2 * i))
                .verdict != WhichVerdict::kNone;
  EXPECT_LE(told, 10 + 3 * 3.1);
}

}  // namespace
}  // namespace gapscope
