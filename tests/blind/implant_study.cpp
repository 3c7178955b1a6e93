// Configurations for `gapscope blind run` of real drives, each a body with viscous damping.
//   study_implants DATA OUT FIRST_SEED KNOWN OUTSIDE NONE [DRIVE ...]
// DATA is the folder of the recordings; OUT gets DRIVE.yaml and its recordings, columns t, u, x1. Drives:
// emps, xl330, cycloidal (all of them by default). Then, for each of them,
//   gapscope blind run OUT/DRIVE.yaml -o REPORT
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "config/configuration.h"
#include "torque_view/stamped_file.h"

namespace {

using namespace gapscope;
namespace fs = std::filesystem;

struct StudiedDrive {
  const char* name;
  std::vector<const char*> fitted, held_out;  ///< files
  const char* rest;                           ///< of the configuration
};

const StudiedDrive kDrives[] = {
    {"emps",
     {"emps/emps_train.csv"},
     {"emps/emps_pulses.csv"},
     R"(encoder: {quantum: 5.0e-8}
coordinates: translation
model:
  parameters:
    torque_constant: 1
    motor_inertia: {value: 95, estimate: true}
    motor_damping: {value: 200, estimate: true}
    mass_ratio: 0
)"},
    {"xl330",
     {"xl330/sin_sin_kp100.csv", "xl330/lift_and_drop_kp100.csv"},
     {"xl330/sin_sin_kp400.csv", "xl330/lift_and_drop_kp400.csv"},
     R"(encoder: {bits: 12}
model:
  parameters:
    torque_constant: 1
    motor_inertia: {value: 0.06, estimate: true}
    motor_damping: {value: 0.3, estimate: true}
    mass_ratio: 0
)"},
    {"cycloidal",
     {"cycloidal/splitpreload3_pos1.csv"},
     {},
     R"(encoder: {bits: 16}
model:
  load: locked
  parameters:
    torque_constant: 1
    motor_inertia: {estimate: true}
    motor_damping: {estimate: true}
    gap: 0
    contact_stiffness: {value: 650, estimate: true}
    contact_damping: {estimate: true}
)"},
};

/// As t, u, x1, whatever the columns were.
std::string converted(const fs::path& data, const char* file, const fs::path& out) {
  const auto trace = internal::torque_view::test::read_stamped((data / file).string());
  const std::string name = fs::path(file).filename().string();
  std::ofstream csv(out / name);
  csv << "t,u,x1\n";
  for (std::size_t i = 0; i < trace.t.size(); ++i)
    csv << fmt::format("{},{},{}\n", trace.t[i], trace.u[i], trace.x[i]);
  return name;
}

std::string list_of(const fs::path& data, const std::vector<const char*>& files, const fs::path& out) {
  std::string list;
  for (const char* file : files) list += (list.empty() ? "" : ", ") + converted(data, file, out);
  return "[" + list + "]";
}

void prepare(const StudiedDrive& drive, const fs::path& data, const fs::path& out,
             const ImplantConfig& implant) {
  std::string text =
      fmt::format("name: {}\nrecording:\n  file: {}\n", drive.name, list_of(data, drive.fitted, out));
  if (!drive.held_out.empty()) text += "  held_out: " + list_of(data, drive.held_out, out) + "\n";
  const std::string file = (out / (std::string(drive.name) + ".yaml")).string();
  Configuration c = parse_configuration(text + drive.rest, file);
  c.implant = implant;
  std::ofstream(file) << yaml_of(c, "");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 7) {
    fmt::print(stderr, "study_implants DATA OUT FIRST_SEED KNOWN OUTSIDE NONE [DRIVE ...]\n");
    return 2;
  }
  ImplantConfig implant;
  implant.first_seed = std::strtoull(argv[3], nullptr, 10);
  implant.known = std::atoi(argv[4]), implant.outside = std::atoi(argv[5]), implant.none = std::atoi(argv[6]);
  fs::create_directories(argv[2]);
  const std::vector<std::string> wanted(argv + 7, argv + argc);
  for (const StudiedDrive& drive : kDrives)
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), drive.name) != wanted.end())
      prepare(drive, argv[1], argv[2], implant);
}
