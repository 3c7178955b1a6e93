#include "commands/export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "base/interrupt.h"
#include "base/percents.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "gapscope/telling/card.h"
#include "results/diagnosis_result.h"
#include "results/run_result.h"

namespace gapscope {
namespace {

/// Of the floor: what is no more than that no model explains. As in the verdicts of a diagnosis.
constexpr double kAtFloor = 1.3;

std::string unexplained_in(const DiagnosisResult& r) {
  const Diagnosis& d = r.diagnosis;
  const MismatchSize& size = d.mismatch;
  const bool unknown = d.verdict == DiagnosisVerdict::kUnknown;
  if (d.verdict == DiagnosisVerdict::kNone || !(size.after_torque > 0.0)) return "";
  const bool by_torque = std::isfinite(size.floor_torque);  // of one balance; else by the motion
  const double left = by_torque ? size.after_torque / size.floor_torque : size.remains;
  if (!unknown && std::min(left, size.remains) <= kAtFloor) return "";  // the motion shows none of it
  const Coordinates& c = r.coordinates;
  const std::string_view why = unknown ? "which its diagnosis found missing and could not explain"
                                       : "which the diagnosis did not explain";
  const std::string_view model =
      unknown ? "This model" : "This model, with all that its diagnosis added, still";
  if (!is_told_in_torque(d))
    return fmt::format("{} misses {:.3g} {} of what was held out ({}), {}.", model, size.after,
                       c.position_unit(), size.measure, why);
  const double percent = 100.0 * size.after_torque / size.input_torque;
  return fmt::format("{} lacks {:.3g} {} rms of {} on what was held out ({} of what the input brings), {}.",
                     model, size.after_torque, c.torque_unit(), c.torque_word(),
                     Percents({&percent, 1})(percent), why);
}

std::string rejected_in(const RunResult& r) {
  if (!r.reference || !r.reference->rejected()) return "";
  return "The fit of this model is rejected, so its numbers are not those of the drive. " +
         r.reference->why.text();
}

/// Behind the first comment of a file: where that ends, and how another one is written.
struct HeadComment {
  const char *ends, *begins, *closes;
};

/// By the ending of the file's name; nothing: such a file has no comments.
const HeadComment* head_comment(const std::string& file) {
  static constexpr HeadComment kXml{"-->\n", "<!-- ", " -->\n"}, kC{"*/\n", "/* ", " */\n"},
      kPython{"\n", "# ", "\n"};
  if (file.ends_with(".h")) return &kC;
  if (file.ends_with(".py")) return &kPython;
  return file.ends_with(".json") ? nullptr : &kXml;
}

}  // namespace

std::string left_unexplained(const std::string& source) {
  namespace fs = std::filesystem;
  const bool folder = fs::is_directory(source);
  if (!folder && fs::path(source).filename() != "fitted.yaml") return "";
  const std::string of = folder ? source : fs::path(source).parent_path().string();
  const std::string report = of.empty() ? "." : of;
  try {
    if (fs::exists(fs::path(report) / "diagnosis.json")) return unexplained_in(read_diagnosis_result(report));
    return fs::exists(fs::path(report) / "result.json") ? rejected_in(read_run_result(report)) : "";
  } catch (const ConfigError&) {
    return "";  // of another version: the model can be exported all the same
  }
}

void tell_in_head(const std::string& sentence, DriveExport& drive) {
  if (sentence.empty()) return;
  drive.certificate.warnings.push_back(sentence);
  for (ExportedFile& file : drive.files) {
    const HeadComment* comment = head_comment(file.name);
    const auto end = comment == nullptr ? file.text.npos : file.text.find(comment->ends);
    if (end == file.text.npos) continue;
    file.text.insert(end + std::string(comment->ends).size(), comment->begins + sentence + comment->closes);
  }
}

std::string exported_configuration(const std::string& source) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(source)) return source;
  const std::string fitted = (fs::path(source) / "fitted.yaml").string();
  if (!fs::exists(fitted))
    throw ConfigError(source, "holds no fitted.yaml, expected the report folder of run, fit or diagnose");
  return fitted;
}

ExportFormat export_format(const std::string& word) {
  std::vector<std::string> words;
  for (const ExportFormatSpec& format : export_formats()) {
    if (format.name == word) return format.format;
    words.emplace_back(format.name);
  }
  throw ConfigError(
      fmt::format("gapscope: --to is {}, expected one of {}", shown(word), fmt::join(words, ", ")));
}

std::vector<TextFile> export_texts(const DriveExport& drive) {
  std::vector<TextFile> texts;
  for (const ExportedFile& file : drive.files) texts.push_back({file.name, file.text});
  texts.push_back({"certificate.md", certificate_text(drive.certificate)});
  texts.push_back({"certificate.json", certificate_json(drive.certificate)});
  return texts;
}

void write_export(ReportFolder& report, const DriveExport& drive) {
  write_texts(report.path(), export_texts(drive));
  stop_point();
  report.commit();
}

}  // namespace gapscope
