// What `init` writes is taken by the other commands as it is.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/executable.h"
#include "cli/one_body_csv.h"
#include "inspection/rows.h"
#include "support/data.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::Workplace;

/// Runs init, run and diagnose in turn. @returns the configuration
std::string tried(Workplace& place, const std::string& arguments) {
  const auto init = place.run("init " + arguments + " -o drive.yaml");
  EXPECT_EQ(init.status, 0) << init.err;
  const bool held_out = arguments.find("--held-out") != arguments.npos;
  EXPECT_THAT(init.out, HasSubstr(held_out ? "gapscope diagnose drive.yaml" : "gapscope run drive.yaml"));
  const std::string few = testing::excluding_all_but({"motor_coulomb_friction", "quadratic_drag"});
  for (const std::string& command : {std::string("run drive.yaml"), "diagnose drive.yaml" + few}) {
    const auto outcome = place.run(command + " -o report");
    EXPECT_EQ(outcome.status, 0) << command << ": " << outcome.err;
  }
  for (const char* file : {"report/result.json", "report/diagnosis.json", "report/report.md"})
    EXPECT_TRUE(place.content().count(file)) << file;
  return testing::text_of(place.folder() / "drive.yaml");
}

TEST(Init, OneBodyIsTakenForOneAndItsNumbersAreRead) {
  Workplace place;
  const auto input = [](double t) { return 0.3 * std::sin(9.0 * t) + 0.2 * std::sin(31.0 * t); };
  place.file("logs/my drive 7.csv", one_body_csv(input));
  const std::string yaml = tried(place, "'logs/my drive 7.csv' --model one_body");
  EXPECT_THAT(yaml, HasSubstr("file: \"logs/my drive 7.csv\""));
  EXPECT_THAT(yaml, HasSubstr("encoder: {bits: 18}"));
  EXPECT_THAT(yaml, HasSubstr("mass_ratio: 0"));
  EXPECT_THAT(yaml, HasSubstr("torque_constant: {value: 1, guess: true}  # GUESS"));
  EXPECT_THAT(yaml, HasSubstr("# anchor: {inertia: 8.8e-4}"));
  EXPECT_THAT(yaml, HasSubstr("motor_inertia: {value: 0.005"));  // 8.78e-4/0.172 = 5.1e-3 units of u s^2/rad
  EXPECT_THAT(yaml, Not(HasSubstr("SPOILS")));
}

TEST(Init, TheReportIsCalledAsTheConfigurationIs) {
  Workplace place;
  place.file("my 7.csv", one_body_csv([](double t) { return 0.3 * std::sin(9.0 * t); }));
  for (const std::string o : {"", " -o 'left arm.yaml'"}) place.run("init 'my 7.csv' --model one_body" + o);
  EXPECT_THAT(testing::text_of(place.folder() / "my 7.yaml"), HasSubstr("name: my_7  #"));
  EXPECT_THAT(testing::text_of(place.folder() / "left arm.yaml"), HasSubstr("name: left_arm  #"));
}

/// A torque per torque is one, and known; where nothing is guessed nobody is sent to look for a guess.
TEST(Init, AnInputInTorqueLeavesNothingToGuess) {
  Workplace place;
  const auto input = [](double t) { return 0.3 * std::sin(9.0 * t) + 0.2 * std::sin(31.0 * t); };
  place.file("r.csv", one_body_csv(input));
  const auto init = place.run("init r.csv --model one_body --input-unit 'N m' -o torque.yaml");
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.out, Not(HasSubstr("GUESS")));
  const std::string yaml = testing::text_of(place.folder() / "torque.yaml");
  EXPECT_THAT(yaml, HasSubstr("torque_constant: 1  # u is in N m already"));
  EXPECT_THAT(yaml, Not(HasSubstr("GUESS")));
  EXPECT_EQ(place.run("check r.csv --input-unit N*m").status, 0);
  EXPECT_EQ(place.run("init r.csv --model one_body --input-unit Nm -o short.yaml").status, 0);
  EXPECT_THAT(testing::text_of(place.folder() / "short.yaml"),
              HasSubstr("torque_constant: 1  # u is in N m"));
  const auto geared =
      place.run("init r.csv --model one_body --input-unit 'N m' --gear-ratio 2 -o geared.yaml");
  EXPECT_THAT(geared.out, HasSubstr("fill in what is marked GUESS")) << "at which shaft is that torque?";
}

/// What is known of the drive sets the scale: no number in units of the input stays for the fit to begin
/// with.
TEST(Init, AnAnchorLeavesTheTorqueConstantToTheFitAndWhatWasReadInItsUnits) {
  Workplace place;
  const auto input = [](double t) { return 0.3 * std::sin(9.0 * t) + 0.2 * std::sin(31.0 * t); };
  place.file("r.csv", one_body_csv(input));
  EXPECT_EQ(place.run("init r.csv --model one_body --inertia 8.78e-4 -o known.yaml").status, 0);
  const std::string yaml = testing::text_of(place.folder() / "known.yaml");
  EXPECT_THAT(yaml, HasSubstr("anchor: {inertia: 0.000878}"));
  EXPECT_THAT(yaml, HasSubstr("motor_damping: {estimate: true}"));
  EXPECT_THAT(yaml, Not(HasSubstr("GUESS")));
  const auto fit = place.run("fit known.yaml -o report");
  EXPECT_EQ(fit.status, 0) << fit.err;
  EXPECT_THAT(fit.out, ::testing::ContainsRegex("torque_constant +0[.]17[0-9]+ N·m"));
  EXPECT_THAT(place.run("init r.csv --model one_body --mass 0.5 --arm 0.1 -o mass.yaml").out,
              HasSubstr("a mass of 0.5 kg on an arm of 0.1 m (gravity up to 0.4903 N·m"));
  EXPECT_THAT(testing::text_of(place.folder() / "mass.yaml"), HasSubstr("anchor: {mass: 0.5, arm: 0.1}"));
  EXPECT_EQ(place.run("init r.csv --mass 0.5 -o m.yaml").status, 2);
  EXPECT_THAT(place.run("init r.csv --model locked --mass 0.5 --arm 0.1 -o m.yaml").err,
              HasSubstr("on a load that is locked"));
}

TEST(Init, AServoThatTakesGoalsMayHaveAGainThatNobodyKnows) {
  Workplace place;
  std::string text = "t,goal,x1,volts\n";
  for (int i = 0; i < 400; ++i)
    text += fmt::format("{},{},{},7\n", 0.005 * i, std::sin(0.02 * i), 0.9 * std::sin(0.02 * i - 0.1));
  place.file("servo.csv", text);
  const std::string init = "init servo.csv --model one_body --target goal";
  EXPECT_THAT(place.run(init).err, HasSubstr("or --controller-gain estimate where nobody knows it"));
  EXPECT_EQ(place.run("init servo.csv --controller-gain 2 -o found.yaml").status, 0);
  EXPECT_THAT(testing::text_of(place.folder() / "found.yaml"), HasSubstr("target: \"goal\"")) << "no supply";
  EXPECT_EQ(place.run(init + " --controller-gain much").status, 2);
  const auto known = place.run(init + " --controller-gain estimate --mass 0.5 --arm 0.1 -o servo.yaml");
  EXPECT_EQ(known.status, 0) << known.err;
  const std::string yaml = testing::text_of(place.folder() / "servo.yaml");
  EXPECT_THAT(yaml, HasSubstr("target: \"goal\""));
  EXPECT_THAT(yaml, HasSubstr("gain: {estimate: true}"));
  EXPECT_THAT(yaml, HasSubstr("torque_constant: 1  # not known apart from the controller's gain"));
  EXPECT_THAT(yaml, HasSubstr("rate: auto")) << yaml;
  EXPECT_EQ(place.run(init + " --controller-gain 2 --voltage volts -o duty.yaml").status, 0);
  EXPECT_THAT(testing::text_of(place.folder() / "duty.yaml"), HasSubstr("gain: 2  # duty per rad"));
  const std::string set = init + " --controller-gain 2 --set controller.position.saturation=0.8 --set ";
  EXPECT_EQ(place.run(set + "controller.position.delay=0.004 -o set.yaml").status, 0);
  EXPECT_THAT(testing::text_of(place.folder() / "set.yaml"),
              ::testing::AllOf(HasSubstr("saturation: 0.8"), HasSubstr("delay: 0.004")));
  EXPECT_THAT(place.run(set + "model.parameters.gap=1 -o m.yaml").err, HasSubstr("is of no controller"));
  EXPECT_THAT(place.run(set + "controller.dealy=0.004 -o m.yaml").err, HasSubstr("--set controller.dealy"));
  EXPECT_THAT(place.run("init servo.csv --input volts --set controller.foo=1 -o m.yaml").err,
              HasSubstr("expected --target and --controller-gain"));
}

TEST(Init, BeginsWithTheNumbersOfAMuJoCoModel) {
  Workplace place;
  TestEncoder encoder;
  encoder.rate = 500.0, encoder.duration = 4.0, encoder.bits = 18, encoder.step = 1e-4;
  place.file("r.csv", testing::rows_of(record({}, sine(0.5814, 1.0), encoder)).csv());
  place.file(
      "robot.xml",
      "<mujoco><worldbody><body><inertial pos='0 0 0' mass='1' diaginertia='1e-3 1e-3 1e-3'/><joint "
      "name='elbow' armature='2e-3' damping='0.05' frictionloss='0.02'/></body></worldbody><actuator><motor "
      "joint='elbow' gear='0.172'/></actuator></mujoco>");
  const auto init = place.run("init r.csv --from robot.xml --joint elbow -o drive.yaml");
  EXPECT_EQ(init.status, 0) << init.err;
  const std::string yaml = testing::text_of(place.folder() / "drive.yaml");
  EXPECT_THAT(yaml,
              HasSubstr("torque_constant: 0.172  # N m per unit of u; of joint elbow; every number that is "
                        "fitted goes in proportion to it"));
  EXPECT_THAT(yaml, HasSubstr("motor_inertia: {value: 0.002, estimate: true}")) << "the armature";
  EXPECT_THAT(yaml, HasSubstr("mass_ratio: {value: 0.5, estimate: true}")) << "the body behind the gap";
  EXPECT_THAT(yaml, HasSubstr("motor_damping: {value: 0.05, estimate: true}"));
  EXPECT_THAT(yaml, HasSubstr("- motor_coulomb_friction: {level_nm: {value: 0.02, estimate: true}}"));
  EXPECT_EQ(place.run("fit drive.yaml -o report").status, 0);
  place.run("init r.csv --model one_body --from robot.xml --joint elbow -o one.yaml");
  EXPECT_THAT(testing::text_of(place.folder() / "one.yaml"),
              HasSubstr("motor_inertia: {value: 0.003, estimate: true}"));
  EXPECT_THAT(place.run("init r.csv --from robot.xml --joint knee -o d.yaml").err,
              HasSubstr("has no joint 'knee'"));
  EXPECT_EQ(place.run("init r.csv --from robot.xml -o d.yaml").status, 2);
}

TEST(Init, TakesGravityOfAMuJoCoModelAndSaysWhatItLeavesAside) {
  Workplace place;
  TestEncoder encoder;
  encoder.rate = 500.0, encoder.duration = 4.0, encoder.bits = 18, encoder.step = 1e-4;
  const std::string rows = testing::rows_of(record({}, sine(0.5814, 1.0), encoder)).csv();
  place.file("r.csv", rows), place.file("h.csv", rows);
  place.file(
      "robot.xml",
      "<mujoco><worldbody><body><inertial pos='0 0 -0.05' mass='0.12' diaginertia='1e-3 1e-3 1e-3'/><joint "
      "name='elbow' axis='0 1 0' armature='2e-3' stiffness='0.05'/></body></worldbody><actuator><position "
      "joint='elbow' kp='20'/></actuator></mujoco>");
  const std::string from = "init r.csv --held-out h.csv --from robot.xml --joint elbow ";
  const auto init = place.run(from + "--input-unit A -o drive.yaml");
  EXPECT_EQ(init.status, 0) << init.err;
  const std::string yaml = testing::text_of(place.folder() / "drive.yaml");
  EXPECT_THAT(yaml, HasSubstr("name: drive  #"));
  EXPECT_THAT(yaml, HasSubstr("- load_unbalance: {amplitude_nm: {value: 0.05886, estimate: true}, phase_rad: "
                              "{value: 0, estimate: true}}"));
  EXPECT_THAT(yaml, HasSubstr("torque_constant: {value: 1, guess: true}"));
  for (const std::string& said : {yaml, init.err}) {
    EXPECT_THAT(said, HasSubstr("not taken: the joint's stiffness 0.05"));
    EXPECT_THAT(said, HasSubstr("torque_constant is a GUESS: robot.xml has a gear of 1 for joint elbow, but "
                                "the input is in A, not in N m"));
  }
  EXPECT_THAT(init.out, HasSubstr("gapscope diagnose drive.yaml"));
  EXPECT_THAT(init.out, HasSubstr("gapscope export reports/drive --to mjcf -o drive_mjcf --into robot.xml "
                                  "--joint elbow\n"));
  EXPECT_EQ(place.run(from + "-o torque.yaml").status, 0);
  EXPECT_THAT(testing::text_of(place.folder() / "torque.yaml"), HasSubstr("torque_constant: 1  #"));
}

TEST(Init, AsksWhetherAnInputFarBeyondTheControlIsTheTorqueBehindTheGear) {
  Workplace place;
  TestEncoder encoder;
  encoder.rate = 500.0, encoder.duration = 4.0, encoder.bits = 18, encoder.step = 1e-4;
  place.file("r.csv", testing::rows_of(record({}, sine(0.5814, 1.0), encoder)).csv());
  const auto said_with = [&](const std::string& range, const std::string& gear) {
    place.file(
        "arm.xml",
        "<mujoco><worldbody><body><inertial pos='0 0 0' mass='0.1' diaginertia='1e-3 1e-3 1e-3'/>"
        "<joint name='elbow' armature='2e-3'/></body></worldbody><actuator><motor joint='elbow' gear='" +
            gear + "' ctrllimited='true' ctrlrange='-" + range + " " + range + "'/></actuator></mujoco>");
    return place.run("init r.csv --from arm.xml --joint elbow -o arm.yaml").err;
  };
  EXPECT_THAT(said_with("0.2", "30"),
              HasSubstr("2.9 times the range of the actuator's control (0.2): is it the "
                        "torque at the joint? Then take torque_constant: 1"));
  for (const auto& [range, gear] : {std::pair{"0.5", "30"}, {"0.2", "1"}})
    EXPECT_THAT(said_with(range, gear), ::testing::Not(HasSubstr("at the joint?"))) << range << ", " << gear;
}

TEST(Init, AGapIsSeenAndLeftToTheFit) {
  Workplace place;
  TestEncoder encoder;
  encoder.rate = 1000.0, encoder.duration = 5.0, encoder.bits = 18, encoder.step = 2e-5;
  place.file("r.csv", testing::rows_of(record({}, sine(0.5814, 1.0), encoder)).csv());
  const std::string yaml = tried(place, "r.csv");
  EXPECT_THAT(yaml, ::testing::ContainsRegex("the detector reads a gap of 1[0-9.]+ mrad"));
  EXPECT_THAT(yaml,
              HasSubstr("gap: {estimate: true}"));  // the fit is to stand beside the detector, not on it
  EXPECT_THAT(place.run("detect drive.yaml").out, HasSubstr("backlash"));
  const auto again = place.run("init r.csv -o drive.yaml");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("drive.yaml: is there already, expected another name"));
}

TEST(Init, AnOptionWithTwoNumbersDoesNotTakeTheFileAfterThem) {
  const Workplace place;
  const std::string recording = std::string(GAPSCOPE_SOURCE_DIR) + "/configs/03_recording.csv";
  const auto init = place.run("init --window 0 1.5 " + recording + " -o drive.yaml");
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(testing::text_of(place.folder() / "drive.yaml"), HasSubstr("window: [0, 1.5]"));
}

TEST(Init, AHeldOutRecordingIsNamedAndReadByTheDiagnosis) {
  Workplace place;
  const auto input = [](double t) { return 0.3 * std::sin(9.0 * t) + 0.2 * std::sin(31.0 * t); };
  const auto other = [](double t) { return 0.4 * std::sin(7.0 * t) + 0.1 * std::sin(23.0 * t); };
  place.file("first.csv", one_body_csv(input));
  place.file("logs/second.csv", one_body_csv(other));
  const std::string yaml = tried(place, "first.csv --model one_body --held-out logs/second.csv");
  EXPECT_THAT(yaml, HasSubstr("held_out: \"logs/second.csv\""));
  EXPECT_THAT(testing::text_of(place.folder() / "report/diagnosis.json"), HasSubstr("second.csv"));

  const auto missing = place.run("init first.csv --held-out third.csv -o other.yaml");
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("third.csv"));
  EXPECT_FALSE(place.content().count("other.yaml"));
}

TEST(Init, SeveralRecordingsAreOneDrive) {
  Workplace place;
  place.file("1.csv",
             one_body_csv([](double t) { return 0.1 * std::sin(9.0 * t) + 0.06 * std::sin(31.0 * t); }));
  place.file("2.csv",
             one_body_csv([](double t) { return 0.2 * std::sin(7.0 * t) + 0.10 * std::sin(23.0 * t); }));
  place.file("3.csv",
             one_body_csv([](double t) { return 0.3 * std::sin(9.0 * t) + 0.20 * std::sin(31.0 * t); }));
  const std::string yaml = tried(place, "1.csv 2.csv 3.csv --model one_body");
  EXPECT_THAT(yaml, HasSubstr("file: [\"1.csv\", \"2.csv\", \"3.csv\"]"));
  EXPECT_THAT(yaml, HasSubstr("motor_inertia: {value: 0.005"));
  const std::string result = testing::text_of(place.folder() / "report/result.json");
  for (const char* file : {"1.csv", "2.csv", "3.csv"}) EXPECT_THAT(result, HasSubstr(file));
  const auto twice = place.run("init 1.csv 2.csv 1.csv -o other.yaml");
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("1.csv is named twice"));
}

/// A free load that sticks where its friction takes nearly the whole torque makes the loop of a held output.
TEST(Init, AnOutputIsTakenForALockedOneByAGuessAlone) {
  Workplace place;
  const std::string rig = std::string(GAPSCOPE_SOURCE_DIR) + "/configs/02_experiment.yaml";
  std::string changed = " --set 'simulation.model.effects=[{contact_adhesion: {release_nm: 0.07}}]'";
  for (const char* parameter : {"load_coulomb_friction=0.098", "motor_damping=0.03", "load_damping=0.04",
                                "contact_stiffness=800", "contact_damping=0.1"})
    changed += std::string(" --set simulation.model.parameters.") + parameter;
  ASSERT_EQ(place.run("simulate " + rig + changed + " -o r.csv").status, 0);
  const auto init = place.run("init r.csv -o drive.yaml");
  EXPECT_THAT(init.out, HasSubstr("model       GUESS: locked output"));
  EXPECT_THAT(testing::text_of(place.folder() / "drive.yaml"), HasSubstr("  # GUESS: locked output"));
}

TEST(Init, AWarningSaysWhatToDo) {
  Workplace place;
  testing::Rows rows = testing::rig();
  for (double& t : rows.t) t *= 500.0;
  place.file("ms.csv", rows.csv());
  EXPECT_THAT(place.run("init ms.csv --model gap").err, HasSubstr("or declare its unit: recording: units"));
  EXPECT_EQ(place.run("init ms.csv --model gap --time-unit 0.002 -o right.yaml").err, "");
  place.file("short.csv", one_body_csv([](double t) { return t < 3.0 ? 0.3 : -0.3; }));
  EXPECT_EQ(place.run("init short.csv --model one_body").err, "") << "nobody asks the detector";
  const auto usage = place.run("init ms.csv --mass 1");
  EXPECT_THAT(usage.err,
              HasSubstr("expected gapscope init FILE [OPTIONS]; `gapscope init --help` lists them"));
}

TEST(Init, AGapThatTheDetectorDoesNotSeeIsMarkedAsAGuess) {
  Workplace place;
  TestEncoder encoder;
  encoder.rate = 500.0, encoder.duration = 3.0, encoder.bits = 14, encoder.step = 1e-4;
  place.file("r.csv", testing::rows_of(record({}, sine(0.5814, 0.4), encoder)).csv());
  const auto init = place.run("init r.csv -o drive.yaml");
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.out,
              HasSubstr("GUESS: gap and free load; the detector is inconclusive (no periodic motion"));
  const std::string yaml = testing::text_of(place.folder() / "drive.yaml");
  EXPECT_THAT(yaml, HasSubstr("  # GUESS: gap and free load"));
  EXPECT_THAT(yaml, HasSubstr("gap: {estimate: true}  # GUESS that there is one"));
  EXPECT_THAT(yaml, HasSubstr("- motor_coulomb_friction: {level_nm: {estimate: true}}"));
  EXPECT_THAT(yaml, HasSubstr("gapscope init --model one_body"));
  EXPECT_EQ(place.run("init r.csv --model gap -o asked.yaml").status, 0);
  EXPECT_THAT(testing::text_of(place.folder() / "asked.yaml"), Not(HasSubstr("GUESS that there is one")));
}

TEST(Init, IrregularTimeIsResampledForTheDetectorAndWhatSpoilsIsWrittenDown) {
  Workplace place;
  testing::Rows rows = testing::rig();
  for (std::size_t i = 0; i < rows.t.size(); ++i) {
    rows.t[i] += 1e-4 * static_cast<double>(i % 3);
    rows.u[i] = -rows.u[i];
  }
  place.file("r.csv", "when,u,x1" + rows.csv().substr(6));
  const auto init = place.run("init r.csv --time when");
  EXPECT_EQ(init.status, 0) << init.err;
  EXPECT_THAT(init.err, HasSubstr("warning: sign:"));
  const std::string yaml = testing::text_of(place.folder() / "r.yaml");
  EXPECT_THAT(yaml, HasSubstr("# SPOILS THE ESTIMATES, sign:"));
  EXPECT_THAT(yaml, HasSubstr("columns: {time: \"when\""));
  EXPECT_THAT(yaml, HasSubstr(", for: detector}"));
  EXPECT_EQ(place.run("detect r.yaml").status, 0);
}

TEST(Init, ARealAxisFromTheFileToTheDiagnosis) {
  GAPSCOPE_NEEDS_DATA();
  Workplace place;
  const std::string file = (testing::data_folder() / "emps/emps_train.csv").string();
  const std::string yaml = tried(place, file + " --translation");
  EXPECT_THAT(yaml, HasSubstr("encoder: {quantum: 5e-08}"));
  EXPECT_THAT(yaml, HasSubstr("mass_ratio: 0"));
  EXPECT_THAT(testing::text_of(place.folder() / "report/diagnosis.json"),
              HasSubstr("motor_coulomb_friction"));
}

}  // namespace
}  // namespace gapscope
