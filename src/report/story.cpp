#include "report/story.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/text.h"
#include "report/diagnosis_figures.h"
#include "report/markdown.h"
#include "report/wording.h"
#include "results/drive_card.h"

namespace gapscope::internal::report {
namespace {

struct Word {
  const char* occurs;  ///< what is looked for in the text
  const char* word;
  const char* meaning;
};

/// In the order in which a reader meets them.
constexpr Word kWords[] = {
    {"fitted model", "fitted model",
     "the model of the configuration, its free numbers fitted to the recording"},
    {"x1", "u, x1",
     "the recorded columns: input of the motor (in the unit that was declared), and its position"},
    {"set aside", "set aside", "of a passage: seen, but not used for the estimate"},
    {"passage", "passage", "the motor crosses the gap, from contact lost (t1) to contact regained (t2)"},
    {"e_x", "e_x, L",
     "position error of the super-twisting differentiator, and the bound on the acceleration that it is "
     "given: e_x rests near zero while the motion stays below L"},
    {"encoder floor", "encoder floor",
     "what the encoder leaves of the error of a perfect model: its quantum over √12, or its noise where that is more"},
    {"repeatability floor", "repeatability floor",
     "how far the drive repeats its own motion from one period of the input to the next (rms difference over "
     "√2): an error below it does not show in a recording like this"},
    {"| identifiable |", "identifiable",
     "the recordings determine this number; if not, its value is one of many"},
    {"Free run", "free run",
     "the fitted model under the recorded input from its initial state on, never corrected by the recording"},
    {"a fit of", "fit",
     "100·(1 − |x1 − model| / |x1 − mean|) of the free run (NRMSE), worst recording: 100 % is perfect, 0 no "
     "better than its mean"},
    {"prediction error", "prediction error",
     "what an observer, the model corrected by the encoder at every sample, still misses at the next one"},
    {"nominal model", "nominal model", "the model of the configuration, its estimated parameters fitted"},
    {"held-out", "held-out", "recorded, but seen by no fit (but for where a warning says so)"},
    {"free run restarted", "free run restarted",
     "the model runs alone for that long, then starts again from the state of an observer"},
    {"prediction at", "prediction at ... Hz",
     "what an observer with its poles there still misses at the next sample: slow drifts show at the lower, "
     "ripple at the higher one"},
    {"issing torque", "missing torque",
     "rms of the torque that the input applies and the model does not account for, on held-out data and "
     "below the frequency of the error budget (with no budget: the correcting torque): the torque on the card"},
    {"issing force", "missing force",
     "rms of the force that the input applies and the model does not account for, on held-out data and below "
     "the frequency of the error budget (with no budget: the correcting force): the force on the card"},
    {"orrecting torque", "correcting torque",
     "the torque that would correct an observer at 30 Hz, sample by sample: noise of the encoder is in it. "
     "Figures over time, position, speed and input show what of it is slow"},
    {"orrecting force", "correcting force",
     "the force that would correct an observer at 30 Hz, sample by sample: noise of the encoder is in it. "
     "Figures over time, position, speed and input show what of it is slow"},
    {"error removed", "error removed",
     "(error before − after) / (before − floor), as median over windows: 1 reaches the floor, below 0 it is worse"},
    {"explained share", "explained share",
     "share of the way to the floor in the mean logarithm of prediction and free-run error, which a few "
     "large errors cannot decide: 1 at the floor, below 0 worse than without; candidates are ranked by it, "
     "but a simple effect goes before one that contains it"},
    {"| windows better |", "windows better",
     "share of the held-out windows (half a second each, or less) above the floor in which its free run errs less"},
    {"not in the catalogue", "not in the catalogue",
     "none of the effects that `gapscope effects` lists is what is missing"},
    {"not separable from", "not separable from",
     "other effects that explain these recordings nearly as well: one of them may be the cause instead"},
    {"made superfluous", "made superfluous",
     "an earlier effect that was taken out again, because without it the model is hardly worse now"},
    {"over neighbouring periods", "over neighbouring periods",
     "its share of the squared torque or force, times what periods beside it have"},
    {"holds there", "holds there", "improves more held-out windows than chance would let, at 1 %"},
    {"biased by", "bias", "what the nominal model reads too high or too low to make up for what it lacks"},
    {"in engagement", "in engagement", "the contact is closed on either side: motor and load move as one"},
    {"stablished", "established",
     "of a cause: no other effect, and no free curve over another quantity, explains these recordings nearly "
     "as well; its amount is more than none, and the simulated motion comes nearer. *Established with* "
     "another: as long as that one, whose own cause is open, is in the model"},
    {"ikely, ", "likely",
     "of a cause: the balance of torque or force says so, and the simulated motion cannot decide"},
    {"(cause open)", "cause open",
     "not established: it accounts for its share of the error, but another cause may do so as well; the "
     "interval of its amount holds if it is there"},
    {" σ |", "σ", "rms of the encoder's noise"},
    {"if spread evenly", "if spread evenly",
     "the share that an error alike at all times would have: that of the time spent there"}};

/// "## Words": what the words of a report mean, those that occur in it; empty where none does.
std::string glossary_section(const std::string& text) {
  std::vector<std::string> lines;
  for (const Word& w : kWords)
    if (text.find(w.occurs) != std::string::npos)
      lines.push_back("*" + std::string(w.word) + "*: " + w.meaning + ".");
  return bullet_section("Words", lines);
}

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
