#include "metamorphic/told_drive.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>

namespace gapscope::metamorphic {
namespace {

struct Dimension {
  int torque, angle, time, input;
};

/// In the order of kDriveParameters.
constexpr std::array<Dimension, kDriveParameterCount> kDimensions = {{{1, -1, 2, 0},
                                                                      {1, 0, 0, -1},
                                                                      {1, -1, 1, 0},
                                                                      {0, 0, 0, 0},
                                                                      {0, 1, 0, 0},
                                                                      {1, -1, 1, 0},
                                                                      {1, 0, 0, 0},
                                                                      {1, -1, 0, 0},
                                                                      {1, -1, 1, 0}}};

void multiply(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

/// A column that has nothing to do with the drive.
double noise_of(std::size_t row, std::size_t column) {
  return std::sin(1e4 * static_cast<double>((row * row + 31 * column) % 7919));
}

std::string field(const Rows& rows, std::size_t i, std::size_t column, const CsvForm& form) {
  const std::string& name = form.columns[column];
  if (name == "t") return form.time(rows.t[i]);
  return form.number(name == "u" ? rows.u[i] : name == "x1" ? rows.x1[i] : noise_of(i, column));
}

std::string csv(const Rows& rows, const CsvForm& form) {
  std::string text = fmt::format("{}", fmt::join(form.columns, form.separator)) + form.line_end;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t column = 0; column < form.columns.size(); ++column)
      text +=
          field(rows, i, column, form) + (column + 1 < form.columns.size() ? form.separator : form.line_end);
  return text;
}

std::string setting_text(const ParameterSetting& p) {
  if (!p.estimate) return shortest(p.value);
  const bool bounded = std::isfinite(p.low) && std::isfinite(p.high);
  return fmt::format("{{value: {}, estimate: true{}}}", p.value,
                     bounded ? fmt::format(", bounds: [{}, {}]", p.low, p.high) : "");
}

std::string parameters_text(const ToldDrive& drive) {
  std::string text;
  for (int n = 0; n < kDriveParameterCount; ++n) {
    const int i = drive.parameters_backwards ? kDriveParameterCount - 1 - n : n;
    text += fmt::format("    {}: {}\n", kDriveParameters[i].key,
                        setting_text(drive.parameters[static_cast<std::size_t>(i)]));
  }
  return text;
}

/// Writes them and names them: "[fitted_1.csv, fitted_2.csv]".
std::string write_recordings(const std::string& folder, const std::string& name,
                             const std::vector<Rows>& recordings, const CsvForm& form) {
  std::vector<std::string> files;
  for (const Rows& rows : recordings) {
    files.push_back(fmt::format("{}_{}.csv", name, files.size() + 1));
    std::ofstream(folder + "/" + files.back(), std::ios::binary) << csv(rows, form);
  }
  return fmt::format("[{}]", fmt::join(files, ", "));
}

std::string reading_text(const std::string& folder, const ToldDrive& drive) {
  std::string text = "  file: " + write_recordings(folder, "fitted", drive.fitted, drive.form) + "\n";
  if (!drive.held_out.empty())
    text += "  held_out: " + write_recordings(folder, "held_out", drive.held_out, drive.form) + "\n";
  for (const auto& [key, value] : drive.reading) text += fmt::format("  {}: {}\n", key, value);
  return text;
}

}  // namespace

std::string shortest(double value) { return fmt::format("{}", value); }

double scale_of_parameter(const Scales& s, int place) {
  const Dimension& d = kDimensions[static_cast<std::size_t>(place)];
  return std::pow(s.torque, d.torque) * std::pow(s.angle, d.angle) * std::pow(s.time, d.time) *
         std::pow(s.input, d.input);
}

void scale(ToldDrive& drive, const Scales& by) {
  for (auto* recordings : {&drive.fitted, &drive.held_out})
    for (Rows& rows : *recordings)
      multiply(rows.t, by.time), multiply(rows.u, by.input), multiply(rows.x1, by.angle);
  for (int i = 0; i < kDriveParameterCount; ++i) {
    ParameterSetting& p = drive.parameters[static_cast<std::size_t>(i)];
    for (double* number : {&p.value, &p.low, &p.high}) *number *= scale_of_parameter(by, i);
  }
  drive.quantum *= std::abs(by.angle);
  if (by.angle != 1.0) drive.encoder = fmt::format("{{quantum: {}}}", drive.quantum);
  drive.scales.torque *= by.torque, drive.scales.angle *= by.angle;
  drive.scales.time *= by.time, drive.scales.input *= by.input;
}

std::string write_drive(const std::string& folder, const ToldDrive& drive) {
  const std::string path = folder + "/drive.yaml";
  std::ofstream(path) << "name: drive\nrecording:\n"
                      << reading_text(folder, drive) << "encoder: " << drive.encoder
                      << "\ncoordinates: " << drive.coordinates << "\nmodel:\n  parameters:\n"
                      << parameters_text(drive) << "  effects: " << drive.effects << "\nfit: " << drive.search
                      << "\ndiagnosis: {exclude: " << drive.candidates_left_out << "}\n";
  return path;
}

}  // namespace gapscope::metamorphic
