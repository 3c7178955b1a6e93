#include "report/story.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "base/text.h"
#include "report/diagnosis_figures.h"
#include "report/glossary.h"
#include "report/markdown.h"
#include "report/wording.h"
#include "results/drive_card.h"

namespace gapscope::internal::report {
namespace {

const std::string& name_of(const DriveStory& s) { return s.run ? s.run->name : s.diagnosis->name; }

/// Where that file lies is nothing that a report knows: it has the same bytes wherever it is made, and goes
/// on by mail.
constexpr const char* kWhatConfigIs =
    "\nCONFIG is the YAML that this report was made from. `resolved.yaml`, beside this report, does the same "
    "where it is laid into the folder of that YAML, as paths in it begin there.\n";

/// Of both, each once.
std::vector<std::string> all_warnings(const DriveStory& s) {
  std::vector<std::string> all;
  if (s.run) all = warnings_of(*s.run, s.diagnosis);
  if (!s.diagnosis) return all;
  for (const std::string& warning : s.diagnosis->diagnosis.warnings)
    if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
  return all;
}

constexpr std::array kTitles = {"Gap", "Model error", "Where", "Cause", "What helps", "Next step"};

/// The lines that have more to say than the brief ones.
std::string card_in_full(const Card& card) {
  std::string text;
  std::size_t i = 0;
  for (const CardLine& line : card.lines()) {
    const char* const title = kTitles[i++];
    if (line.text != line.brief) text += fmt::format("- **{}:** {}\n", title, typeset(line.text));
  }
  return text.empty() ? "" : "\n## The card in full\n\n" + text;
}

/// What stands for a name in the commands of a text that none before it had.
std::string placeholders_of(const std::string& text, const std::string& before) {
  const auto begins = [&](const char* word) {
    return text.find(word) != text.npos && before.find(word) == before.npos;
  };
  return std::string(begins(" CONFIG") ? kWhatConfigIs : "") +
         (begins("DIR") ? "\nDIR is the folder of this report.\n" : "");
}

}  // namespace

std::string card_text(const Card& card) {
  std::string text = "\n";
  std::size_t i = 0;
  for (const CardLine& line : card.lines()) {
    const char* const title = kTitles[i++];
    if (!card.diagnosed &&
        (&line.text == &card.place || &line.text == &card.cause || &line.text == &card.helps))
      continue;  // what is next leads there
    text += fmt::format("- **{}:** {}\n", title, typeset(line.brief));
  }
  const std::string full = card_in_full(card);
  return text + placeholders_of(text, "") + full + placeholders_of(full, text);
}

namespace {

/// How far the gap is to be trusted.
Badge badge_of(const Answer& a) {
  if (a.trust == AnswerTrust::kGood) return {"good", "gap: good"};
  return a.trust == AnswerTrust::kLimited ? Badge{"limited", "gap: limited"}
                                          : Badge{"open", "gap: not known"};
}

/// How far a diagnosis goes.
Badge badge_of(const Card& card, const Diagnosis& d) {
  if (card.asks("next.do_not_rely") || card.asks("next.no_nearer"))
    return {"bad", "model: do not rely on it yet"};
  if (d.verdict == DiagnosisVerdict::kNone) return {"good", "model: nothing missing"};
  if (d.verdict == DiagnosisVerdict::kHelps) return {"limited", "cause: open"};
  if (d.verdict != DiagnosisVerdict::kEffect) return {"open", "cause: not known"};
  const bool sure = contains(card.codes.cause, "cause.established");
  return {sure ? "good" : "limited", sure ? "cause: established" : "cause: likely"};
}

/// "train.csv, 25 s": the recordings, and how long they are in all.
std::string recordings_of(const RunResult& run) {
  std::vector<std::string> files;
  double seconds = 0.0;
  for (const Recording& r : run.recordings) {
    files.push_back("`" + r.file + "`");
    seconds += r.dt * static_cast<double>(r.position().size());
  }
  return files.empty() ? "" : fmt::format("{}, {:.3g} s · ", fmt::join(files, ", "), seconds);
}

std::string recordings_of(const Diagnosis& d) {
  std::vector<std::string> files;
  for (const MismatchTrace& t : d.traces) files.push_back("`" + t.file + "`");
  return files.empty() ? "" : fmt::format("held out: {} · ", fmt::join(files, ", "));
}

/// Of these the first that there is.
std::string carrying_picture(const DriveStory& s) {
  for (const char* file :
       {"diagnosis_traces.png", "lost_motion_loop.png", "reversal_shelf.png", "overview.png"})
    for (const FigureData& figure : s.figures)
      if (figure.file == file && figure.missing.empty()) return file;
  return "";
}

}  // namespace

PageHead head_of(const DriveStory& s) {
  const Card card = drive_card(s.run, s.diagnosis);
  PageHead head{name_of(s)};
  head.about = (s.run ? recordings_of(*s.run) : "") +
               (s.diagnosis ? recordings_of(s.diagnosis->diagnosis) : "") + "gapscope " +
               (s.run ? s.run->version : s.diagnosis->version);
  if (const auto& answer = s.run ? s.run->answer : s.diagnosis->answer)
    head.badges.push_back(badge_of(*answer));
  if (s.diagnosis) head.badges.push_back(badge_of(card, s.diagnosis->diagnosis));
  head.carrying = carrying_picture(s);
  return head;
}

std::string story_text(const DriveStory& s) {
  std::string text = "# " + name_of(s) + "\n";
  if (!s.note.empty()) text += "\n> " + s.note + "\n";
  for (const std::string& line : s.run ? s.run->simulated_data : s.diagnosis->simulated_data)
    text += "\n> " + line + "\n";
  text += card_text(drive_card(s.run, s.diagnosis));
  std::string detail = bullet_section("Warnings", all_warnings(s));
  if (s.run) detail += estimate_text(*s.run, s.timing, s.diagnosis);
  if (s.diagnosis) detail += diagnosis_text(*s.diagnosis);
  detail += figure_section(s.figures);
  if (s.run) detail += bullet_section("Notes", notes_of(*s.run));
  const std::string words = glossary_section(text + detail);
  if (!words.empty()) text += "\nTerms are explained under [Words](#words).\n";
  const std::optional<InputFacts>& input = s.run ? s.run->input : s.diagnosis->input;
  return with_input_unit(text + detail + words, input.value_or(InputFacts{})) +
         fmt::format("\ngapscope {}\n", (s.run ? s.run->version : s.diagnosis->version));
}

}  // namespace gapscope::internal::report
