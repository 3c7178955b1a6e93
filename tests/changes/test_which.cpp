#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "changes/chance.h"
#include "changes/which.h"

namespace gapscope {
namespace {

using internal::changes::which_differs;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<std::string> kKeys = {"gap", "motor_damping", "load_coulomb_friction", "contact_stiffness"};

/// A fit of four numbers that are 1 by their truth, each known to 1 %.
DriveReport fitted(const std::vector<double>& values) {
  DriveReport r;
  r.reference.emplace();
  r.reference->status = FitStatus::kConverged;
  r.reference->trust = FitTrust::kGood;
  r.reference->innovation_rmse = r.reference->floor = 1e-5;
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    FittedParameter p;
    p.key = kKeys[i], p.value = values[i], p.std = 0.01;
    p.ci95 = {p.value - 0.0196, p.value + 0.0196};
    p.estimated = p.identifiable = true;
    r.reference->parameters.push_back(p);
  }
  return r;
}

TEST(WhichDiffers, TheNumberThatChangedIsNamedAndTheOthersNeedNot) {
  const WhichDiffers w = which_differs(fitted({1.0, 1.0, 1.0, 1.0}), fitted({1.2, 1.005, 0.99, 1.0}));
  EXPECT_EQ(w.verdict, WhichVerdict::kNamed);
  ASSERT_EQ(w.numbers.size(), 1u);
  EXPECT_EQ(w.numbers[0].key, "gap");
  EXPECT_THAT(w.numbers[0].look_alikes, IsEmpty());
  EXPECT_EQ(w.compared.size(), 4u);
}

TEST(WhichDiffers, WhatActsAlikeAndIsInNeitherFitMayHaveChangedInItsPlace) {
  const WhichDiffers w = which_differs(fitted({1.0, 1.0, 1.0, 1.0}), fitted({1.0, 1.2, 1.1, 1.0}));
  ASSERT_EQ(w.numbers.size(), 2u);
  EXPECT_EQ(w.numbers[0].key, "motor_damping");  // the surest first
  EXPECT_THAT(w.numbers[0].look_alikes, ElementsAre("motor_coulomb_friction"));
  EXPECT_EQ(w.numbers[1].key, "load_coulomb_friction");
  EXPECT_THAT(w.numbers[1].look_alikes, ElementsAre("load_damping"));
}

TEST(WhichDiffers, AModelThatLeavesMoreThanTheEncoderNamesLess) {
  DriveReport poor = fitted({1.06, 1.0, 1.0, 1.0});
  EXPECT_EQ(which_differs(fitted({1.0, 1.0, 1.0, 1.0}), poor).verdict, WhichVerdict::kNamed);
  poor.reference->innovation_rmse = 2.5e-5;
  EXPECT_EQ(which_differs(fitted({1.0, 1.0, 1.0, 1.0}), poor).verdict, WhichVerdict::kNone);
  poor.reference->innovation_rmse = 5e-4;  // no number of that fit says anything of the other's
  EXPECT_EQ(which_differs(fitted({1.0, 1.0, 1.0, 1.0}), poor).verdict, WhichVerdict::kStructure);
}

TEST(WhichDiffers, NothingIsNamedOfDrivesThatAreTheSame) {
  std::mt19937_64 random = random_stream(9, "the same drive twice");
  int named = 0;
  for (int drive = 0; drive < 400; ++drive) {
    const auto drawn = [&] {
      std::vector<double> v;
      for (int i = 0; i < 4; ++i) v.push_back(1.0 + 0.01 * normal(random));
      return fitted(v);
    };
    named += which_differs(drawn(), drawn()).verdict != WhichVerdict::kNone;
  }
  EXPECT_LE(named, 20 + 3 * 4.4);
  EXPECT_GE(named, 1);
}

TEST(WhichDiffers, IsNotAskedOfARejectedModel) {
  DriveReport rejected = fitted({1.2, 1.0, 1.0, 1.0});
  rejected.reference->trust = FitTrust::kRejected;
  EXPECT_EQ(which_differs(fitted({1.0, 1.0, 1.0, 1.0}), rejected).verdict, WhichVerdict::kNotAsked);
}

TEST(Chance, QuantilesAreThoseOfTheTables) {
  using namespace internal::changes;
  EXPECT_NEAR(two_sided_quantile(0.05), 1.95996, 1e-5);
  EXPECT_NEAR(normal_of_student(2.306, 8.0), 1.95996, 5e-3);
  EXPECT_NEAR(normal_of_student(-5.041, 8.0), -3.291, 2e-2);  // 0.001 on both sides
}

}  // namespace
}  // namespace gapscope
