// How far fits are trusted, on drives whose truth is known, and on real recordings that read as they should
// not. Random drives of the independent plant by the laws of random_drive.h; stiffness and damping of the
// contact are given for even seeds, and sought for odd ones.
// study_fit_trust KIND [first seed] [count] [DATA]
//   right    the model is the drive
//   effect   the drive has an effect that the model lacks, the severity 0 to 1
//   none     the drive has no gap, the model is told that it has one
//   sign     u of the wrong sign
//   real     recordings of DATA
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "base/random.h"
#include "gapscope/recording/recording_file.h"
#include "independent_plant/severity.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

ReferenceModel told(const independent_plant::BlindDrive& truth, std::uint64_t seed) {
  const auto sheet = numbers_of(independent_plant::data_sheet(truth, seed));
  const auto exact = numbers_of(truth);
  ReferenceModel model = known_model(truth);
  for (int n : {kGap, kMotorDamping, kMassRatio, kLoadDamping, kLoadCoulombFriction})
    estimate(model, n, sheet[static_cast<std::size_t>(n)]);
  for (int n : {kContactStiffness, kContactDamping})
    if (seed % 2 == 1)
      estimate(model, n, sheet[static_cast<std::size_t>(n)]);
    else
      model.parameters[n].value = exact[static_cast<std::size_t>(n)];
  return model;
}

void print(const std::string& name, double truth, const FitSummary& f) {
  const FittedParameter* gap = f.find("gap");
  const double g = gap ? gap->value : kNaN;
  const bool tells = gap && gap->identifiable;
  const bool covers = tells && gap->ci95.low <= truth && truth <= gap->ci95.high;
  std::vector<std::string> bounds;
  for (const auto& p : f.parameters)
    if (p.estimated && p.at_bound) bounds.push_back(p.key);
  std::vector<std::string> codes;
  for (const Remark& w : f.warnings) codes.push_back(w.code());
  fmt::print(
      "{} | {} why {} | gap {:.4f} -> {:.4f} std {:.2g} {}{} | innov/fl {:.3f} rmse/fl {:.3f} at {:.3g} fit% "
      "{:.3f} coast "
      "{:.4f} closed/with {:.4f} {:.3f} | lag1 {:.3f} white {:.2f}/{:.1f} in {:.2f}/{:.1f} | conv {} bounds {} | {}\n",
      name, to_string(f.trust), f.why.code(), truth, g, gap ? gap->std : kNaN, tells ? "" : "unid ",
      covers ? "covers" : "misses", f.innovation_rmse / f.floor, f.rmse / f.floor, f.objective_hz,
      f.fit_percent, f.innovation_rmse / f.coasting_rmse, f.without_gap_ratio, f.floor,
      f.lag1_autocorrelation, f.whiteness.outside, f.whiteness.worst, f.input_correlation.outside,
      f.input_correlation.worst, f.converged(), fmt::join(bounds, ","), fmt::join(codes, ","));
  std::fflush(stdout);
}

void one(const std::string& kind, std::uint64_t seed) {
  using namespace independent_plant;
  BlindCase c = kind == "none" ? random_gap_free_drive(seed) : random_drive(seed);
  c.options.tolerance = kFastTolerance;
  BlindDrive truth = c.drive;
  std::string name = fmt::format("{} {} {}", kind, seed, c.kind);
  if (kind == "none") {
    const BlindCase like = random_drive(seed);
    truth = like.drive;
    truth.motor_inertia = c.drive.motor_inertia;
  }
  if (kind == "effect") {
    std::vector<std::string_view> names;
    for (const DrawnEffect& e : effect_entries())
      if (e.name != "backlash" && can_have(c.drive, e)) names.push_back(e.name);
    auto g = random_stream(seed, "trust study");
    const auto which = names[seed % names.size()];
    const double severity = uniform(g, 0.0, 1.0);
    give_effect(c, which, severity, seed);
    name += fmt::format(" {} {:.2f}", which, severity);
  }
  Recording r = simulate_blind(c).recording;
  if (kind == "sign")
    for (double& u : r.u) u = -u;
  print(name, kind == "none" ? 0.0 : c.drive.gap, fit_one(r, told(truth, seed)));
}

Recording load(const std::string& file, std::pair<double, double> window, double rate, double quantum) {
  ReadOptions options;
  options.window = window;
  if (rate > 0.0) options.resample_rate = rate;
  Recording r = read_recording(file, options);
  if (quantum > 0.0) r.quantum = quantum;
  return r;
}

Recording servo(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  Recording r;
  r.file = file;
  while (std::getline(in, line)) {
    double t, goal, x, duty, volts;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &t, &goal, &x, &duty, &volts) != 5) continue;
    if (duty > 32767) duty -= 65536;
    r.stamps.push_back(t), r.x1.push_back(x), r.u.push_back(duty / 885.0 * volts);
  }
  r.start = r.stamps.front();
  r.dt = (r.stamps.back() - r.start) / static_cast<double>(r.size() - 1);
  r.quantum = 2 * kPi / 4096;
  return r;
}

void real(const std::string& data) {
  const double q16 = 2 * kPi / 65536;
  const auto locked = [&](bool friction) {
    ReferenceModel m;
    m.structure.load = LoadKind::kLocked;
    m.parameters[kTorqueConstant].value = 1.0;
    for (auto [n, v] : {std::pair{kMotorInertia, 0.1},
                        {kMotorDamping, 0.5},
                        {kGap, 0.02},
                        {kContactStiffness, 500.0},
                        {kContactDamping, 1.0}})
      estimate(m, n, v);
    if (friction) {
      ModelEffect e;
      e.entry = find_effect("motor_coulomb_friction");
      e.parameters[0] = {1.0, true, kNaN, kNaN, {}};
      m.effects = {e};
    }
    return m;
  };
  for (const bool friction : {true, false}) {
    for (const char* n : {"00", "04", "05", "08", "12"})
      print(fmt::format("ladder {} friction {}", n, friction), 0.0,
            fit_one(load(data + "/preload_ladder/" + n + "_preload.csv", {0, 1e3}, 200, q16),
                    locked(friction)));
    print(fmt::format("split small {}", friction), 0.0029,
          fit_one(load(data + "/cycloidal/splitpreload3_pos1.csv", {0, 20.31}, 200, q16), locked(friction)));
    print(fmt::format("split whole {}", friction), 0.0029,
          fit_one(load(data + "/cycloidal/splitpreload3_pos1.csv", {0, 1e3}, 200, q16), locked(friction)));
    print(fmt::format("base small {}", friction), 0.0335,
          fit_one(load(data + "/cycloidal/baseline_pos1.csv", {0, 20.31}, 200, q16), locked(friction)));
    print(fmt::format("base whole {}", friction), 0.0335,
          fit_one(load(data + "/cycloidal/baseline_pos1.csv", {0, 1e3}, 200, q16), locked(friction)));
  }
  const auto two = [&](double m, double d, double km, double travel, double k, bool friction) {
    ReferenceModel model;
    model.parameters[kTorqueConstant].value = km;
    for (auto [n, v] : {std::pair{kMotorInertia, 0.5 * m},
                        {kMotorDamping, d},
                        {kMassRatio, 1.0},
                        {kGap, 0.02 * travel},
                        {kLoadDamping, 0.1 * d},
                        {kLoadCoulombFriction, kNaN}})
      estimate(model, n, v);
    model.parameters[kContactStiffness].value = k;
    model.parameters[kContactDamping].value = 0.1 * std::sqrt(k * m);
    if (!friction)
      model.parameters[kLoadCoulombFriction] = ParameterSetting::known(0.0),
      model.parameters[kLoadDamping] = ParameterSetting::known(0.0);
    return model;
  };
  ReferenceModel axis;
  axis.structure.has_load = false;
  axis.parameters[kTorqueConstant].value = 1.0;
  estimate(axis, kMotorInertia, 90.0), estimate(axis, kMotorDamping, 200.0);
  const Recording emps = load(data + "/emps/emps_train.csv", {0, 1e3}, 0, 5e-8),
                  pulses = load(data + "/emps/emps_pulses.csv", {0, 1e3}, 0, 5e-8);
  print("emps one body bare", 0.0, fit_one(emps, axis));
  ModelEffect e;
  e.entry = find_effect("motor_coulomb_friction");
  e.parameters[0] = {20.0, true, kNaN, kNaN, {}};
  axis.effects = {e};
  print("emps one body friction", 0.0, fit_one(emps, axis));
  e.entry = find_effect("constant_load_torque");
  e.parameters[0] = {3.0, true, kNaN, kNaN, {}};
  axis.effects.push_back(e);
  print("emps one body friction, constant", 0.0, fit_one(emps, axis));
  for (const bool friction : {true, false}) {
    print(fmt::format("emps two bodies friction {}", friction), 0.0,
          fit_one(emps, two(95.0, 200.0, 1.0, 0.24, 1e6, friction)));
    print(fmt::format("emps pulses two bodies friction {}", friction), 0.0,
          fit_one(pulses, two(95.0, 200.0, 1.0, 0.24, 1e6, friction)));
    for (const char* n : {"sin_sin_kp100", "sin_sin_kp400", "up_and_down_kp100", "lift_and_drop_kp400"})
      print(fmt::format("servo {} friction {}", n, friction), 0.0,
            fit_one(servo(data + "/xl330/" + n + ".csv"), two(7e-3, 0.04, 0.096, 2.0, 20.0, friction)));
  }
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "right";
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const int count = argc > 3 ? std::atoi(argv[3]) : 20;
  if (kind == "real") return gapscope::real(argc > 4 ? argv[4] : "."), 0;
  for (int i = 0; i < count; ++i) gapscope::one(kind, first + static_cast<std::uint64_t>(i));
}
