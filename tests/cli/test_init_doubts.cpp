// What `init` does not take without a word.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cli/executable.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Workplace;

/// A sine of u, a position that follows it, and a motor that gets warm.
std::string with_temperature() {
  std::string csv = "t,u,x1,motor_temp,coil [°C]\n";
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-3 * i;
    csv += fmt::format("{:.3f},{:.6f},{:.8f},{:.2f},{:.2f}\n", t, 0.5 * std::sin(9.0 * t), -std::sin(9.0 * t),
                       25.0 + t, 30.0 + t);
  }
  return csv;
}

TEST(InitDoubts, ATemperatureIsNoInput) {
  Workplace place;
  place.file("r.csv", with_temperature());
  for (const std::string command : {"init", "check"})
    for (const std::string name : {"motor_temp", "'coil [°C]'"}) {
      const auto refused = place.run(command + " r.csv --input " + name);
      EXPECT_EQ(refused.status, 2);
      EXPECT_THAT(refused.err, AllOf(HasSubstr("--input is '"), HasSubstr("a temperature by its name"),
                                     HasSubstr("expected the column of a torque")));
    }
  EXPECT_FALSE(place.content().count("r.yaml"));
}

TEST(InitDoubts, ANumberInAnotherUnitIsAskedFor) {
  Workplace place;
  place.file("r.csv", with_temperature());
  const auto warned = [&](const std::string& options) {
    const auto init = place.run("init r.csv --model one_body " + options + " -o d.yaml");
    EXPECT_EQ(init.status, 0) << init.err;
    std::filesystem::remove(place.folder() / "d.yaml");
    return init.err;
  };
  EXPECT_THAT(warned("--mass 0.5 --arm 105"), HasSubstr("warning: --arm: 105 m? 105 mm is 0.105\n"));
  EXPECT_THAT(warned("--mass 1500 --arm 0.1"), HasSubstr("warning: --mass: 1500 kg? 1500 g is 1.5\n"));
  EXPECT_THAT(warned("--inertia 250"), HasSubstr("warning: --inertia: 250 kg m^2? 250 kg cm^2 is 0.025\n"));
  EXPECT_THAT(warned("--mass 0.5 --arm 0.105"), Not(HasSubstr("?")));
  EXPECT_THAT(warned("--inertia 1e-3"), Not(HasSubstr("?")));
}

/// The window of a configuration is of each of its files, and who cuts one is told of the other.
TEST(InitDoubts, AWindowCutsWhatIsHeldOutAsWellAndThatIsSaid) {
  Workplace place;
  place.file("r.csv", with_temperature());
  place.file("h.csv", with_temperature());
  const std::string init = "init r.csv --model one_body --window 0 1.5 ";
  const auto both = place.run(init + "--held-out h.csv -o both.yaml");
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out,
              HasSubstr("window      0 to 1.5 s of both files, also of h.csv, which is held out\n"));
  EXPECT_THAT(testing::text_of(place.folder() / "both.yaml"),
              HasSubstr("window: [0, 1.5]  # s, of each file, held_out as well\n"));
  EXPECT_THAT(place.run(init + "-o one.yaml").out, Not(HasSubstr("window")));
}

}  // namespace
}  // namespace gapscope
