#include "run/trust_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "gapscope/recording/recording_file.h"

namespace gapscope::test {
namespace {

using independent_plant::ChainCase;
using independent_plant::ChainRun;
using independent_plant::ChainSheet;

std::string sought(double value, double low, double high) {
  return fmt::format("{{value: {:.6g}, estimate: true, bounds: [{:.6g}, {:.6g}]}}", value, low, high);
}

/// About zero to so many times the value of the sheet.
std::string up_to(double value, double times) { return sought(value, 0.0, times * value); }

}  // namespace

std::string sheet_configuration(const std::string& name, const ChainCase& c) {
  const ChainSheet s = chain_sheet(c);
  const double most = 1.25 * c.torque_nm;  // of friction
  std::string y = fmt::format("name: {}\nrecording: {{file: {}.csv}}\nencoder: {{quantum: {:.17g}}}\n", name,
                              name, c.sensor.quantum);
  y += fmt::format("model:\n  parameters:\n    motor_inertia: {:.6g}\n    torque_constant: {:.6g}\n",
                   s.motor_inertia, s.torque_constant);
  y += "    motor_damping: " + up_to(s.motor_damping, 10.0) + "\n";
  y += "    mass_ratio: " + sought(s.mass_ratio, 0.02 * s.mass_ratio, 50.0 * s.mass_ratio) + "\n";
  y += "    gap: " + sought(s.gap, 0.0, 0.3) + "\n";
  y += "    load_damping: " + up_to(s.load_damping, 10.0) + "\n";
  y += "    load_coulomb_friction: " + sought(std::min(s.load_coulomb, most), 0.0, most) + "\n";
  const double k = s.contact_stiffness;
  y += "    contact_stiffness: " + sought(k, 0.05 * k, 20.0 * k) + "\n";
  y += "    contact_damping: " + up_to(s.contact_damping, 20.0) + "\n";
  if (s.motor_coulomb > 0.0)
    y += "  effects: [{motor_coulomb_friction: {level_nm: " + up_to(s.motor_coulomb, 10.0) + "}}]\n";
  return y;
}

std::string write_case(const std::string& folder, const std::string& name, const ChainCase& c, bool with_x2) {
  ChainRun run = simulate_chain(c);
  if (!with_x2) run.recording.x2.clear();
  write_csv(folder + "/" + name + ".csv", run.recording);
  const std::string path = folder + "/" + name + ".yaml";
  std::ofstream(path, std::ios::binary) << sheet_configuration(name, c);
  return path;
}

}  // namespace gapscope::test
