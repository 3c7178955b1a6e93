// `anchor:` – what is known of a drive and fixes the scale of its torques.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/configuration.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::refusal;

Configuration anchored(const std::string& anchor, const std::string& parameters = "mass_ratio: 0",
                       const std::string& more = "") {
  return parse_configuration("recording: {file: servo.csv}\nmodel: {parameters: {" + parameters + "}" + more +
                                 "}\nanchor: " + anchor + "\n",
                             "c.yaml");
}

TEST(Anchor, PutsTheGravityOfAKnownMassIntoTheModel) {
  const Configuration c = anchored("{mass: 0.49, arm: 0.1}");
  const ReferenceModel model = c.reference_model();
  ASSERT_EQ(model.effects.size(), 1u);
  EXPECT_STREQ(model.effects[0].entry->name, "load_unbalance");
  EXPECT_NEAR(model.effects[0].parameters[0].value, 0.49 * 9.80665 * 0.1, 1e-12);
  EXPECT_FALSE(model.effects[0].parameters[0].estimate);
  EXPECT_TRUE(model.effects[0].parameters[1].estimate);
  EXPECT_TRUE(model.parameters[place::kTorqueConstant].estimate);
  EXPECT_TRUE(model.parameters[place::kMotorInertia].estimate);
  EXPECT_NEAR(model.parameters[place::kMotorInertia].low, 4.9e-3, 1e-12);  // of the mass alone
  EXPECT_TRUE(model.parameters[place::kMotorInertia].begun) << "no number that the user has stated";
  EXPECT_NO_THROW(require_reference_model(c));
  EXPECT_TRUE(c.model.effects.empty());
}

TEST(Anchor, LeavesWhatIsWritten) {
  const ReferenceModel model = anchored("{mass: 0.49, arm: 0.1, hangs_at: 0.03}",
                                        "mass_ratio: 0, torque_constant: 0.1, motor_inertia: 0.007")
                                   .reference_model();
  EXPECT_EQ(model.parameters[place::kTorqueConstant].value, 0.1);
  EXPECT_FALSE(model.parameters[place::kTorqueConstant].estimate);
  EXPECT_FALSE(model.parameters[place::kMotorInertia].estimate);
  EXPECT_EQ(model.effects[0].parameters[1].value, -0.03);
  EXPECT_FALSE(model.effects[0].parameters[1].estimate);
}

TEST(Anchor, MayBeAnInertiaOrAFriction) {
  const ReferenceModel inertia = anchored("{inertia: 8.8e-4}").reference_model();
  EXPECT_EQ(inertia.parameters[place::kMotorInertia].value, 8.8e-4);
  EXPECT_TRUE(inertia.parameters[place::kTorqueConstant].estimate);
  const ReferenceModel friction =
      anchored("{friction: 0.013}", "mass_ratio: 0, motor_inertia: {estimate: true}").reference_model();
  ASSERT_EQ(friction.effects.size(), 1u);
  EXPECT_STREQ(friction.effects[0].entry->name, "motor_coulomb_friction");
  EXPECT_EQ(friction.effects[0].parameters[0].value, 0.013);
}

TEST(Anchor, ComesBackFromTheResolvedText) {
  for (const char* anchor :
       {"{mass: 0.49, arm: 0.1}", "{inertia: 8.8e-4, friction: 0.01}",
        "{mass: 1, arm: 2, gravity: 1.62, hangs_at: {value: 1, estimate: true, bounds: [0, 2]}}"}) {
    const std::string text = resolved_yaml(anchored(anchor));
    EXPECT_EQ(resolved_yaml(parse_configuration(text, "c.yaml")), text);
  }
}

TEST(Anchor, IsRefusedWhereItCannotHold) {
  EXPECT_THAT(refusal([] { anchored("{mass: 0.49}"); }), HasSubstr("arm"));
  EXPECT_THAT(refusal([] { anchored("{arm: 0.1, inertia: 1}"); }),
              HasSubstr("c.yaml:3: anchor.arm is given without a mass"));
  EXPECT_THAT(refusal([] { anchored("{}"); }), HasSubstr("anchor"));
  EXPECT_THAT(refusal([] { anchored("{inertia: 1}", "motor_inertia: 1"); }),
              HasSubstr("stands beside model.parameters.motor_inertia"));
  EXPECT_THAT(refusal([] {
                anchored("{mass: 1, arm: 1}", "mass_ratio: 0",
                         ", effects: [{load_unbalance: {amplitude_nm: 1}}]");
              }),
              HasSubstr("stands beside the effect load_unbalance of the model"));
  EXPECT_THAT(refusal([] { anchored("{mass: 1, arm: 1}", "gap: 0.1", ", load: locked"); }),
              HasSubstr("on a load that is locked"));
  EXPECT_THAT(refusal([] { anchored("{mass: 1, arm: 1}\ncoordinates: translation"); }),
              HasSubstr("on an arm with coordinates: translation"));
}

}  // namespace
}  // namespace gapscope
