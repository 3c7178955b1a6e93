#include "commands/leave_one_out.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

/// What recordings can be told apart by.
struct GroupKey {
  const char* name;
  const char* unit;
  double (*value)(const RecordedFile& file, const Configuration& c);
};

double or_of_anchor(double own, const Configuration& c, double AnchorConfig::*member) {
  return std::isnan(own) && c.anchor ? (*c.anchor).*member : own;
}

constexpr GroupKey kKeys[] = {
    {"mass", " kg",
     [](const RecordedFile& f, const Configuration& c) {
       return or_of_anchor(f.mass, c, &AnchorConfig::mass);
     }},
    {"arm", " m",
     [](const RecordedFile& f, const Configuration& c) {
       return or_of_anchor(f.arm, c, &AnchorConfig::arm);
     }},
    {"gain", "", [](const RecordedFile& f, const Configuration&) { return f.gain_times; }},
    {"voltage", " V", [](const RecordedFile& f, const Configuration&) { return f.voltage; }},
};

std::vector<RecordedFile> all_files(const Configuration& c) {
  if (!c.recording)
    throw ConfigError(c.file, "has no recording: beside --leave-one-out, expected several of one drive");
  std::vector<RecordedFile> all = c.recording->files;
  all.insert(all.end(), c.recording->held_out.begin(), c.recording->held_out.end());
  return all;
}

std::vector<LeftOut> groups_by(const GroupKey& key, const Configuration& c) {
  std::map<double, LeftOut> groups;
  for (const RecordedFile& file : all_files(c)) {
    const double value = key.value(file, c);
    if (std::isnan(value))
      throw ConfigError(c.file, file.line,
                        fmt::format("{} has no {}, expected it of each recording beside --leave-one-out {}",
                                    file.given, key.name, key.name));
    LeftOut& group = groups[value];
    group.told = fmt::format("{} {:g}{}", key.name, value, key.unit);
    group.files.push_back(file);
  }
  std::vector<LeftOut> found;
  for (auto& [value, group] : groups) found.push_back(std::move(group));
  return found;
}

std::string numbers_of(const AddedEffect& added) {
  std::vector<std::string> numbers;
  for (const NamedValue& p : added.parameters) numbers.push_back(fmt::format("{} {:.4g}", p.key, p.value));
  return fmt::format("{} ({})", readable(added.effect), fmt::join(numbers, ", "));
}

std::string found_in(const Diagnosis& d) {
  std::vector<std::string> found;
  for (const AddedEffect& added : d.added) found.push_back(numbers_of(added));
  if (d.loop)
    for (const std::string& key : d.loop->added) found.push_back("in the loop " + key);
  return found.empty() ? "nothing" : fmt::format("{}", fmt::join(found, "; "));
}

}  // namespace

std::vector<LeftOut> groups_to_leave_out(const Configuration& c, const std::string& key) {
  std::vector<LeftOut> groups;
  const auto* by =
      std::find_if(std::begin(kKeys), std::end(kKeys), [&](const auto& k) { return key == k.name; });
  if (key == "recording")
    for (const RecordedFile& file : all_files(c)) groups.push_back({file.given, {file}});
  else if (by != std::end(kKeys))
    groups = groups_by(*by, c);
  else
    throw ConfigError(fmt::format(
        "gapscope: --leave-one-out is '{}', expected recording, mass, arm, gain or voltage", key));
  if (groups.size() < 2)
    throw ConfigError(c.file, fmt::format("has one {} alone, expected two or more to leave one out", key));
  return groups;
}

Configuration leaving_out(const Configuration& configuration, const LeftOut& left_out) {
  Configuration c = configuration;
  RecordingConfig& r = *c.recording;
  r.files.clear();
  for (const RecordedFile& file : all_files(configuration)) {
    const bool out = std::any_of(left_out.files.begin(), left_out.files.end(),
                                 [&](const RecordedFile& f) { return f.is_same_part(file); });
    if (!out) r.files.push_back(file);
  }
  r.held_out = left_out.files;
  return c;
}

Configuration of_all_recordings(Configuration c) {
  c.recording->files = all_files(c);
  c.recording->held_out.clear();
  return c;
}

LeftOutAnswer left_out_answer(const LeftOut& left_out, const DiagnosisOutcome& outcome) {
  const Diagnosis& d = outcome.result.diagnosis;
  LeftOutAnswer a{left_out, to_string(d.verdict), found_in(d), d.mismatch.before, d.mismatch.after};
  double sum = 0.0;
  for (const HeldOutRun& run : d.held_out_runs) {
    sum += run.mae;
    if (!(run.mae <= a.worst_mae)) a.worst = run.file, a.worst_mae = run.mae;
  }
  if (!d.held_out_runs.empty()) a.mae = sum / static_cast<double>(d.held_out_runs.size());
  return a;
}

std::string left_out_table(const std::vector<LeftOutAnswer>& answers) {
  std::size_t wide = 8;
  for (const LeftOutAnswer& a : answers) wide = std::max(wide, a.left_out.told.size());
  std::string table = fmt::format("{:<{}}  {:>12}  {:>12}  {:<8} {}\n", "left out", wide, "error (mrad)",
                                  "whole (mrad)", "verdict", "found");
  for (const LeftOutAnswer& a : answers)
    table += fmt::format("{:<{}}  {:>12.4g}  {:>12.4g}  {:<8} {}\n", a.left_out.told, wide, 1e3 * a.after,
                         1e3 * a.mae, a.verdict, a.found);
  return table;
}

std::string csv_of(const std::vector<LeftOutAnswer>& answers) {
  std::string csv =
      "left_out,recordings,verdict,before_rad,after_rad,whole_run_mae_rad,worst,worst_mae_rad,found\n";
  const auto number = [](double v) { return std::isfinite(v) ? fmt::format("{}", v) : std::string(); };
  for (const LeftOutAnswer& a : answers)
    csv += fmt::format("\"{}\",{},{},{},{},{},\"{}\",{},\"{}\"\n", a.left_out.told, a.left_out.files.size(),
                       a.verdict, number(a.before), number(a.after), number(a.mae), a.worst,
                       number(a.worst_mae), a.found);
  return csv;
}

std::string recommended(const std::vector<LeftOutAnswer>& answers) {
  const auto worse = [](const LeftOutAnswer& a, const LeftOutAnswer& b) {
    const auto size = [](const LeftOutAnswer& x) { return std::isfinite(x.mae) ? x.mae : x.after; };
    return size(a) < size(b);
  };
  const LeftOutAnswer& worst = *std::max_element(answers.begin(), answers.end(), worse);
  const bool whole = std::isfinite(worst.mae);
  return fmt::format(
      "fitted.yaml, fitted to all recordings: none of them is better known by leaving others out. What it is off "
      "on a recording that it has not seen is at most the worst line: {:.4g} mrad ({}), where {} was left out.",
      1e3 * (whole ? worst.mae : worst.after),
      whole ? "mean over whole recordings" : "free run of half a second", worst.left_out.told);
}

}  // namespace gapscope
