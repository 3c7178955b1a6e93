// `export`: the drive in the format of a simulator, with a certificate.
#include "commands/export.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/console.h"
#include "config/joint_numbers.h"

namespace gapscope::cli {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  ConfigArguments source;
  std::string format, folder;
  std::string into, joint;  ///< a model that has the joint already
  bool quiet = false;
};

/// "exact: gap, ...": the parts of one fidelity.
void say_parts(const char* what, Fidelity fidelity, const Certificate& c) {
  std::string names;
  for (const CarriedPart& part : c.parts)
    if (part.fidelity == fidelity) names += (names.empty() ? "" : ", ") + part.part;
  if (!names.empty()) say(what, names);
}

void export_configuration(const ExportArguments& a, const Configuration& c) {
  ReportFolder report(a.folder, FolderKind::kExport, source_paths(c));
  progress_on_terminal(a.quiet)("exporting " + c.name);
  std::optional<JointNumbers> own;
  if (!a.into.empty()) own = joint_numbers(a.into, a.joint);
  DriveExport drive = export_drive(c, export_format(a.format), own);
  if (a.source.model_from.empty()) tell_in_head(left_unexplained(a.source.file), drive);
  write_export(report, drive);
  print_warnings(drive.certificate.warnings);
  for (const ExportedFile& file : drive.files) say("written", (fs::path(a.folder) / file.name).string());
  say("certificate", (fs::path(a.folder) / "certificate.md").string());
  if (!drive.certificate.own_file.empty()) say("to paste", drive.certificate.own_file);
  say_parts("exact", Fidelity::kExact, drive.certificate);
  say_parts("approximate", Fidelity::kApproximate, drive.certificate);
  say_parts("left out", Fidelity::kLeftOut, drive.certificate);
}

std::string format_help() {
  std::string text = "Formats:\n";
  for (const ExportFormatSpec& f : export_formats()) text += fmt::format("  {:<6} {}\n", f.name, f.doc);
  return text;
}

}  // namespace

void add_drive_export(CommandLine& app) {
  auto arguments = std::make_shared<ExportArguments>();
  CommandLine command = app.add_command("export", "The fitted drive for a simulator, with a certificate");
  std::vector<std::string> words;
  for (const ExportFormatSpec& f : export_formats()) words.emplace_back(f.name);
  add_config_arguments(command, arguments->source, "SOURCE",
                       "report folder of run, fit or diagnose (its fitted.yaml), or a configuration (YAML)");
  command.add_option("--to", arguments->format, "format of the simulator")
      .required()
      .value("FORMAT")
      .one_of(words);
  command.add_option("-o,--output", arguments->folder, "folder for the model and its certificate")
      .required()
      .value("DIR");
  Option into = command
                    .add_option("--into", arguments->into,
                                "MJCF that has the joint already: the numbers to paste are printed for it")
                    .value("MODEL");
  Option joint =
      command.add_option("--joint", arguments->joint, "joint in it that is the drive").value("NAME");
  into.needs(joint);
  joint.needs(into);
  command.add_flag("--quiet", arguments->quiet, "no progress");
  command.footer(
      format_help() +
      "Writes the model, certificate.md and certificate.json (rad, s; rad means m on a translational axis).\n"
      "The certificate says of every number and effect whether the target has it exactly, approximately or not\n"
      "and why; how far the target's x1 is from gapscope's simulator under the same input at several steps;\n"
      "the largest stable step; and what the format's own defaults would do. What a diagnosis in SOURCE\n"
      "left unexplained is stated there and in the head of the model.\n"
      "SOURCE with recording: needs every number of its model, and is judged under the recorded input; a\n"
      "fitted.yaml under that of its trace (after diagnose: of what was held out), for the first 10 s.\n"
      "DIR may be empty, new, or hold an earlier export that was not changed since.\n\n"
      "Example: gapscope export reports/drive --to mjcf -o drive_mjcf");
  command.action([arguments] {
    const ConfigArguments source{exported_configuration(arguments->source.file), arguments->source.set,
                                 arguments->source.model_from};
    with_simulated_drive(source, [&](const Configuration& c) { export_configuration(*arguments, c); });
  });
}

}  // namespace gapscope::cli
