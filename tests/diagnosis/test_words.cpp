#include <gtest/gtest.h>

#include "diagnosis/effect_starts.h"
#include "diagnosis/tell_budget.h"

namespace gapscope {
namespace {

/// A ladder of two lines of one law, of which the first was in the model before.
TEST(TellBudget, OfTwoLinesOfOneLawEachTellsItsOwnNumbers) {
  namespace view = internal::torque_view;
  const EffectEntry& cogging = *find_effect("cogging_torque");
  const view::Law& law = view::law("cogging_torque");
  view::Budget budget;
  budget.nominal_rms = 10.0;
  internal::diagnosis::TorqueSearch ladder;
  const auto put = [&](double amplitude, double periods) {
    ModelEffect e = internal::diagnosis::searched_effect(cogging, {});
    e.parameters[0].value = amplitude, e.parameters[1].value = periods;
    ladder.after.fitted.model.effects.push_back(e);
  };
  put(9.0, 3.0);  // not of the ladder
  for (const double periods : {24.0, 7.0}) {
    view::Rung rung;
    rung.helps = true, rung.rms = 0.2 * periods;
    rung.ranking = {{&law, {{&law, periods, Eigen::VectorXd::Zero(2)}}, {}, {}}};
    ladder.added.push_back({budget.rungs.size(), true, {&cogging}});
    budget.rungs.push_back(rung);
    put(0.1 * periods, periods);
  }
  const auto added = internal::diagnosis::added_effects(budget, ladder);
  ASSERT_EQ(added.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    const double periods = i == 0 ? 24.0 : 7.0;
    ASSERT_GE(added[i].parameters.size(), 2u);
    EXPECT_EQ(added[i].parameters[0].value, 0.1 * periods);
    EXPECT_EQ(added[i].parameters[1].value, periods);
    EXPECT_EQ(added[i].after_torque, 0.2 * periods);
  }
  const view::Share share{&law, 24.0, {}, {}, {}, {}};
  EXPECT_TRUE(internal::diagnosis::is_of(share, budget.rungs[0].choice().model.back()));
  EXPECT_FALSE(internal::diagnosis::is_of(share, budget.rungs[1].choice().model.back()));
}

/// Of a budget whose second line nobody has added, the first one is told; without one, what the model has.
TEST(TellBudget, TheTorqueThatIsToldIsOfWhatWasAdded) {
  namespace view = internal::torque_view;
  const auto term = [](const char* name) {
    return view::Term{&view::law(name), kNaN, Eigen::VectorXd::Zero(1)};
  };
  view::Budget budget;
  budget.nominal_rms = 10.0, budget.addable_rms = 3.0;
  for (const auto& [name, rms] : {std::pair{"motor_coulomb_friction", 6.0}, {"load_unbalance", 3.0}}) {
    view::Rung rung;
    rung.helps = true, rung.rms = rms;
    rung.ranking = {{&view::law(name), {term(name)}, {}, {}}};
    budget.rungs.push_back(rung);
    budget.addable.push_back(term(name));
  }
  Diagnosis d;
  d.effects = {"motor_coulomb_friction", "torque_saturation"};
  internal::diagnosis::count_added(budget, d);
  EXPECT_EQ(d.budget.with_effects, 6.0);
  EXPECT_EQ(d.budget.uncounted, std::vector<std::string>{"torque_saturation"});
  d.budget = {}, d.effects = {"load_unbalance", "motor_coulomb_friction"};
  internal::diagnosis::count_added(budget, d);
  EXPECT_EQ(d.budget.with_effects, 3.0);
  EXPECT_TRUE(d.budget.uncounted.empty());
}

/// A fast detent that the balance has at another period is none of its lines; a harmonic of it is one.
TEST(TellBudget, ALineOfAnotherPeriodIsNotWhatWasAdded) {
  namespace view = internal::torque_view;
  const auto uncounted = [](double periods_per_turn) {
    const view::Term line{&view::law("cogging_torque"), periods_per_turn, Eigen::VectorXd::Zero(2)};
    view::Budget budget;
    budget.nominal_rms = 10.0, budget.addable_rms = 8.0;
    view::Rung rung;
    rung.helps = true, rung.rms = 8.0;
    rung.ranking = {{line.law, {line}, {}, {}}};
    budget.rungs.push_back(rung), budget.addable.push_back(line);
    Diagnosis d;
    d.effects = {"cogging_torque"};
    ModelEffect cogging{find_effect("cogging_torque"), {}};
    cogging.parameters[1].value = 12.0;
    d.fitted.effects.push_back(cogging);
    internal::diagnosis::count_added(budget, d);
    return d.budget.uncounted;
  };
  for (const double same : {12.0, 11.9, 12.3, 24.0, 6.0}) EXPECT_TRUE(uncounted(same).empty()) << same;
  for (const double other : {1.62, 3.24, 9.0, 17.0})
    EXPECT_EQ(uncounted(other), std::vector<std::string>{"cogging_torque"}) << other;
}

}  // namespace
}  // namespace gapscope
