// Nothing is allocated per sample: every call of operator new is counted.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "gapscope/plant/effect_hooks.h"
#include "gapscope/simulation/stepper.h"
#include "simulation/drives.h"

namespace {
long allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace gapscope {
namespace {

constexpr double kRate = 2000.0;

template <class T>
class Allocation : public testing::Test {};
using Scalars = testing::Types<double, Jet<8>>;
TYPED_TEST_SUITE(Allocation, Scalars);

template <class T>
PlantModel<T> rig(bool has_load) {
  PlantModel<T> model;
  model.structure.has_load = has_load;
  const DriveParameters<double> numbers = test::paper_rig();
  for (int i = 0; i < kDriveParameterCount; ++i) {
    T& p = drive_parameter(model.drive, i);
    p = T(drive_parameter(numbers, i));
    if constexpr (kIsJet<T>)
      if (i < T::DIMENSION) p.v[i] = 1.0;
  }
  return model;
}

ScaleContext scale() {
  ScaleContext c;
  c.nominal = test::paper_rig();
  c.peak_speed = 3.0;
  c.travel = 0.6;
  c.quantum = 6e-6;
  c.dt = 1.0 / kRate;
  c.duration = 2.0;
  return c;
}

/// Everything that an observer or a fit calls once per sample.
template <class T>
long allocations_of_a_run(const PlantModel<T>& model, long& events) {
  const std::vector<double> u = test::several_sines(0.9, kRate, 2.0);
  DriveStepper<T> stepper(model, 1.0 / kRate);
  double sum = 0.0;
  const long before = allocations;
  stepper.reset({});
  for (const double v : u) {
    stepper.step(T(v));
    sum += value_of(stepper.measured());
    stepper.inject(T(1e-9), T(1e-9));
  }
  const long made = allocations - before;
  EXPECT_TRUE(std::isfinite(sum));
  events = stepper.events();
  return made;
}

/// The same in steps of their own length.
template <class T>
long allocations_of_uneven_steps(const PlantModel<T>& model) {
  const std::vector<double> u = test::several_sines(0.9, kRate, 1.0);
  DriveStepper<T> stepper(model, 1.0 / kRate, 0.5 / kRate);
  const long before = allocations;
  stepper.reset({});
  for (std::size_t i = 0; i < u.size(); ++i)
    stepper.step(T(u[i]), (0.5 + 0.25 * static_cast<double>(i % 5)) / kRate);
  return allocations - before;
}

TEST(AllocationCounter, SeesAVectorGrow) {
  const long before = allocations;
  std::vector<Jet<8>> v(3);
  EXPECT_EQ(allocations, before + 1);
}

TYPED_TEST(Allocation, NoneInARunWithEvents) {
  long events = 0;
  EXPECT_EQ(allocations_of_a_run(rig<TypeParam>(true), events), 0);
  EXPECT_GT(events, 100);
}

TYPED_TEST(Allocation, NoneWithAnyEffectOfTheCatalogue) {
  for (const EffectEntry* e : effect_table()) {
    PlantModel<TypeParam> model = rig<TypeParam>(std::string(e->name) != "backlash");
    std::vector<TypeParam> values;
    for (const EffectParameterSpec& p : e->parameters)
      values.emplace_back(scale_value(p.scale, scale()) * (p.low + 0.1 * (p.high - p.low)));
    add_effect<TypeParam>(model, *e, values);
    long events = 0;
    EXPECT_EQ(allocations_of_a_run(model, events), 0) << e->name;
    EXPECT_GT(events, 5) << e->name;
    EXPECT_EQ(allocations_of_uneven_steps(model), 0) << e->name;
  }
}

}  // namespace
}  // namespace gapscope
