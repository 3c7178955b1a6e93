#include "diagnosis/card_cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "diagnosis/card_numbers.h"
#include "diagnosis/card_open.h"
#include "diagnosis/card_words.h"
#include "diagnosis/words.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/simulator.h"

namespace gapscope::internal::diagnosis {
namespace {

std::string called(const AddedEffect& a, const CardFacts& f) {
  return name_of(a, *f.diagnosis, f.coordinates);
}

std::vector<std::string> names(const CardFacts& f, bool established) {
  std::vector<std::string> all;
  for (const AddedEffect& a : f.diagnosis->added)
    if (a.established == established && (!established || others_of(a, *f.diagnosis).empty()))
      all.push_back(called(a, f));
  return all;
}

/// "either cogging torque or load unbalance is missing (these recordings cannot tell which; `fitted.yaml` has
/// cogging torque)", of every group that holds a cause.
std::vector<std::string> groups(const CardFacts& f, const std::string& missing) {
  std::vector<std::string> all;
  for (const AddedEffect& a : f.diagnosis->added) {
    std::vector<std::string> others = others_of(a, *f.diagnosis);
    if (!a.established || others.empty()) continue;
    others.insert(others.begin(), called(a, f));
    const bool two = others.size() == 2;
    all.push_back(fmt::format("{} {} {} ({}; `fitted.yaml` has {})", two ? "either" : "one of",
                              enumerated(others, two ? "or" : "and"), missing,
                              which_is_open(a.group, *f.diagnosis), called(a, f)));
  }
  return all;
}

/// " Established: motor Coulomb friction. One of input delay and actuator lag is missing, too (...).":
/// causes, with which evidence does not bear them out, and what they rest on where that is open.
std::string established_causes(const CardFacts& f) {
  const std::vector<std::string> alone = names(f, true);
  const std::string rest = !rests_on_open_cause(*f.diagnosis) ? ""
                           : names(f, false).size() > 1       ? "with them in the model"
                                                              : "with it in the model";
  const std::string doubt = brief_doubt(*f.diagnosis, f.coordinates);
  std::string text;
  if (!alone.empty())
    text = fmt::format(" {}{}: {}.", doubt.empty() ? "Established" : doubt,
                       rest.empty() ? "" : (doubt.empty() ? " " : ", ") + rest, enumerated(alone));
  const std::string before = !alone.empty() || rest.empty() ? "" : rest + ", ";
  const std::string verb = doubt.empty() ? "is " : "may be ";
  const std::string missing = !rest.empty() && doubt.empty()  ? "is still missing"
                              : alone.empty() && rest.empty() ? verb + "missing"
                                                              : verb + "missing, too";
  for (const std::string& group : groups(f, missing)) text += " " + as_sentence(before + group);
  return text;
}

/// "cogging torque (why)"; an aside that ends the words goes on with it.
std::string with_aside(std::string words, const std::string& aside) {
  if (aside.empty()) return words;
  if (!words.ends_with(')')) return words + " (" + aside + ")";
  words.pop_back();
  return words + "; " + aside + ")";
}

/// " Not established, though it helps: input delay (it may as well be actuator lag).", of what has an open
/// cause, with why it is, told once where that is the same of all.
/// @param brief  without why, but for what else it may be, and without how much a cause has to take
std::string open_causes(const CardFacts& f, bool brief) {
  std::vector<std::string> open, why;
  for (const AddedEffect& a : f.diagnosis->added) {
    if (a.established) continue;
    std::vector<std::string> any = brief ? others_of(a, *f.diagnosis) : std::vector<std::string>{};
    any.insert(any.begin(), called(a, f));
    open.push_back(enumerated(any, "or"));
    why.push_back(why_open(a, *f.diagnosis));
  }
  if (open.empty()) return "";
  const bool alike = std::ranges::all_of(why, [&](const std::string& w) { return w == why.front(); });
  const std::string& first = why.front();
  const bool each = open.size() > 1 && first.starts_with("it ");
  if (alike)
    open.back() = with_aside(open.back(), each ? "each" + first.substr(2) : first);
  else
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = with_aside(open[i], why[i]);
  return fmt::format(" Not established, though {}: {}.{}", open.size() > 1 ? "they help" : "it helps",
                     enumerated(open), brief ? "" : least_of_a_cause(why));
}

/// That the cause, where none is established, is more likely outside of the catalogue; probabilities were
/// learned where the candidates' own refits decide, above the encoder's floor.
std::string outside_words(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  const bool learned = d.mismatch.floor_from != FloorSource::kRepeatability && !d.ranking.empty() &&
                       !d.effects.empty() && d.ranking.front().effect == d.effects.front();
  if (!established_causes(f).empty() || !learned || !(d.outside_probability > 0.5)) return "";
  return fmt::format(" Most likely ({:.0f} %) the cause is none of the catalogue's.",
                     100.0 * d.outside_probability);
}

/// "Your simulator has no cogging torque, the drive has (8 mN·m)" of "it has no ...".
std::string of_your_simulator(const std::string& row) {
  if (row.starts_with("its ")) return "Your simulator's" + row.substr(3);
  return row.starts_with("it ") ? "Your simulator" + row.substr(2) : row;
}

/// The row that takes most of the simulator's error; where none differs, the first sentence of the whole.
std::string simulator_words(const SimulatorComparison* c) {
  if (c == nullptr) return "";
  if (c->rows.empty() || !c->rows.front().differs)
    return " " + as_sentence(c->sentence.substr(0, c->sentence.find(". ")));
  const auto differing =
      std::count_if(c->rows.begin(), c->rows.end(), [](const SimulatorRow& r) { return r.differs; });
  const std::string others = differing < 2    ? ""
                             : differing == 2 ? "; one more row differs"
                                              : fmt::format("; {} more rows differ", differing - 1);
  return " " + as_sentence(of_your_simulator(c->rows.front().sentence) + others);
}

/// The line, or the same without why.
std::string cause_of(const CardFacts& f, bool brief) {
  if (f.diagnosis == nullptr) return kToldByDiagnose;
  const Diagnosis& d = *f.diagnosis;
  const std::string simulator = simulator_words(f.simulated);
  if (d.verdict == DiagnosisVerdict::kNone)
    return (refitted_words(d, f.coordinates, kToldNumbers).empty()
                ? "Nothing is missing that this recording could show."
                : "No effect is missing that this recording could show; only numbers of the configuration "
                  "were off, and are fitted now.") +
           simulator;
  std::string text = established_causes(f), then = open_causes(f, brief);
  if (text.empty() && then.empty() && d.stopped)
    return "Not told: the search was stopped before its end." + simulator;
  if (rests_on_open_cause(d)) std::swap(text, then);
  text += then;
  if (brief) text = without_asides(text);
  if (text.empty()) text = " " + as_sentence(brief ? first_clause(unknown_words(f), ":") : unknown_words(f));
  return text.substr(1) + outside_words(f) + exhausted_words(d) + simulator;
}

}  // namespace

std::string cause_line(const CardFacts& f) { return cause_of(f, false); }
std::string brief_cause(const CardFacts& f) { return cause_of(f, true); }

}  // namespace gapscope::internal::diagnosis

namespace gapscope {

std::string verdict_words(const Diagnosis& d, Coordinates coordinates) {
  using internal::diagnosis::brief_doubt;
  std::string doubt = internal::diagnosis::without_asides(brief_doubt(d, coordinates));
  if (!doubt.empty())
    doubt.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(doubt.front())));
  std::string how;
  if (d.verdict == DiagnosisVerdict::kEffect)
    how = "missing in the model: " + (doubt.empty() ? "established" : doubt);
  if (d.verdict == DiagnosisVerdict::kHelps) how = "the error falls, but no cause is established";
  if (d.verdict == DiagnosisVerdict::kNone) how = "nothing is missing in the model";
  if (d.verdict == DiagnosisVerdict::kUnknown && d.stopped) how = "the search was stopped before its end";
  return to_string(d.verdict) + (how.empty() ? "" : " (" + how + ")");
}

}  // namespace gapscope
