#include <gtest/gtest.h>

#include "recording/column_name.h"

namespace gapscope {
namespace {

TEST(ColumnName, IsATemperatureByItsWordsOrItsUnit) {
  for (const char* name :
       {"temp", "Temp", "motor_temp", "motorTemp", "TEMP2", "drive/temperature_C", "Temperatur", "coil [°C]",
        "T (℃)", "T_degC", "present_temperature", "winding.celsius"})
    EXPECT_TRUE(says_temperature(name)) << name;
  for (const char* name : {"u", "T_motor", "torque", "template", "tempo", "attempt", "contemporary",
                           "i_q [A]", "deg", "degCount", "effort", "", "τ [N·m]"})
    EXPECT_FALSE(says_temperature(name)) << name;
}

TEST(ColumnName, EndsWithAUnit) {
  const auto unit = [](const char* name, Quantity of) { return unit_in_name(name, of); };
  EXPECT_EQ(unit("time_ms", Quantity::kTime), "ms");
  EXPECT_EQ(unit("t [us]", Quantity::kTime), "us");
  EXPECT_EQ(unit("t(s)", Quantity::kTime), "s");
  EXPECT_EQ(unit("motor_angle_deg", Quantity::kAngle), "deg");
  EXPECT_EQ(unit("pos mm", Quantity::kLength), "mm");
  EXPECT_EQ(unit("τ [N·m]", Quantity::kTorque), "N·m");
  EXPECT_EQ(unit("torque_mNm", Quantity::kTorque), "mNm");
  EXPECT_EQ(unit("motorCurrent_A", Quantity::kTorque), "A");
  EXPECT_EQ(unit("i_q (A)", Quantity::kTorque), "A");
}

TEST(ColumnName, EndsWithAUnitOnlyWhereItCanBeOne) {
  const auto unit = [](const char* name, Quantity of) { return unit_in_name(name, of); };
  EXPECT_EQ(unit("torque_A", Quantity::kTorque), "");  // of an axis A
  EXPECT_EQ(unit("speed [deg/s]", Quantity::kAngle), "");
  EXPECT_EQ(unit("pos_mm", Quantity::kAngle), "");  // no length turns
  EXPECT_EQ(unit("x_1", Quantity::kAngle), "");     // nor is a number one
  for (const char* name : {"t", "ms", "", "_", "[]", "time_", "deg"}) {
    EXPECT_EQ(unit(name, Quantity::kTime), "") << name;
    EXPECT_EQ(unit(name, Quantity::kAngle), "") << name;
  }
}

}  // namespace
}  // namespace gapscope
