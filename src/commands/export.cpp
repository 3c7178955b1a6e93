#include "gapscope/commands/export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "gapscope/base/errors.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/shown.h"

namespace gapscope {

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
