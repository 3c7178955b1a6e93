#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "drives.h"
#include "torque_view/implanted_ladder.h"

namespace gapscope::internal::torque_view {
namespace {

using test::kDamping, test::kInertia, test::Motion;
using Extra = std::function<double(const Motion&)>;

constexpr double kNoise = 0.4;     ///< of u, which no law explains [N m]
constexpr double kFriction = 0.3;  ///< that the drives have beside what is looked for [N m]

double sign(double w) { return w > 0.0 ? 1.0 : -1.0; }

/// Fitted on one motion, judged on another phase of it.
SplitRecordings recordings(const Extra& extra) {
  const Extra all = [&](const Motion& m) { return kFriction * sign(m.w) + extra(m); };
  return {{test::recorded(all, 0.3, kNoise)}, {test::recorded(all, 1.7, kNoise)}};
}

/// A constant and a friction are functions of the speed, of the direction at least.
bool follows_another(const Law& free_form, const Law& law) {
  const bool speed = law.kind == Kind::kFriction || law.name == std::string("constant_load_torque");
  return free_form.name == std::string("free_speed_curve") ? !speed : !law.line;
}

std::vector<LeastNamed> foretold(const Extra& extra) {
  const SplitRecordings data = recordings(extra);
  return least_named(data, error_budget(data), follows_another);
}

const LeastNamed& of(const std::vector<LeastNamed>& all, const std::string& law) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const LeastNamed& l) { return law == l.law->name; });
  EXPECT_NE(at, all.end()) << law;
  return *at;
}

bool is_named(const std::string& law, const Extra& extra) {
  const Budget b = error_budget(recordings(extra));
  return std::any_of(b.rungs.begin(), b.rungs.end(),
                     [&](const Rung& r) { return r.named && law == r.choice().law->name; });
}

struct SizedLaw {
  const char* law;
  std::function<double(const Motion&, double size, double shape)> torque;
};

/// The laws by formulas of their own, on motions in closed form.
const SizedLaw kSizedLaws[] = {
    {"load_unbalance", [](const Motion& m, double size, double) { return size * std::sin(m.x + 0.7); }},
    {"cogging_torque", [](const Motion& m, double size, double k) { return size * std::sin(k * m.x + 0.7); }},
    {"constant_load_torque", [](const Motion&, double size, double) { return size; }},
    {"quadratic_drag", [](const Motion& m, double size, double) { return size * m.w * std::abs(m.w); }},
    {"stribeck_friction",
     [](const Motion& m, double size, double speed) {
       return size * sign(m.w) * std::exp(-m.w * m.w / (speed * speed));
     }},
};

TEST(LeastNamed, ThreeTimesAsMuchIsNamedByTheLadderAndAThirdIsNot) {
  const std::vector<LeastNamed> all = foretold([](const Motion&) { return 0.0; });
  for (const SizedLaw& law : kSizedLaws) {
    const LeastNamed& least = of(all, law.law);
    ASSERT_TRUE(least.exists()) << law.law;
    const auto times = [&](double factor) {
      return [&, factor](const Motion& m) { return law.torque(m, factor * least.theta.norm(), least.shape); };
    };
    EXPECT_TRUE(is_named(law.law, times(3.0))) << law.law;
    EXPECT_FALSE(is_named(law.law, times(1.0 / 3.0))) << law.law;
  }
}

bool is_added(const std::string& law, const Extra& extra) {
  const Budget b = error_budget(recordings(extra));
  return std::any_of(b.model.begin() + static_cast<std::ptrdiff_t>(b.nominal.size()), b.model.end(),
                     [&](const Term& term) { return law == term.law->name; });
}

TEST(LeastNamed, CorrectedByImplantsTwiceAsMuchIsAddedAndHalfOfItIsNot) {
  const SplitRecordings data = recordings([](const Motion&) { return 0.0; });
  const Budget budget = error_budget(data);
  std::vector<LeastNamed> all = least_named(data, budget, follows_another);
  std::erase_if(all, [](const LeastNamed& least) {  // each is corrected for itself
    return std::none_of(std::begin(kSizedLaws), std::end(kSizedLaws),
                        [&](const SizedLaw& law) { return least.law->name == std::string(law.law); });
  });
  correct_by_implants(data, budget, all);
  for (const SizedLaw& law : kSizedLaws) {
    const LeastNamed& least = of(all, law.law);
    ASSERT_TRUE(least.exists()) << law.law;
    const auto times = [&](double factor) {
      return [&, factor](const Motion& m) { return law.torque(m, factor * least.theta.norm(), least.shape); };
    };
    EXPECT_TRUE(is_added(law.law, times(2.0))) << law.law;
    EXPECT_FALSE(is_added(law.law, times(0.5))) << law.law;
  }
}

TEST(LeastNamed, GrowsWithWhatNoLawExplains) {
  const auto with = [](double noise) {
    const Extra friction = [](const Motion& m) { return kFriction * sign(m.w); };
    const SplitRecordings data{{test::recorded(friction, 0.3, noise)},
                               {test::recorded(friction, 1.7, noise)}};
    return of(least_named(data, error_budget(data), follows_another), "load_unbalance").theta.norm();
  };
  EXPECT_NEAR(with(0.8) / with(0.4), 2.0, 0.3);  // the encoder's part of the residual does not grow
}

TEST(LeastNamed, TellsWhatHidesALaw) {
  const std::vector<LeastNamed> all = foretold([](const Motion&) { return 0.0; });
  const LeastNamed& drift = of(all, "viscous_drift");
  EXPECT_FALSE(drift.exists());
  EXPECT_TRUE(drift.said_by_model);  // within a second the friction has its last value
  const auto any_free_form = [](const Law&, const Law&) { return true; };
  const SplitRecordings data = recordings([](const Motion&) { return 0.0; });
  const LeastNamed constant =
      of(least_named(data, error_budget(data), any_free_form), "constant_load_torque");
  EXPECT_FALSE(constant.exists());
  ASSERT_NE(constant.hidden_by, nullptr);
  EXPECT_STREQ(constant.hidden_by->name, "free_speed_curve");  // it is one, of two directions
}

}  // namespace
}  // namespace gapscope::internal::torque_view
