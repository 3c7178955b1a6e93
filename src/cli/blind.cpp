// `blind`: the check of the diagnosis on recordings whose effects it is not told.
#include <fmt/format.h>

#include <memory>

#include "base/interrupt.h"
#include "blind/blind_check.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "gapscope/base/errors.h"
#include "report/blind_report.h"
#include "results/blind_files.h"
#include "results/blind_score.h"
#include "results/report_folder.h"

namespace gapscope::cli {
namespace {

struct BlindArguments {
  std::string config, cases, labels, answers, folder, seal;
  int threads = 0;
  bool quiet = false;
};

/// "case 3 of 40"
BlindProgress counted(const Progress& progress, const char* what) {
  return [progress, what](std::size_t done, std::size_t all) {
    progress(fmt::format("{} {} of {}", what, done, all));
  };
}

void add_handing_out_options(CommandLine& command, const std::shared_ptr<BlindArguments>& a) {
  command.add_option("-o,--output", a->cases, "folder of the recordings, to be handed out")
      .required()
      .value("DIR");
  command.add_option("--labels", a->labels, "file of the labels, to be kept").required().value("FILE");
  add_work_options(command, a->threads, a->quiet);
}

void say_handed_out(const BlindArguments& a) {
  say("cases", fmt::format("{} in {}", read_blind_labels(a.labels).cases.size(), a.cases));
  say("labels", a.labels + " (not to be handed out before the answers are in)");
}

void make(const BlindArguments& a) {
  const BlindConfig config = load_blind_config(a.config);
  make_blind_check(config, a.cases, a.labels, a.threads, counted(progress_on_terminal(a.quiet), "made case"));
  say_handed_out(a);
}

void add_make(CommandLine& blind) {
  auto a = std::make_shared<BlindArguments>();
  CommandLine command = blind.add_command("make", "Makes recordings and seals what they hide");
  command.add_option("CONFIG", a->config, "of the check (YAML)").required();
  add_handing_out_options(command, a);
  command.footer(
      "Keys of a check:\n"
      "  name         of the check (default: of the file)\n"
      "  report       the cases that are counted: {first_seed, known, outside, none, pairs}\n"
      "  calibration  the same of those that the probabilities are calibrated on, from other seeds\n"
      "  rigs         of [paper, geared, heavy] (default: all)\n"
      "  duration     of each recording [s] (default: 6)\n"
      "  plant        independent (default), or mujoco: MuJoCo's engine moves the drives, where it was there "
      "(libmujoco-dev)\n"
      "               when gapscope was built; it has seven of the catalogue's effects, and none outside\n\n"
      "Writes per case <case>_train.csv, <case>_held_out.csv (t [s], u, x1 [rad]) and <case>.yaml, a data sheet off by\n"
      "up to 20 %, and manifest.json: SHA-256 of every file and, salted, of every label. All follows from the seeds:\n"
      "keep them from everybody from whom the labels are kept.\n\n"
      "Example: gapscope blind make my_check.yaml -o cases --labels labels.json");
  command.action([a] { make(*a); });
}

void put_in(const BlindArguments& a) {
  const Configuration config = load_configuration(a.config);
  const Progress progress = progress_on_terminal(a.quiet);
  make_implanted_check(config, a.cases, a.labels, a.threads, counted(progress, "made case"), progress);
  say_handed_out(a);
}

void add_implant(CommandLine& blind) {
  auto a = std::make_shared<BlindArguments>();
  CommandLine command = blind.add_command("implant", "Puts known effects into one's own recordings");
  command.add_option("CONFIG", a->config, "of the drive (YAML), as for `gapscope diagnose`").required();
  add_handing_out_options(command, a);
  command.footer(
      "A recorded drive obeyed m a = Km u + rest. Under u' = u - torque/Km the same motion is that of a drive\n"
      "which has the torque, too, with all its real noise and whatever else it has. Effects of the command are\n"
      "put into u by the inverse of their law, those of the encoder into x1; what acts behind a contact cannot\n"
      "be implanted exactly and is refused. The recordings are diagnosed as they are first: effects that the\n"
      "drive has anyway are not implanted. Begin with the model that a diagnosis has fitted.\n\n"
      "Keys of implant: (all have defaults)\n"
      "  first_seed  of the cases (default: 1)\n"
      "  known       cases with an effect of the catalogue (24)\n"
      "  outside     cases with another: a stray sine, knocks, noise of the input, lost counts (4)\n"
      "  none        cases without an implant (1)\n"
      "  sizes       rms of the effect's torque over that of the input's ([0.05, 0.1, 0.2])\n"
      "  effects     of `gapscope effects` (default: all that can be implanted)\n\n"
      "Writes per case its recordings (CSV: t [s], u, x1 [rad]), <case>.yaml and manifest.json. Labels follow\n"
      "from the seeds and the recordings: keep both from everybody from whom the labels are kept.\n\n"
      "Example: gapscope blind implant axis.yaml -o cases --labels labels.json");
  command.action([a] { put_in(*a); });
}

void add_seal(CommandLine& blind) {
  auto a = std::make_shared<BlindArguments>();
  CommandLine command = blind.add_command("seal", "Seals own recordings and labels");
  command.add_option("CASES", a->cases, "folder of sheets and recordings").required();
  command.add_option("LABELS", a->labels, "file of the labels (JSON)").required();
  command.footer(
      "CASES holds <case>.yaml, a configuration for `gapscope diagnose`, and the recordings that it names.\n"
      "LABELS is {\"schema\": \"gapscope.blind_labels/1\", \"name\": ..., \"cases\": [...]}, of each case\n"
      "  name             \"axis_3\": letters, digits, _ and -\n"
      "  part             \"report\", or \"calibration\" for cases that the probabilities are calibrated on\n"
      "  effects          [] for none, one or two of `gapscope effects`, or any other word: outside the catalogue\n"
      "  rig              of which drive it is; counts are given for each\n"
      "  severity         0 weak to 1 strong, or null\n"
      "  cycles_per_turn  of one effect that repeats with the motor angle, or null\n"
      "  seed             \"\" for a recording\n"
      "  salt             at least 16 characters that nobody guesses\n"
      "Writes CASES/manifest.json, which shows nothing of the labels but salted hashes.\n\n"
      "Example: gapscope blind seal cases labels.json");
  command.action([a] {
    const BlindManifest manifest = seal_blind_check(a->cases, a->labels);
    say("sealed", fmt::format("{} cases in {}/manifest.json", manifest.cases.size(), a->cases));
  });
}

void answer(const BlindArguments& a) {
  const BlindAnswers answers = answer_blind_check(a.cases, a.answers, a.threads,
                                                  counted(progress_on_terminal(a.quiet), "answered case"));
  say("answers", fmt::format("{} in {}", answers.cases.size(), a.answers));
  say("seal", answers.seal());
}

void add_answer(CommandLine& blind) {
  auto a = std::make_shared<BlindArguments>();
  CommandLine command = blind.add_command("answer", "Diagnoses sealed recordings and seals the answers");
  command.add_option("CASES", a->cases, "folder with a manifest.json").required();
  command.add_option("-o,--output", a->answers, "file of the answers (JSON)").required().value("FILE");
  add_work_options(command, a->threads, a->quiet);
  command.footer(
      "Sees the sheets and recordings of CASES and nothing else. Stopped or killed, the same command goes on.\n"
      "The seal depends on every recording and every answer: pass it on before the labels are opened.\n\n"
      "Example: gapscope blind answer cases -o answers.json");
  command.action([a] { answer(*a); });
}

void write_score(ReportFolder& report, const std::string& folder, const BlindScore& score) {
  write_blind_score(report.path(), score);
  if (!score.configuration.empty()) write_text(report.path() + "/resolved.yaml", score.configuration);
  write_blind_report(report.path());
  stop_point();
  report.commit();
  say("report", folder + "/report.md");
  for (const BlindCount& c : score.counts)
    fmt::print("{:<56}{:4} of {:4} = {:5.1f} %  [{:.1f}, {:.1f}]\n", c.name, c.count, c.of, 100.0 * c.share(),
               100.0 * c.limits().low, 100.0 * c.limits().high);
}

void add_score(CommandLine& blind) {
  auto a = std::make_shared<BlindArguments>();
  CommandLine command = blind.add_command("score", "Opens the labels and scores the answers");
  command.add_option("CASES", a->cases, "folder with a manifest.json").required();
  command.add_option("LABELS", a->labels, "file of the labels").required();
  command.add_option("ANSWERS", a->answers, "file of the answers").required();
  command.add_option("-o,--output", a->folder, "folder of the report (default: reports/<name>)").value("DIR");
  const Option seal =
      command.add_option("--seal", a->seal, "that the answers were announced with").value("SHA256");
  command.footer(
      "Refuses a recording, a label or an answer that is not the one that was sealed. Writes "
      "DIR/blind.json,\n"
      "report.md and figures (PNG). Sizes of mismatch are in floors.\n\n"
      "Example: gapscope blind score cases labels.json answers.json -o reports/check");
  command.action([a, seal] {
    if (seal.given() && a->seal.size() != 64)
      throw ConfigError(fmt::format(
          "gapscope: --seal is '{}', expected the 64 digits that `blind answer` printed", a->seal));
    const BlindScore score = score_blind_check(a->cases, a->labels, a->answers, a->seal);
    const std::string folder = a->folder.empty() ? "reports/" + score.name : a->folder;
    ReportFolder report(folder, FolderKind::kBlind, {a->labels, a->answers});
    write_score(report, folder, score);
  });
}

void run_implants(const BlindArguments& a) {
  const Configuration config = load_configuration(a.config);
  const std::string folder = a.folder.empty() ? "reports/" + config.name : a.folder;
  ReportFolder report(folder, FolderKind::kBlind, {a.config});
  const Progress progress = progress_on_terminal(a.quiet);
  write_score(report, folder,
              run_implanted_check(config, folder, a.threads, counted(progress, "made case"),
                                  counted(progress, "answered case"), progress));
}

void add_whole(CommandLine& blind) {
  auto a = std::make_shared<BlindArguments>();
  CommandLine command = blind.add_command("run", "Makes, answers and scores a check in one folder");
  command.add_option("CONFIG", a->config, "of the check (YAML): of `blind make` or `blind implant`")
      .required();
  command.add_option("-o,--output", a->folder, "folder (default: reports/<name>)").value("DIR");
  add_work_options(command, a->threads, a->quiet);
  command.footer(
      "Writes DIR/cases, labels.json, answers.json, blind.json, report.md and figures (PNG). Stopped or "
      "killed, the same\n"
      "command goes on.\n\n"
      "Example: gapscope blind run configs/07_blind.yaml -o reports/blind");
  command.action([a] {
    if (names_recordings(a->config)) return run_implants(*a);
    const BlindConfig config = load_blind_config(a->config);
    const std::string folder = a->folder.empty() ? "reports/" + config.name : a->folder;
    ReportFolder report(folder, FolderKind::kBlind, {a->config});
    const Progress progress = progress_on_terminal(a->quiet);
    write_score(report, folder,
                run_blind_check(config, folder, a->threads, counted(progress, "made case"),
                                counted(progress, "answered case")));
  });
}

}  // namespace

void add_blind(CommandLine& app) {
  CommandLine command =
      app.add_command("blind", "The blind check of the diagnosis, and recordings of random drives");
  command.needs_command();
  command.footer("Example: gapscope blind run configs/07_blind.yaml -o reports/blind");
  add_make(command);
  add_implant(command);
  add_seal(command);
  add_answer(command);
  add_score(command);
  add_whole(command);
  add_blind_drives(command);
}

}  // namespace gapscope::cli
