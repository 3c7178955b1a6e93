#include "diagnosis/card_cause.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "diagnosis/card_numbers.h"
#include "diagnosis/card_open.h"
#include "diagnosis/card_words.h"
#include "diagnosis/effect_starts.h"
#include "diagnosis/words.h"
#include "gapscope/base/decimals.h"
#include "gapscope/base/percents.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/simulator.h"

namespace gapscope::internal::diagnosis {
namespace {

std::string called(const AddedEffect& a, const CardFacts& f) {
  return name_of(a, *f.diagnosis, f.coordinates);
}

/// What the recordings cannot tell from an effect, but for what was added as well.
std::vector<std::string> others_of(const AddedEffect& a, const Diagnosis& d) {
  std::vector<std::string> all;
  for (const std::string& other : a.group)
    if (other != a.effect && !contains(d.effects, other)) all.push_back(readable(other));
  return all;
}

/// A line holds so many effects; the table of what was added holds all.
constexpr std::size_t kToldEffects = 4;

/// How many of them are told one by one: all, or one less than fit beside "and N more".
std::size_t told_of(std::size_t count) { return count > kToldEffects ? kToldEffects - 1 : count; }

/// With the first of them and "5 more" for the rest.
std::vector<std::string> shortened(std::vector<std::string> all) {
  const std::size_t told = told_of(all.size());
  if (told == all.size()) return all;
  const std::size_t more = all.size() - told;
  all.resize(told);
  all.push_back(fmt::format("{} more", more));
  return all;
}

std::vector<std::string> names(const CardFacts& f, bool established) {
  std::vector<std::string> all;
  for (const AddedEffect& a : f.diagnosis->added)
    if (a.established == established && (!established || others_of(a, *f.diagnosis).empty()))
      all.push_back(called(a, f));
  return all;
}

/// "cogging torque or load unbalance: these recordings cannot tell them apart", of every group that holds a
/// cause.
std::vector<std::string> groups(const CardFacts& f) {
  std::vector<std::string> all;
  for (const AddedEffect& a : f.diagnosis->added) {
    std::vector<std::string> others = others_of(a, *f.diagnosis);
    if (!a.established || others.empty()) continue;
    others.insert(others.begin(), called(a, f));
    all.push_back(enumerated(shortened(others), "or") + ": these recordings cannot tell them apart");
  }
  return all;
}

/// Rivals of what was added with an open cause.
std::vector<std::string> rivals(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const AddedEffect& a : d.added)
    for (const std::string& rival : a.group)
      if (!a.established && rival != a.effect && !contains(d.effects, rival) &&
          !contains(all, readable(rival)))
        all.push_back(readable(rival));
  return all;
}

/// "friction (established)", with which evidence does not bear it out; on top of what is open, with what else
/// that holds.
std::string established_causes(const CardFacts& f) {
  const std::vector<std::string> causes = names(f, true);
  const std::string doubt = doubt_of_motion(*f.diagnosis);
  std::string text;
  if (!causes.empty()) {
    text = enumerated(shortened(causes));
    text = !rests_on_open_cause(*f.diagnosis) ? text + " (established" + doubt + ")"
                                              : fmt::format("with {} in the model, {} {} established{}",
                                                            names(f, false).size() > 1 ? "them" : "it", text,
                                                            causes.size() > 1 ? "are" : "is", doubt);
  }
  for (const std::string& group : groups(f))
    text += (text.empty() ? "" : "; ") + group +
            (causes.empty() && !doubt.empty() ? " (established" + doubt + ")" : "");
  return text;
}

std::string open_causes(const CardFacts& f) {
  const std::vector<std::string> open = names(f, false), others = rivals(*f.diagnosis);
  if (open.empty()) return "";
  const bool beside = !established_causes(f).empty() && !rests_on_open_cause(*f.diagnosis);
  const std::string too = beside ? " too" : "";
  std::vector<std::string> why;
  if (!others.empty()) why.push_back("it may as well be " + enumerated(shortened(others), "or"));
  if (std::string words = undetermined_words(*f.diagnosis); !words.empty()) why.push_back(std::move(words));
  return enumerated(shortened(open)) +
         (open.size() > 1 ? " help" + too + ", but whether they are the cause"
                          : " helps" + too + ", but whether it is the cause") +
         " is open" + (why.empty() ? "" : fmt::format(": {}", fmt::join(why, ", and ")));
}

/// That the cause, where none is established, is more likely outside of the catalogue; probabilities were
/// learned where the candidates' own refits decide, above the encoder's floor.
std::string outside_words(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  const bool learned = d.mismatch.floor_from != FloorSource::kRepeatability && !d.ranking.empty() &&
                       !d.effects.empty() && d.ranking.front().effect == d.effects.front();
  if (!established_causes(f).empty() || !learned || !(d.outside_probability > 0.5)) return "";
  return fmt::format("; most likely ({:.0f} %) the cause is none of the catalogue's",
                     100.0 * d.outside_probability);
}

/// "takes it from 46.3 to 25.5 mN·m", "takes 64 % of the free-run error": on the basis that has decided.
std::string share_words(const AddedEffect& a, const CardFacts& f) {
  if (!std::isfinite(a.shrink)) return "";
  if (a.share_of == ShareOf::kMotion)
    return fmt::format("takes {} % of the {}", with_decimals(100.0 * a.shrink, 0),
                       motion_error(*f.diagnosis));
  const auto& rungs = f.diagnosis->budget.rungs;
  const auto at = std::find_if(rungs.begin(), rungs.end(), [&](const BudgetRung& r) {
    return r.effect == a.effect && !(std::abs(r.after - a.after_torque) > 0.0);
  });
  if (at == rungs.end()) return "";
  const SharedUnit torque(at->before, f.coordinates.shown_unit("N m"));
  return fmt::format("takes it from {} to {}", torque.number(at->before), torque(at->after));
}

/// "cogging torque (2 N; takes 64 % of the free-run error)": what is known of it alone; an aside in its name
/// stands under the cause.
/// @param share  whether what it takes belongs to it, by what has decided on it: torque as the error budget
/// has it, or a share of the motion's error above the floor; where every effect has the torque that it
/// leaves, or is the only one, the fall beside it says that
std::string with_asides(const AddedEffect& a, const CardFacts& f, bool share) {
  std::vector<std::string> asides;
  if (const std::string amount = amount_of(a, f.diagnosis->added, f.coordinates); !amount.empty())
    asides.push_back(amount);
  if (const std::string taken = share ? share_words(a, f) : ""; !taken.empty()) asides.push_back(taken);
  return without_asides(called(a, f)) + (asides.empty() ? "" : fmt::format(" ({})", fmt::join(asides, "; ")));
}

/// "17.1 % to 2.2 % of the input's": on the basis of the line of the model's error
std::string percents(const Card& card) {
  const double both[] = {card.percent, card.percent_after};
  const Percents percent(both);
  return percent(card.percent) + " to " + percent(card.percent_after) + " of the input's";
}

/// "from 9.66 to 1.22 N (17.1 % to 2.16 % of the input's)"
std::string fall(const CardFacts& f, const Card& card) {
  const MismatchSize& m = f.diagnosis->mismatch;
  if (std::isfinite(card.torque) && std::isfinite(card.torque_after)) {
    const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
    return fmt::format("from {} to {} ({})", torque.number(card.torque), torque(card.torque_after),
                       percents(card));
  }
  const SharedUnit error(m.before, f.coordinates.position_unit());
  return fmt::format("from {} to {}", error.number(m.before), error(m.after));
}

/// Whether the torque that is told has an effect in it.
bool is_counted(const AddedEffect& a, const Diagnosis& d) { return !contains(d.budget.uncounted, a.effect); }

std::string shares(const CardFacts& f, const Card& card) {
  std::vector<std::string> all, others;
  const auto& added = f.diagnosis->added;
  for (const AddedEffect& a : added)
    (is_counted(a, *f.diagnosis) ? all : others).push_back(with_asides(a, f, added.size() > 1));
  std::string text;
  if (!all.empty())
    text =
        fmt::format("{} {} the {} down {}", enumerated(shortened(all)), all.size() > 1 ? "bring" : "brings",
                    std::isfinite(card.torque) ? "missing " + std::string(f.coordinates.torque_word())
                                               : motion_error(*f.diagnosis),
                    fall(f, card));
  if (others.empty()) return text;
  return text + (text.empty() ? "" : "; ") + enumerated(shortened(others)) +
         (others.size() > 1 ? " help" : " helps") + " the simulated motion, and no size of " +
         (others.size() > 1 ? "them" : "it") + " in " + f.coordinates.torque_word() + " is known";
}

/// Whether each effect has the torque that it leaves, and the last one that of the fitted model.
bool has_rungs(const Diagnosis& d) {
  if (d.added.size() < 2 || !d.budget.uncounted.empty()) return false;
  const SharedUnit torque(d.mismatch.before_torque, "");  // a law that cannot be added may stand between them
  return std::isfinite(d.mismatch.before_torque) &&
         torque.number(d.added.back().after_torque) == torque.number(d.mismatch.after_torque) &&
         std::all_of(d.added.begin(), d.added.end(),
                     [](const AddedEffect& a) { return std::isfinite(a.after_torque); });
}

/// "The missing force falls from 9.84 N to 4.19 N with friction, then to 2.20 N with cogging torque (17.1 %
/// to 3.8 % of the input's)"
std::string rungs(const CardFacts& f, const Card& card) {
  const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
  std::vector<std::string> all;
  const auto& added = f.diagnosis->added;
  for (const AddedEffect& a : std::span(added).first(told_of(added.size())))
    all.push_back(torque(a.after_torque) + " with " + with_asides(a, f, false));
  if (const std::size_t more = added.size() - all.size(); more > 0)
    all.push_back(torque(added.back().after_torque) + fmt::format(" with {} more", more));
  return fmt::format("the missing {} falls from {} to {} ({})", f.coordinates.torque_word(),
                     torque(card.torque), fmt::join(all, ", then to "), percents(card));
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

/// Torque may fall and the simulated motion not: where inertia or stiffness is hardly known, for one.
std::string motion_words(const MismatchSize& m, Coordinates coordinates) {
  if (!(m.after >= m.before)) return "";
  const SharedUnit motion(m.before, coordinates.position_unit());
  return fmt::format("; but the simulated motion comes no nearer, {} off before and {} after ({})",
                     motion(m.before), motion(m.after), m.measure);
}

std::string law_words(const LastResortLaw& law, const Diagnosis& d) {
  return fmt::format("a free curve over the {} takes {} % of the {}{} (compensation_{}.csv)", law.variable,
                     with_decimals(100.0 * law.shrink, 0), motion_error(d),
                     law.on_top_of.empty() ? "" : " that is left", law.law);
}

}  // namespace

std::string cause_line(const CardFacts& f) {
  if (f.diagnosis == nullptr) return kToldByDiagnose;
  const Diagnosis& d = *f.diagnosis;
  const std::string simulator = simulator_words(f.simulated);
  if (d.verdict == DiagnosisVerdict::kNone)
    return (refitted_words(d, f.coordinates, kToldNumbers).empty()
                ? "Nothing is missing that this recording could show."
                : "No effect is missing that this recording could show; the drive has other numbers than the "
                  "configuration starts at.") +
           simulator;
  std::string text = established_causes(f), then = open_causes(f);
  if (text.empty() && then.empty() && d.stopped)
    return "Not told: the search was stopped before its end." + simulator;
  if (rests_on_open_cause(d)) std::swap(text, then);
  text += (text.empty() || then.empty() ? "" : "; ") + then + outside_words(f);
  return as_sentence(text.empty() ? unknown_words(f) : text) + exhausted_words(d) + simulator;
}

std::string helps_line(const CardFacts& f, const Card& card) {
  if (f.diagnosis == nullptr) return kToldByDiagnose;
  const Diagnosis& d = *f.diagnosis;
  if (d.verdict == DiagnosisVerdict::kNone) return other_numbers_help(f);
  std::vector<std::string> parts;
  if (!d.added.empty())
    parts.push_back((has_rungs(d) ? rungs(f, card) : shares(f, card)) + "; `fitted.yaml` has " +
                    (d.added.size() > 1 ? "them" : "it"));
  if (!d.added.empty()) parts.back() += motion_words(d.mismatch, f.coordinates);
  for (const LastResortLaw& law : d.laws) parts.push_back(law_words(law, d));
  if (parts.empty() && d.stopped) return "Not told: the search was stopped before its end.";
  if (parts.empty() && unestablished_rung(d) != nullptr) return "Nothing that these recordings establish.";
  if (parts.empty()) return "Nothing of the catalogue does.";
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " ") + as_sentence(part);
  return text;
}

}  // namespace gapscope::internal::diagnosis
