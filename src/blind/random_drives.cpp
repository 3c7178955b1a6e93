#include "blind/random_drives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "base/interrupt.h"
#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording_file.h"
#include "independent_plant/random_drive.h"
#include "results/report_folder.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using independent_plant::BlindCase;
using independent_plant::BlindDrive;

const char* word(RandomDriveKind kind) { return kind == RandomDriveKind::kGap ? "gap" : "gap_free"; }

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

std::string estimated(double value, double low, double high) {
  return fmt::format("{{value: {:.6g}, estimate: true, bounds: [{:.6g}, {:.6g}]}}", value, low, high);
}

/// The configuration that goes with a recording: everything from the sheet, nothing from the drive.
std::string configuration(const std::string& name, const BlindCase& c, const BlindDrive& sheet,
                          bool with_gap) {
  std::string y = fmt::format("name: {}\nrecording: {{file: {}.csv}}\nencoder: {{quantum: {:.17g}}}\n", name,
                              name, c.sensor.quantum);
  const bool one_inertia = sheet.load == independent_plant::BlindLoad::kNone;
  const double mass_ratio = one_inertia ? 0.0 : sheet.load_inertia / sheet.motor_inertia;
  y += fmt::format("model:\n  parameters:\n    motor_inertia: {:.6g}\n    torque_constant: {:.6g}\n",
                   sheet.motor_inertia, sheet.torque_constant);
  y += "    motor_damping: " + estimated(sheet.motor_damping, 0.0, 10.0 * sheet.motor_damping) + "\n";
  if (one_inertia) return y + "    mass_ratio: 0\n";
  y += "    mass_ratio: " + estimated(mass_ratio, 0.02 * mass_ratio, 50.0 * mass_ratio) + "\n";
  y += "    gap: " + (with_gap ? estimated(sheet.gap, 0.0, 0.3) : std::string("0")) + "\n";
  const double most_friction = c.drive.torque_constant * c.excitation.amplitude;
  y += "    load_damping: " + estimated(sheet.load_damping, 0.0, 10.0 * sheet.load_damping) + "\n";
  y += "    load_coulomb_friction: " +
       estimated(std::min(sheet.load_coulomb, most_friction), 0.0, most_friction) + "\n";
  y += "    contact_stiffness: " +
       estimated(sheet.contact_stiffness, 0.05 * sheet.contact_stiffness, 20.0 * sheet.contact_stiffness) +
       "\n";
  y += "    contact_damping: " + estimated(sheet.contact_damping, 0.0, 20.0 * sheet.contact_damping) + "\n";
  return y;
}

constexpr const char* kTruthHeader =
    "name,kind,gap_rad,mass_ratio,contact_stiffness_nm_rad,contact_damping_nms_rad,motor_damping_nms_rad,"
    "load_damping_nms_rad,load_coulomb_friction_nm,torque_amplitude_nm,frequency_hz,rate_hz,quantum_rad,"
    "noise_rad,load_travel_share\n";

/// Median travel of the load while the gap was crossed, over the gap.
double load_travel_share(const independent_plant::BlindTruth& truth) {
  std::vector<double> shares;
  for (const independent_plant::GapPassage& p : truth.passages)
    if (p.from_flank * p.to_flank < 0) shares.push_back(std::abs(p.load_travel) / p.gap);
  return median(shares);
}

std::string truth_row(const std::string& name, const BlindCase& c, const independent_plant::BlindTruth& truth,
                      bool with_gap) {
  const BlindDrive& d = c.drive;
  return fmt::format(
      "{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.4g}\n",
      name, c.kind, with_gap ? d.gap : 0.0,
      d.load == independent_plant::BlindLoad::kNone ? 0.0 : d.load_inertia / d.motor_inertia,
      d.contact_stiffness, d.contact_damping, d.motor_damping, d.load_damping, d.load_coulomb,
      d.torque_constant * c.excitation.amplitude, c.excitation.frequency, c.options.rate, c.sensor.quantum,
      c.sensor.noise, with_gap ? load_travel_share(truth) : 0.0);
}

}  // namespace

void write_random_drives(RandomDriveKind kind, std::uint64_t first_seed, std::uint64_t last_seed,
                         const std::string& folder, const std::function<void(std::uint64_t)>& progress) {
  const bool with_gap = kind == RandomDriveKind::kGap;
  ReportFolder drives(folder, FolderKind::kDrives);
  const fs::path place = drives.path();
  std::string truth = kTruthHeader;
  for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
    stop_point();
    const BlindCase c =
        with_gap ? independent_plant::random_drive(seed) : independent_plant::random_gap_free_drive(seed);
    independent_plant::BlindRun run = simulate_blind(c);
    run.recording.x2.clear();
    run.recording.mode.clear();
    const std::string name = fmt::format("{}_{}", word(kind), seed);
    write_csv((place / (name + ".csv")).string(), run.recording);
    write_text(place / (name + ".yaml"),
               configuration(name, c, independent_plant::data_sheet(c.drive, seed), with_gap));
    truth += truth_row(name, c, run.truth, with_gap);
    if (progress) progress(seed - first_seed + 1);
  }
  write_text(place / "truth.csv", truth);
  stop_point();
  drives.commit();
}

}  // namespace gapscope
