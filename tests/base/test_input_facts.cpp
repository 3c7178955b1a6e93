#include <gtest/gtest.h>

#include "base/input_facts.h"

namespace gapscope {
namespace {

TEST(InputFacts, ADeclaredUnitStandsInPlaceOfUnitsOfU) {
  const InputFacts volts{"V", false}, none;
  EXPECT_EQ(with_input_unit("0.2 units of u", volts), "0.2 V");
  EXPECT_EQ(with_input_unit("0.1 N·m per unit of u", volts), "0.1 N·m per V");
  EXPECT_EQ(with_input_unit("gain 2 unit of u/rad", volts), "gain 2 V/rad");
  EXPECT_EQ(with_input_unit("look at the unit of u first", volts), "look at the unit of u first");
  EXPECT_EQ(with_input_unit("7 unit of u", none), "7 units of u");
  EXPECT_EQ(with_input_unit("0.1 N·m per unit of u", none), "0.1 N·m per unit of u");
}

/// A torque per torque is a number: "1 N·m per N·m" tells nothing.
TEST(InputFacts, OfAnInputThatIsATorqueTheConstantIsToldAsANumber) {
  EXPECT_EQ(with_input_unit("1.00 N·m per unit of u", {"N m", false}), "1.00 (u is in N·m)");
  EXPECT_EQ(with_input_unit("1 N m per unit of u", {"N m", false}), "1 (u is in N m)");
  EXPECT_EQ(with_input_unit("1 N per unit of u", {"N", false}), "1 (u is in N)");
}

}  // namespace
}  // namespace gapscope
