#include <gtest/gtest.h>

#include "gapscope/recording/column_name.h"

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

}  // namespace
}  // namespace gapscope
