#include "cli/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>
#include <string_view>

#include "base/decimals.h"
#include "base/now_and_then.h"
#include "base/shell_word.h"

namespace gapscope::cli {
namespace {

constexpr std::chrono::seconds kSeldom{30};  ///< between two lines of progress in a log

void line(const char* what, const std::string& text) { fmt::print("{:<12}{}\n", what, text); }

/// Decimals that show two digits of the interval's half width, all in thousandths.
int decimals(const Interval& ci95) {
  const double half = 1e3 * (ci95.high - ci95.low) / 2.0;
  return half > 0.0 ? static_cast<int>(std::clamp(1.0 - std::floor(std::log10(half)), 0.0, 5.0)) : 4;
}

std::string estimate(double value, const Interval& ci95, Coordinates coordinates) {
  if (std::isnan(ci95.low))
    return fmt::format("{:<17} {:<22}", coordinates.thousandths(value), "no interval");
  const int d = decimals(ci95);
  return fmt::format("{:<17} {:<22}", with_decimals(1e3 * value, d) + " m" + coordinates.position_unit(),
                     "[" + with_decimals(1e3 * ci95.low, d) + ", " + with_decimals(1e3 * ci95.high, d) + "]");
}

/// "19 events": those that are used.
std::string evidence(const GapEstimate& g) {
  return fmt::format("{} events", std::ranges::count_if(g.events, &GapEvent::accepted));
}

std::string model_free_line(const GapEstimate& g, Coordinates coordinates) {
  if (g.verdict == GapVerdict::kBacklash)
    return fmt::format("{} {} ({}, {})", estimate(g.gap, g.ci95, coordinates),
                       g.quantity == GapQuantity::kPlayAtZeroTorque ? "play at zero torque"
                       : g.quantity == GapQuantity::kFirstGap       ? "backlash, the first gap"
                                                                    : "backlash",
                       to_string(g.method), evidence(g));
  if (g.verdict == GapVerdict::kNone)
    return fmt::format("none: a gap above {} would have shown", coordinates.thousandths(g.none_above()));
  const bool bound = g.verdict == GapVerdict::kInconclusive && std::isfinite(g.gap_at_most);
  return fmt::format("{}: {}{}", to_string(g.verdict), g.reason.text(),
                     bound ? "; a gap is at most " + coordinates.thousandths(g.gap_at_most) + " wide" : "");
}

std::string lost_motion_line(const LostMotion& m, Coordinates coordinates) {
  std::string text = estimate(m.value, m.ci95, coordinates) + " ";
  for (const LostMotionLevel& level : m.levels)
    if (m.levels.size() > 1)
      text += fmt::format("{} after ramps to ±{:.3g}{}", coordinates.thousandths(level.lost_motion),
                          level.amplitude, &level == &m.levels.back() ? "; " : ", ");
  return text + m.meaning.text();
}

std::string reference_line(const FitSummary& f, Coordinates coordinates) {
  const std::string quality = fmt::format("{}, rmse {}", f.converged() ? "converged" : "not converged",
                                          coordinates.thousandths(f.rmse));
  const FittedParameter* gap = f.find("gap");
  if (f.closes_gap())
    return "does as well with its gap closed, which does not say that the drive has none (" + quality + ")";
  if (f.rejected())
    return fmt::format("rejected: {}{}", f.why.text(),
                       gap == nullptr || !gap->estimated || std::isnan(gap->value)
                           ? ""
                           : fmt::format(" ({} not to be believed)", coordinates.thousandths(gap->value)));
  if (gap == nullptr) return "no gap in this model (" + quality + ")";
  if (!gap->estimated) return fmt::format("{} fixed ({})", coordinates.thousandths(gap->value), quality);
  if (!gap->identifiable)
    return fmt::format("{} not identifiable ({})", coordinates.thousandths(gap->value), quality);
  return fmt::format("{} {}", estimate(gap->value, f.shown_interval(*gap), coordinates), quality);
}

/// Every number that the fit found, but for the gap.
void print_parameters(const FitSummary& f, const InputFacts& input, Coordinates coordinates) {
  std::size_t width = 23;
  for (const FittedParameter& p : f.parameters) width = std::max(width, p.key.size());
  for (const FittedParameter& p : f.parameters) {
    if (!p.estimated || p.key == "gap") continue;
    const std::string unit =
        p.unit == "-" ? "" : " " + with_input_unit(coordinates.shown_unit(p.unit), input);
    const std::string interval = f.rejected()      ? "model rejected"
                                 : !p.identifiable ? "not identifiable"
                                 : std::isnan(f.shown_interval(p).low)
                                     ? "no interval"
                                     : fmt::format("[{:.4g}, {:.4g}]", p.ci95.low, p.ci95.high);
    fmt::print("  {:<{}} {:<17} {}{}\n", p.key, width, fmt::format("{:.4g}{}", p.value, unit), interval,
               p.at_bound ? ", at its bound" : "");
  }
}

std::string comparison_line(const Comparison& c, Coordinates coordinates) {
  if (std::isnan(c.difference)) return "-";
  const std::string difference = coordinates.thousandths(c.difference);
  if (!c.agree) return fmt::format("{:<17} not comparable: an interval is missing", difference);
  return fmt::format("{:<17} {} (joint standard error {})", difference, *c.agree ? "agree" : "disagree",
                     coordinates.thousandths(c.joint_std));
}

/// The encoder on the load, which was not fitted.
std::string validation_line(const RunResult& r) {
  const SecondEncoder& s = *r.second_encoder;
  return fmt::format("{:<17} rms error of x2, which was not fitted (x1: {}; its encoder leaves {})",
                     r.coordinates.thousandths(s.rmse), r.coordinates.thousandths(s.motor_rmse),
                     r.coordinates.thousandths(s.floor));
}

/// A word in a command that is told, and what it stands for.
struct Placeholder {
  std::string_view word;
  std::string stands_for;    ///< empty: not known, the word stays
  std::string options = "";  ///< that follow it, as a shell takes them
};

bool is_end(char c) { return c == ' ' || c == '`'; }

/// The placeholder that begins here: none within a longer word.
const Placeholder* begun_at(const std::string& text, std::size_t at, std::span<const Placeholder> all) {
  if (at == 0 || !is_end(text[at - 1])) return nullptr;
  for (const Placeholder& p : all) {
    const std::size_t end = at + p.word.size();
    const bool whole = end >= text.size() || is_end(text[end]) || text[end] == '/' || text[end] == '_';
    if (!p.stands_for.empty() && whole && text.compare(at, p.word.size(), p.word) == 0) return &p;
  }
  return nullptr;
}

/// "`gapscope export DIR`", "`DIR/fitted.yaml`" and "`gapscope run CONFIG`" as a shell takes them.
std::string filled_in(const std::string& text, std::span<const Placeholder> all) {
  std::string told;
  for (std::size_t at = 0; at < text.size();) {
    const Placeholder* p = begun_at(text, at, all);
    if (p == nullptr) {
      told += text[at++];
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" `", at), text.size());
    told +=
        shell_word(p->stands_for + text.substr(at + p->word.size(), end - at - p->word.size())) + p->options;
    at = end;
  }
  return told;
}

/// What everybody wants to know, last: it is what stays in view.
/// @param folder  of the report
void print_card(const Card& card, const ToldConfiguration& c, const std::string& folder) {
  for (const CardLine& l : card.lines()) {
    if (!card.diagnosed && (&l.text == &card.place || &l.text == &card.cause || &l.text == &card.helps))
      continue;           // what is next leads there
    const bool goes_on =  // and names a folder of its own
        &l.text == &card.next && (card.asks("next.go_on") || card.asks("next.read_gap"));
    const Placeholder all[] = {
        {"DIR", folder},
        {"CONFIG", c.to_begin.empty() ? c.file : "", c.settings + (goes_on ? "" : c.model + c.folder)}};
    line(l.name, filled_in(l.brief, all));
  }
  if (!card.diagnosed && !c.to_begin.empty())
    line("CONFIG",
         "has a model, which was not given here; `gapscope init " + c.to_begin + "` writes a first one.");
}

}  // namespace

std::string stopwatch(double seconds) {
  const auto s = static_cast<long>(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

Progress progress_on_terminal(bool quiet) {
  using Clock = std::chrono::steady_clock;
  if (quiet) return [](const std::string&) {};
  const auto tell = [begin = Clock::now()](const std::string& what) {
    const std::chrono::duration<double> so_far = Clock::now() - begin;
    fmt::print(stderr, "{:>5}  {} ...\n", stopwatch(so_far.count()), what);
  };
  if (isatty(STDERR_FILENO) != 0) return tell;
  const auto seldom = std::make_shared<NowAndThen>(kSeldom, tell);
  return [seldom](const std::string& what) { seldom->begins(what); };
}

void say(const char* what, const std::string& text) { fmt::print("{:<12}{}\n", what, text); }

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

void print_headline(const std::string& folder, const RunResult& r, const ToldConfiguration& configuration) {
  line("report", folder);
  if (r.model_free) line("model-free", model_free_line(*r.model_free, r.coordinates));
  if (r.model_free && r.model_free->lost_motion.read())
    line("lost motion", lost_motion_line(r.model_free->lost_motion, r.coordinates));
  if (r.literal) line("literal", model_free_line(*r.literal, r.coordinates));
  if (r.reference) line("fitted", reference_line(*r.reference, r.coordinates));
  if (r.reference && !r.model_free)
    print_parameters(*r.reference, r.input.value_or(InputFacts{}), r.coordinates);
  if (r.comparison && std::isfinite(r.comparison->difference))
    line("difference", comparison_line(*r.comparison, r.coordinates));
  if (r.comparison && !std::isnan(r.comparison->map_width))
    line("load side", fmt::format("{:<17} width of the x1-x2 map, of both encoders",
                                  r.coordinates.thousandths(r.comparison->map_width)));
  if (r.second_encoder && !std::isnan(r.second_encoder->rmse)) line("validation", validation_line(r));
  if (!std::isnan(r.simulated_gap))
    line("simulated", fmt::format("{:<17} the gap that the recording was simulated with",
                                  r.coordinates.thousandths(r.simulated_gap)));
  if (r.answer) print_card(r.answer->card, configuration, folder);
}

namespace {

/// How much there is of an effect; one that was found several times has a line for each.
/// @param before  how often its name has been told
std::string amount_told(const std::string& effect, std::ptrdiff_t before, const DiagnosisResult& r) {
  for (const AddedEffect& a : r.diagnosis.added)
    if (a.effect == effect && before-- == 0)
      return with_input_unit(amount_words(a, r.diagnosis, r.coordinates), r.input.value_or(InputFacts{}));
  return "";
}

/// A line for each effect, amounts below each other.
void print_effects(const DiagnosisResult& r) {
  const std::vector<std::string>& effects = r.diagnosis.effects;
  std::size_t width = 0;
  for (const std::string& effect : effects) width = std::max(width, effect.size());
  for (auto e = effects.begin(); e != effects.end(); ++e) {
    const std::string amount = amount_told(*e, std::count(effects.begin(), e, *e), r);
    line("effect", amount.empty() ? *e : fmt::format("{:<{}}{}", *e, width + 2, amount));
  }
}

}  // namespace

void print_diagnosis(const std::string& folder, const DiagnosisResult& r,
                     const ToldConfiguration& configuration) {
  line("report", folder);
  line("verdict", verdict_words(r.diagnosis, r.coordinates));
  print_effects(r);
  if (r.simulated) line("simulator", r.simulated->sentence);
  if (r.answer) print_card(r.answer->card, configuration, folder);
  line("more", "Amounts, reasons and limits: " + folder + "/report.html");
}

}  // namespace gapscope::cli
