// From a drive to a mended MJCF, and from MuJoCo's own motion of it back.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "config/begun_model.h"
#include "diagnosis/begin.h"
#include "exports/export.h"
#include "exports/mujoco_engine.h"
#include "gapscope/recording/recording_file.h"
#include "independent_plant/simulate.h"
#include "results/scratch_folder.h"
#include "run/run_diagnosis.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;

constexpr double kSampleRate = 500.0, kSeconds = 2.0, kEngineStep = 1e-4;
constexpr int kEncoderBits = 18;

std::vector<double> reversing_input(bool held_out) {
  std::vector<double> u;
  for (int i = 0; i < static_cast<int>(kSampleRate * kSeconds); ++i) {
    const double slow = 2.0 * kPi * i / kSampleRate;
    u.push_back(0.8 * (held_out ? 0.6 * std::sin(0.8 * slow) + 0.4 * std::sin(2.7 * slow)
                                : std::sin(1.1 * slow) * (0.7 + 0.3 * std::sin(0.37 * slow))));
  }
  return u;
}

Recording recorded_drive(bool held_out) {
  independent_plant::BlindDrive d;
  d.effects.motor.friction.level_nm = 0.02;
  const auto sensor = independent_plant::BlindSensor::with_bits(kEncoderBits, 0.5);
  const independent_plant::BlindOptions options{kSampleRate, kSeconds, held_out ? 41u : 40u,
                                                independent_plant::kFastTolerance};
  return independent_plant::simulate_blind_command(d, reversing_input(held_out), sensor, options).recording;
}

/// MuJoCo's answer to the input of a recording, read by its encoder.
Recording answer_of_mujoco(const Configuration& model, const Recording& to) {
  testing::MujocoEngineRun engine(export_drive(model, ExportFormat::kMjcf).files[0].text);
  const auto inner = static_cast<std::size_t>(std::lround(to.dt / kEngineStep));
  std::vector<double> u;
  for (std::size_t i = 0; i < to.size() * inner; ++i) u.push_back(to.u[i / inner]);
  const std::vector<double> x1 = engine.motion(kEngineStep, mjINT_RK4, u);
  Recording answer = to;
  answer.quantum = EncoderConfig::quantum_of(kEncoderBits);
  for (std::size_t i = 0; i < to.size(); ++i)
    answer.x1[i] = answer.quantum * std::round(x1.at(i * inner) / answer.quantum);
  return answer;
}

double rms_between(const Recording& a, const Recording& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a.x1[i] - b.x1[i]) * (a.x1[i] - b.x1[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// What the author of the MJCF believed: no friction of the motor, and other numbers.
const std::string kBelieved =
    "encoder: {bits: 18}\nmodel:\n  parameters: {torque_constant: 0.172, motor_inertia: 8.78e-4, "
    "contact_stiffness: 200, contact_damping: 0.05, motor_damping: {value: 0.07, estimate: true}, mass_ratio: "
    "{value: 1.1, estimate: true}, gap: {value: 0.017, estimate: true}, load_damping: {value: 0.04, estimate: "
    "true}, load_coulomb_friction: {value: 0.055, estimate: true}}\n";

/// Of the effects the one that is missing and what is most easily taken for it.
DiagnosisOptions among_a_few(const Configuration& c) {
  DiagnosisOptions options = diagnosis_options(c);
  const std::vector<std::string> asked = {"motor_coulomb_friction", "stribeck_friction", "input_dead_zone",
                                          "input_delay"};
  for (const EffectEntry* e : effect_table())
    if (!contains(asked, e->name)) options.excluded.emplace_back(e->name);
  options.threads = 1;
  return options;
}

Configuration believed() {
  return parse_configuration(
      "name: believed\nsimulation: {rate: 500, duration: 2, excitation: {sine: {amplitude: 0.6, frequency: 1}}}\n" +
          kBelieved,
      "believed.yaml");
}

/// One working folder with the drive's two recordings and MuJoCo's answers to them.
class Bench {
 public:
  Bench() : drive{recorded_drive(false), recorded_drive(true)} { keep("drive", drive); }

  void keep(const std::string& name, const Recording (&recordings)[2]) const {
    for (int i = 0; i < 2; ++i) write_csv(at(fmt::format("{}_{}.csv", name, i)), recordings[i]);
  }
  DiagnosisResult diagnosed(const std::string& name, const std::string& recordings,
                            const std::string& model) {
    std::ofstream(at(name)) << "name: axis\nrecording: {" << recordings << "}\n" << model;
    configuration_ = load_configuration(at(name));
    return run_diagnosis(configuration_, among_a_few(configuration_)).result;
  }
  /// What was found, from where a recording begins.
  Configuration mended(const Diagnosis& d, int recording) const {
    const MotorTrace trace = drive[recording].motor_trace();
    return parse_configuration(
        model_yaml(configuration_, d.fitted, "", trace, begin_of(d.fitted, trace, d.observer_hz)),
        "fitted.yaml");
  }
  /// The same as a model whose numbers may still change.
  std::string model_of(const Diagnosis& d) const {
    std::string numbers;
    for (int i = 0; i < kDriveParameterCount; ++i) {
      const ParameterSetting& p = d.fitted.parameters[static_cast<std::size_t>(i)];
      numbers += fmt::format("{}{}: {{value: {}, estimate: {}}}", i == 0 ? "" : ", ", kDriveParameters[i].key,
                             p.value, p.estimate);
    }
    return fmt::format(
        "encoder: {{bits: 18}}\nmodel:\n  parameters: {{{}}}\n  effects: [{{motor_coulomb_friction: "
        "{{level_nm: {{value: {}, estimate: true}}}}}}]\n",
        numbers, d.added.front().parameters.front().value);
  }

  Recording drive[2];  ///< fitted, held out

 private:
  std::string at(const std::string& name) const { return (folder_.path / name).string(); }
  ScratchFolder folder_;
  Configuration configuration_;
};

TEST(MendedDrive, MovesInMujocoAsTheDriveAndAsTheDiagnosisForetold) {
  Bench bench;
  const Recording old[2] = {answer_of_mujoco(believed(), bench.drive[0]),
                            answer_of_mujoco(believed(), bench.drive[1])};
  bench.keep("old", old);
  const DiagnosisResult told = bench.diagnosed(
      "axis.yaml", "file: drive_0.csv, held_out: drive_1.csv, simulated: [old_0.csv, old_1.csv]", kBelieved);
  EXPECT_THAT(told.diagnosis.effects, ElementsAre("motor_coulomb_friction"));
  ASSERT_TRUE(told.simulated);
  const SimulatorRow& first = told.simulated->rows.front();
  EXPECT_EQ(first.name, "motor_coulomb_friction");
  EXPECT_EQ(first.found_in, FoundIn::kDrive);

  const Recording mended[2] = {answer_of_mujoco(bench.mended(told.diagnosis, 0), bench.drive[0]),
                               answer_of_mujoco(bench.mended(told.diagnosis, 1), bench.drive[1])};
  const double was = rms_between(old[1], bench.drive[1]), is = rms_between(mended[1], bench.drive[1]);
  EXPECT_NEAR(was, told.simulated->errors.simulator, 1e-9);
  EXPECT_NEAR(1.0 - is / was, told.simulated->shrink_all, 0.002) << "the promise, by what is held out";
  EXPECT_NEAR(1.0 - is / was, told.diagnosis.mismatch.shrink, 0.01);
  EXPECT_LT(is, 2.0 * EncoderConfig::quantum_of(kEncoderBits));

  bench.keep("mended", mended);
  const std::string model = bench.model_of(told.diagnosis);
  const DiagnosisResult again =
      bench.diagnosed("again.yaml", "file: mended_0.csv, held_out: mended_1.csv", model);
  EXPECT_EQ(again.diagnosis.verdict, DiagnosisVerdict::kNone) << again.diagnosis.sentence;
}

}  // namespace
}  // namespace gapscope
