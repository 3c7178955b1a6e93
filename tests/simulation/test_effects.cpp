// The conformance suite: every row of the catalogue is held to the same laws; a new effect is tested by being
// there.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "gapscope/plant/effect_hooks.h"
#include "gapscope/simulation/stepper.h"
#include "simulation/drives.h"

namespace gapscope {
namespace {

using test::held;
using test::paper_rig;
using test::several_sines;

constexpr double kRate = 2000.0;

ScaleContext context(const std::vector<double>& u, double duration) {
  ScaleContext c;
  c.nominal = paper_rig();
  c.peak_input = std::abs(
      *std::max_element(u.begin(), u.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  c.peak_speed = 3.0;
  c.travel = 0.6;
  c.quantum = 6e-6;
  c.dt = 1.0 / kRate;
  c.duration = duration;
  return c;
}

struct Case {
  std::vector<double> u = several_sines(0.9, kRate, 4.0);
  ScaleContext scale = context(u, 4.0);
};

/// Values a moderate way into the bounds: where its search in the diagnosis begins. What that finds from the
/// residual torque is some cycles over the travel here.
std::vector<double> moderate(const EffectEntry& e, const ScaleContext& scale) {
  constexpr double kCycles = 2.3, kPhase = 0.4, kSmall = 0.05, kReached = 0.3;
  std::vector<double> values;
  for (std::size_t i = 0; i < e.parameters.size(); ++i) {
    const EffectParameterSpec& p = e.parameters[i];
    const bool begins = !e.starts.empty() && !(p.held && e.starts.front()[i] == p.absent);
    double v = begins ? e.starts.front()[i] : p.low + 0.1 * (p.high - p.low);
    if (e.starts.empty() && p.low < 0.0 && p.scale != Scale::kOne) v = kSmall / static_cast<double>(1 + i);
    if (p.low == p.high) v = kReached;
    if (p.scale == Scale::kPerTravel) v = kCycles;
    if (p.key == std::string("phase_rad")) v = kPhase;
    values.push_back(v * scale_value(p.scale, scale));
  }
  return values;
}

/// The paper's rig; a drive of one inertia for the effect that divides it in two.
PlantModel<double> nominal(const EffectEntry& e) {
  DriveStructure structure;
  structure.has_load = std::string(e.name) != "backlash";
  return plant_model(paper_rig(), structure);
}

PlantModel<double> with(const EffectEntry& e, const std::vector<double>& values) {
  PlantModel<double> model = nominal(e);
  add_effect<double>(model, e, values);
  return model;
}

std::vector<double> measured(const PlantModel<double>& model, const std::vector<double>& u, double rate,
                             int every = 1, bool* healthy = nullptr) {
  DriveStepper<double> stepper(model, 1.0 / rate);
  stepper.reset({});
  std::vector<double> x1;
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (i % static_cast<std::size_t>(every) == 0) x1.push_back(stepper.measured());
    stepper.step(u[i]);
  }
  if (healthy != nullptr) *healthy = stepper.healthy();
  return x1;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

class EveryEffect : public ::testing::TestWithParam<std::string> {
 protected:
  const EffectEntry& entry() const { return *find_effect(GetParam()); }
};

/// Of the whole catalogue and the laws of last resort.
std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* e : table) all.emplace_back(e->name);
  return all;
}

TEST_P(EveryEffect, LeavesTheMotionAsItIsAtItsAbsentValues) {
  const Case c;
  std::vector<double> absent;
  for (const EffectParameterSpec& p : entry().parameters)
    absent.push_back(p.absent * scale_value(p.scale, c.scale));
  const auto plain = measured(nominal(entry()), c.u, kRate);
  const auto same = measured(with(entry(), absent), c.u, kRate);
  EXPECT_LT(largest_difference(plain, same), 1e-10);  // round-off, amplified by the impacts
}

TEST_P(EveryEffect, ChangesWhatIsMeasuredAtModerateValues) {
  const Case c;
  const EffectEntry& e = entry();
  if (hooks_of<double>(e).quantum != nullptr) {
    EXPECT_GT(hooks_of<double>(e).quantum(moderate(e, c.scale).data()), c.scale.quantum);
    return;
  }
  const auto plain = measured(nominal(e), c.u, kRate);
  const auto changed = measured(with(e, moderate(e, c.scale)), c.u, kRate);
  EXPECT_GT(largest_difference(plain, changed), 1e-5);
}

TEST_P(EveryEffect, ConvergesAtSecondOrderOrIsExactInTheSamplingInterval) {
  const Case c;
  const auto model = with(entry(), moderate(entry(), c.scale));
  const auto truth = measured(model, held(c.u, 32), 32 * kRate, 32);
  const double coarse = largest_difference(measured(model, c.u, kRate), truth);
  const double fine = largest_difference(measured(model, held(c.u, 4), 4 * kRate, 4), truth);
  std::cout << entry().name << ": " << coarse << " rad at 2 kHz, " << fine << " rad at 8 kHz\n";
  EXPECT_LT(coarse, 1e-5);
  // Where the effect's own rate divides the steps, finer samples need not change them.
  constexpr double kFiftiethOfACount20Bit = 0.02 * 2.0 * kPi / (1 << 20);
  const bool divides = hooks_of<double>(entry()).rate != nullptr && coarse < kFiftiethOfACount20Bit;
  if (fine > 1e-9 && !divides) {
    EXPECT_GE(std::log2(coarse / fine) / 2.0, 1.8);
  }
}

/// x1 with its derivatives by four parameters from `first` on.
std::vector<Jet<4>> differentiated(const EffectEntry& e, const std::vector<double>& values, std::size_t first,
                                   const std::vector<double>& u) {
  PlantModel<Jet<4>> model;
  model.structure = nominal(e).structure;
  for (int i = 0; i < kDriveParameterCount; ++i)
    drive_parameter(model.drive, i) = Jet<4>(drive_parameter(paper_rig(), i));
  std::vector<Jet<4>> parameters(values.begin(), values.end());
  for (std::size_t i = first; i < std::min(first + 4, values.size()); ++i)
    parameters[i] = Jet<4>(values[i], static_cast<int>(i - first));
  add_effect<Jet<4>>(model, e, parameters);
  DriveStepper<Jet<4>> stepper(model, 1.0 / kRate);
  std::vector<Jet<4>> x1;
  for (const double input : u) {
    x1.push_back(stepper.measured());
    stepper.step(Jet<4>(input));
  }
  return x1;
}

TEST_P(EveryEffect, HasDerivativesThatAgreeWithDifferences) {
  const Case c;
  const EffectEntry& e = entry();
  const std::vector<double> values = moderate(e, c.scale);
  if (hooks_of<double>(e).quantum != nullptr) return;  // a quantum is not continuous
  std::vector<Jet<4>> x1;
  for (std::size_t p = 0; p < values.size(); ++p) {
    if (p % 4 == 0) x1 = differentiated(e, values, p, c.u);
    double best = kInfinity;
    for (const double relative : {1e-4, 1e-5, 1e-6, 1e-7}) {
      auto up = values, down = values;
      const double h = relative * std::abs(values[p]);
      up[p] += h, down[p] -= h;
      const auto a = measured(with(e, up), c.u, kRate), b = measured(with(e, down), c.u, kRate);
      double error = 0.0, size = 0.0;
      for (std::size_t i = 0; i < x1.size(); ++i) {
        const double d = (a[i] - b[i]) / (2.0 * h);
        error += (d - x1[i].v[static_cast<int>(p % 4)]) * (d - x1[i].v[static_cast<int>(p % 4)]);
        size += d * d;
      }
      best = std::min(best, std::sqrt(error / size));
    }
    EXPECT_LT(best, 1e-6) << e.parameters[p].key;
  }
}

TEST_P(EveryEffect, StaysFiniteOnRandomParametersWithinItsBounds) {
  const Case c;
  const EffectEntry& e = entry();
  auto generator = random_stream(1, e.name);
  for (int i = 0; i < 20; ++i) {
    std::vector<double> values;
    for (const EffectParameterSpec& p : e.parameters)
      values.push_back(scale_value(p.scale, c.scale) * uniform(generator, p.low, p.high));
    bool healthy = false;
    const auto x1 =
        measured(with(e, values), std::vector<double>(c.u.begin(), c.u.begin() + 2000), kRate, 1, &healthy);
    EXPECT_TRUE(healthy);
    for (const double x : x1) ASSERT_TRUE(std::isfinite(x));
  }
}

TEST_P(EveryEffect, StaysHealthyAtRestUntilTheInputBegins) {
  Case c;
  std::fill_n(c.u.begin(), 200, 0.0);
  c.u.resize(1000);
  bool healthy = false;
  measured(with(entry(), moderate(entry(), c.scale)), c.u, kRate, 1, &healthy);
  EXPECT_TRUE(healthy);
}

std::string name_of(const ::testing::TestParamInfo<std::string>& info) { return info.param; }
INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, ::testing::ValuesIn(names()), name_of);

TEST(ActuatorLag, FarShorterThanASampleIsFollowedAlsoBesideATorqueThatIsNotConstant) {
  const Case c;
  for (const char* beside : {"encoder_eccentricity", "cogging_torque", "quadratic_drag"}) {
    PlantModel<double> model = with(*find_effect(beside), moderate(*find_effect(beside), c.scale));
    const auto without = measured(model, held(c.u, 32), 32 * kRate, 32);
    add_effect<double>(model, *find_effect("actuator_lag"), std::vector<double>{0.05 / kRate});
    const auto truth = measured(model, held(c.u, 32), 32 * kRate, 32);
    EXPECT_GT(largest_difference(without, truth), 1e-5) << beside;  // the lag can be seen
    EXPECT_LT(largest_difference(measured(model, c.u, kRate), truth), 1e-6) << beside;
  }
}

TEST(EffectTable, IsSortedAndHoldsTheWholeCatalogue) {
  const auto table = effect_table();
  EXPECT_GE(table.size(), 24u);
  for (std::size_t i = 1; i < table.size(); ++i) EXPECT_LT(std::string(table[i - 1]->name), table[i]->name);
  for (const EffectEntry* e : table) {
    EXPECT_EQ(find_effect(e->name), e);
    EXPECT_LE(e->parameters.size(), static_cast<std::size_t>(kMostEffectParameters));
    for (const char* other : e->look_alikes) EXPECT_NE(find_effect(other), nullptr) << other;
  }
  for (const EffectEntry* e : last_resort_table()) EXPECT_EQ(find_effect(e->name), e);
  EXPECT_EQ(find_effect("none_such"), nullptr);
}

}  // namespace
}  // namespace gapscope
