// Steps of their own length: a fine even sampling that holds the same inputs is the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/random.h"
#include "gapscope/plant/effect_hooks.h"
#include "gapscope/simulation/stepper.h"
#include "simulation/drives.h"

namespace gapscope {
namespace {

using test::paper_rig;

constexpr double kFine = 1.0 / 64000.0;  ///< [s]
constexpr int kMean = 32;                ///< fine steps in a mean step

struct Rows {
  std::vector<int> length;  ///< [fine steps]
  std::vector<double> u;
};

/// Steps off by up to 30 %, some of them ten times as long.
Rows uneven_rows(double duration) {
  auto draw = random_stream(7, "uneven steps");
  Rows rows;
  for (int at = 0; at * kFine < duration; at += rows.length.back()) {
    const int step = static_cast<int>(std::lround(kMean * (1.0 + 0.3 * uniform(draw, -1.0, 1.0))));
    rows.length.push_back(uniform(draw, 0.0, 1.0) < 0.02 ? 10 * step : step);
    const double t = at * kFine;
    double u = 0.0;
    for (const double f : {0.37, 0.91, 1.73, 3.1, 5.3, 7.7}) u += 0.3 * std::sin(2.0 * kPi * f * t + 5.0 * f);
    rows.u.push_back(u);
  }
  return rows;
}

std::vector<double> in_fine_steps(const PlantModel<double>& model, const Rows& rows) {
  DriveStepper<double> stepper(model, kFine);
  stepper.reset({});
  std::vector<double> x1;
  for (std::size_t i = 0; i < rows.u.size(); ++i) {
    x1.push_back(stepper.measured());
    for (int k = 0; k < rows.length[i]; ++k) stepper.step(rows.u[i]);
  }
  return x1;
}

template <class T>
std::vector<T> in_their_own_steps(const PlantModel<T>& model, const Rows& rows) {
  const int shortest = *std::min_element(rows.length.begin(), rows.length.end());
  DriveStepper<T> stepper(model, kMean * kFine, shortest * kFine);
  stepper.reset({});
  std::vector<T> x1;
  for (std::size_t i = 0; i < rows.u.size(); ++i) {
    x1.push_back(stepper.measured());
    stepper.step(T(rows.u[i]), rows.length[i] * kFine);
  }
  EXPECT_TRUE(stepper.healthy());
  return x1;
}

double largest_of_uneven(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(UnevenSteps, MoveEveryStructureAsFineEvenStepsDo) {
  const Rows rows = uneven_rows(3.0);
  DriveStructure free, locked, rigid, one_body;
  locked.load = LoadKind::kLocked;
  rigid.contact = ContactLaw::kRigid, rigid.restitution = 0.7;
  one_body.has_load = false;
  for (const DriveStructure& structure : {free, locked, rigid, one_body}) {
    const PlantModel<double> model = plant_model(paper_rig(), structure);
    // Both are exact; round-off grows at the impacts.
    EXPECT_LT(largest_of_uneven(in_their_own_steps(model, rows), in_fine_steps(model, rows)), 1e-8);
  }
}

class UnevenStepsWith : public ::testing::TestWithParam<std::string> {};

ScaleContext context() {
  ScaleContext c;
  c.nominal = paper_rig();
  c.peak_input = 0.9, c.peak_speed = 3.0, c.travel = 0.6;
  c.quantum = 6e-6, c.dt = kMean * kFine, c.duration = 3.0;
  return c;
}

PlantModel<double> with_effect(const EffectEntry& e) {
  PlantModel<double> model = plant_model(paper_rig(), {});
  model.structure.has_load = std::string(e.name) != "backlash";
  std::vector<double> values;
  for (const EffectParameterSpec& p : e.parameters) {
    // With strong harmonics of 200 detents the motor may rest in another one after a rounding.
    const double value = p.held ? 0.1 * p.high : p.low + 0.1 * (p.high - p.low);
    values.push_back(scale_value(p.scale, context()) * value);
  }
  add_effect<double>(model, e, values);
  return model;
}

TEST_P(UnevenStepsWith, MovesAsFineEvenStepsDo) {
  const Rows rows = uneven_rows(2.0);
  const PlantModel<double> model = with_effect(*find_effect(GetParam()));
  const double apart = largest_of_uneven(in_their_own_steps(model, rows), in_fine_steps(model, rows));
  std::cout << GetParam() << ": " << apart << " rad\n";
  EXPECT_LT(apart, 1e-5);  // as even steps of the same mean length
}

std::vector<std::string> catalogue() {
  std::vector<std::string> all;
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* e : table) all.emplace_back(e->name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, UnevenStepsWith, ::testing::ValuesIn(catalogue()),
                         [](const auto& effect) { return effect.param; });

TEST(UnevenSteps, ADelayIsATimeWhateverTheSteps) {
  // One body that nothing brakes under an impulse: its speed changes a delay after the row that gives it.
  PlantModel<Jet<4>> model;
  model.structure.has_load = false;
  model.drive.motor_inertia = Jet<4>(1.0), model.drive.torque_constant = Jet<4>(1.0);
  const double delay = 0.0123;
  Jet<4> parameter(delay);
  parameter.v[0] = 1.0;
  add_effect<Jet<4>>(model, *find_effect("input_delay"), std::vector<Jet<4>>{parameter});
  Rows rows;
  for (const int length : {40, 20, 35, 1000, 25, 300, 15, 40, 2000}) {
    rows.length.push_back(length);
    rows.u.push_back(rows.u.size() == 3 ? 1.0 : 0.0);
  }
  const std::vector<Jet<4>> x1 = in_their_own_steps(model, rows);
  const double begin = 95 * kFine, width = 1000 * kFine;
  const double at = std::accumulate(rows.length.begin(), rows.length.end() - 1, 0) * kFine;
  const double since = at - begin - delay;
  ASSERT_GT(since, 0.0);
  const double pushed = std::min(since, width), drifted = since - pushed;
  EXPECT_NEAR(x1.back().a, 0.5 * pushed * pushed + pushed * drifted, 1e-15);
  EXPECT_NEAR(x1.back().v[0], -pushed, 1e-12);  // later by so much, less far by the speed
}

TEST(UnevenSteps, InputsCloserThanADelayCanHoldAreNoTrouble) {
  const PlantModel<double> model = with_effect(*find_effect("input_delay"));
  DriveStepper<double> stepper(model, 1e-3, 1e-9);
  stepper.reset({});
  for (int i = 0; i < 100000; ++i) stepper.step(0.1, i % 2 == 0 ? 1e-9 : 1e-5);
  EXPECT_TRUE(stepper.healthy());
}

TEST(UnevenSteps, AGapOfAThousandStepsIsPlayedWhole) {
  const PlantModel<double> model = plant_model(paper_rig(), {});
  DriveStepper<double> once(model, 1e-3, 1e-3), often(model, 1e-3);
  once.reset({0.0, 3.0, 0.0, 0.0}), often.reset({0.0, 3.0, 0.0, 0.0});
  once.step(0.7, 1.0);
  for (int i = 0; i < 1000; ++i) often.step(0.7);
  EXPECT_TRUE(once.healthy());
  EXPECT_NEAR(once.state().x1, often.state().x1, 1e-9);
  EXPECT_EQ(once.events(), often.events());
}

}  // namespace
}  // namespace gapscope
