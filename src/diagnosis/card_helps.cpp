#include "diagnosis/card_helps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_cause.h"
#include "diagnosis/card_numbers.h"
#include "diagnosis/card_open.h"
#include "diagnosis/card_words.h"
#include "diagnosis/rule.h"
#include "diagnosis/words.h"
#include "gapscope/base/percents.h"
#include "gapscope/base/text.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

/// Whether the rung on which an effect was added stands behind a law that the model does not have: what is
/// left there is left with that law.
bool is_behind_another_law(const AddedEffect& a, const Diagnosis& d) {
  for (const BudgetRung& r : d.budget.rungs) {
    if (!(std::abs(r.after - a.after_torque) > 0.0)) return false;
    if (!r.added && !contains(d.effects, r.effect)) return true;
  }
  return false;
}

/// What the model with the effects up to each one leaves [N m]; NaN where the balance has no such model. With
/// the last one it is the model that was fitted.
std::vector<double> chain_of(const Diagnosis& d) {
  std::vector<double> left;
  for (const AddedEffect& a : d.added) left.push_back(is_behind_another_law(a, d) ? kNaN : a.after_torque);
  if (!left.empty() && d.budget.uncounted.empty() && d.added.back().share_of == ShareOf::kTorque)
    left.back() = d.mismatch.after_torque;
  return left;
}

/// "brings it from 46.3 to 25.5 mN·m", "cuts the free-run error by 64 %": on the basis that has decided.
std::string share_words(const AddedEffect& a, const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  if (!std::isfinite(a.shrink)) return "";
  if (a.share_of == ShareOf::kMotion)
    return fmt::format("cuts {}the {} by {} %", &a == d.added.data() ? "" : "what is left of ",
                       motion_error(d), percent_of_shrink(a.shrink));
  const std::vector<double> left = chain_of(d);
  const auto i = static_cast<std::size_t>(&a - d.added.data());
  const double before = i == 0 ? d.mismatch.before_torque : left[i - 1];
  if (!is_told_in_torque(d) || !d.budget.uncounted.empty() || !std::isfinite(before) ||
      !std::isfinite(left[i]))
    return "";
  const SharedUnit torque(before, f.coordinates.shown_unit("N m"));
  return fmt::format("brings it from {} to {}", torque.number(before), torque(left[i]));
}

/// Its period, unless its name has it, and how much there is of it.
std::vector<std::string> amounts_of(const AddedEffect& a, const Diagnosis& d, Coordinates coordinates,
                                    const std::string& name) {
  std::vector<std::string> all;
  const std::string period = period_words(a, coordinates);
  if (!period.empty() && !name.ends_with(period)) all.push_back(period.substr(1));
  if (const std::string amount = amount_of(a, d.added, coordinates); !amount.empty()) all.push_back(amount);
  return all;
}

/// "cogging torque (2 N; cuts the free-run error by 64 %)": what is known of it alone; an aside in its name
/// stands under the cause.
/// @param share  whether what it takes belongs to it, by what has decided on it: torque as the error budget
/// has it, or a share of the motion's error above the floor; where every effect has the torque that it
/// leaves, or is the only one, the fall beside it says that
std::string with_asides(const AddedEffect& a, const CardFacts& f, bool share) {
  const std::string name = without_asides(name_of(a, *f.diagnosis, f.coordinates));
  std::vector<std::string> asides = amounts_of(a, *f.diagnosis, f.coordinates, name);
  if (const std::string taken = share ? share_words(a, f) : ""; !taken.empty()) asides.push_back(taken);
  return name + (asides.empty() ? "" : fmt::format(" ({})", fmt::join(asides, "; ")));
}

/// "17.1 % to 2.2 % of what the input applies": on the basis of the line of the model's error
std::string percents(const CardFacts& f, const Card& card) {
  const double both[] = {card.percent, card.percent_after};
  const Percents percent(both);
  return percent(card.percent) + " to " + percent(card.percent_after) + " of what the " +
         what_applies(*f.diagnosis);
}

/// " (free run restarted every 0.5 s, median of windows)"; empty where no measure is told
std::string measure_aside(const MismatchSize& m) { return m.measure.empty() ? "" : " (" + m.measure + ")"; }

/// "from 371 to 0.427 µm (free run restarted every 0.5 s, median of windows)"
std::string fall_of_motion(const CardFacts& f) {
  const MismatchSize& m = f.diagnosis->mismatch;
  const SharedUnit error(m.before, f.coordinates.position_unit());
  return fmt::format("from {} to {}{}", error.number(m.before), error(m.after), measure_aside(m));
}

/// Whether the size in torque tells what is left: of windows that rest in their median it is none.
bool tells_torque(const Card& card) { return std::isfinite(card.torque) && card.torque_after > 0.0; }

/// "from 9.66 to 1.22 N (17.1 % to 2.16 % of what the input applies)"
std::string fall(const CardFacts& f, const Card& card) {
  if (tells_torque(card)) {
    const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
    return fmt::format("from {} to {} ({})", torque.number(card.torque), torque(card.torque_after),
                       percents(f, card));
  }
  return fall_of_motion(f);
}

/// What each effect leaves of the simulated motion, where the last one leaves what all of them do; else
/// empty.
std::vector<double> rungs_of_motion(const Diagnosis& d) {
  const MismatchSize& m = d.mismatch;
  std::vector<double> left;
  double now = m.before;
  for (const AddedEffect& a : d.added) {
    if (a.share_of != ShareOf::kMotion || !std::isfinite(a.shrink)) return {};
    left.push_back(now -= a.shrink * (now - m.floor));
  }
  const SharedUnit error(m.after, "");
  return left.size() > 1 && error.number(left.back()) == error.number(m.after) ? left : std::vector<double>();
}

/// "The free-run error (restarted every 0.5 s) falls from 138 mrad to 3 mrad with friction, then to 1 µrad
/// with ..."
std::string shares_of_motion(const CardFacts& f, const std::vector<double>& left) {
  const Diagnosis& d = *f.diagnosis;
  const auto motion = [&](double size) { return SharedUnit(size, f.coordinates.position_unit())(size); };
  std::vector<std::string> all;
  for (std::size_t i = 0; i < left.size(); ++i)
    all.push_back(motion(left[i]) + " with " + with_asides(d.added[i], f, false));
  return fmt::format("the {}{} falls from {} to {}", motion_error(d), measure_aside(d.mismatch),
                     motion(d.mismatch.before), fmt::join(all, ", then to "));
}

std::string shares(const CardFacts& f, const Card& card) {
  if (const std::vector<double> left = rungs_of_motion(*f.diagnosis); !left.empty() && !tells_torque(card))
    return shares_of_motion(f, left);
  std::vector<std::string> told;
  for (const AddedEffect& a : f.diagnosis->added)
    told.push_back(with_asides(a, f, f.diagnosis->added.size() > 1));
  return fmt::format(
      "{} {} the {} down {}", enumerated(told), told.size() > 1 ? "bring" : "brings",
      tells_torque(card) ? "missing " + std::string(f.coordinates.torque_word()) : motion_error(*f.diagnosis),
      fall(f, card));
}

/// Whether each effect has the torque that it leaves, and the last one that of the fitted model.
bool has_rungs(const Diagnosis& d) {
  if (d.added.size() < 2 || !d.budget.uncounted.empty()) return false;
  const std::vector<double> left = chain_of(d);
  const SharedUnit torque(d.mismatch.before_torque, "");
  return std::isfinite(d.mismatch.before_torque) &&
         torque.number(left.back()) == torque.number(d.mismatch.after_torque) &&
         std::ranges::all_of(left, [](double torque_left) { return std::isfinite(torque_left); });
}

/// "The missing force falls from 9.84 N to 4.19 N with friction, then to 2.20 N with cogging torque; in all
/// from 17.1 % to 3.8 % of what the input applies"
std::string rungs(const CardFacts& f, const Card& card) {
  const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
  const std::vector<double> left = chain_of(*f.diagnosis);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < left.size(); ++i)
    all.push_back(torque(left[i]) + " with " + with_asides(f.diagnosis->added[i], f, false));
  return fmt::format("the missing {} falls from {} to {}; in all from {}", f.coordinates.torque_word(),
                     torque(card.torque), fmt::join(all, ", then to "), percents(f, card));
}

/// Torque may fall and the simulated motion not: where inertia or stiffness is hardly known, for one.
std::string motion_words(const MismatchSize& m, Coordinates coordinates) {
  if (!(m.after >= m.before)) return "";
  const SharedUnit motion(m.before, coordinates.position_unit());
  return fmt::format("; but the simulated motion comes no nearer, {} off before and {} after ({})",
                     motion(m.before), motion(m.after), m.measure);
}

/// In torque against what no model gets below; else in the simulated motion.
std::string what_is_left(const CardFacts& f, const Card& card) {
  const MismatchSize& m = f.diagnosis->mismatch;
  const std::string floor_words = floor_of_the_motion(m);
  if (m.remains < kRule.floor_ratio) return "what is left does not show above " + floor_words;
  const ErrorBudget& b = f.diagnosis->budget;
  const double floor = b.exists() && b.uncounted.empty() && tells_torque(card) ? b.floor() : kNaN;
  if (floor > 0.0 && card.torque_after > kRule.floor_ratio * floor) {
    const SharedUnit torque(card.torque_after, f.coordinates.shown_unit("N m"));
    if (b.records >= floor)
      return fmt::format("of the {} left {} disagree by {}; the rest is not explained",
                         torque(card.torque_after), what_disagrees(*f.diagnosis), torque(floor));
    return fmt::format("of the {} left no model gets below {}; what is above that is not explained",
                       torque(card.torque_after), torque(floor));
  }
  return fmt::format("what is left, {} times {}, is not explained", SharedUnit(1.0, "").number(m.remains),
                     floor_words);
}

std::string law_words(const LastResortLaw& law, const Diagnosis& d) {
  return fmt::format("a free curve over the {} cuts the {}{} by {} % (compensation_{}.csv)", law.variable,
                     motion_error(d), law.on_top_of.empty() ? "" : " that is left",
                     percent_of_shrink(law.shrink), law.law);
}

}  // namespace

std::string helps_line(const CardFacts& f, const Card& card) {
  if (f.diagnosis == nullptr) return kToldByDiagnose;
  const Diagnosis& d = *f.diagnosis;
  if (d.verdict == DiagnosisVerdict::kNone) return other_numbers_help(f);
  std::vector<std::string> parts;
  if (!d.added.empty())
    parts.push_back((has_rungs(d) ? rungs(f, card) : shares(f, card)) + "; `fitted.yaml` has " +
                    (d.added.size() > 1 ? "them" : "it"));
  if (!d.added.empty()) parts.back() += motion_words(d.mismatch, f.coordinates);
  if (!d.added.empty() && d.laws.empty() && d.mismatch.remains > 0.0) parts.push_back(what_is_left(f, card));
  for (const LastResortLaw& law : d.laws) parts.push_back(law_words(law, d));
  if (parts.empty() && d.stopped) return "Not told: the search was stopped before its end.";
  if (parts.empty() && unestablished_rung(d) != nullptr)
    return "Nothing that these recordings establish; `fitted.yaml` has no addition.";
  if (parts.empty()) return "Nothing of the catalogue does.";
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " ") + as_sentence(part);
  return text;
}

std::string brief_helps(const CardFacts& f, const Card& card) {
  std::string text = without_asides(first_clause(helps_line(f, card)));
  if (f.diagnosis == nullptr || f.diagnosis->added.empty()) return text;
  const Diagnosis& d = *f.diagnosis;
  const bool is_noise = d.laws.empty() && d.mismatch.remains > 0.0 && d.mismatch.remains < kRule.floor_ratio;
  if (motion_words(d.mismatch, f.coordinates).empty()) {
    const bool varies = d.mismatch.floor_from == FloorSource::kRepeatability;
    if (is_noise)
      text.replace(
          text.size() - 1, 1,
          varies ? "; what is left is no more than the drive varies by itself." : "; what is left is noise.");
    else if (!tells_torque(card) && d.laws.empty() && d.mismatch.remains > 0.0)
      text.replace(text.size() - 1, 1, "; " + what_is_left(f, card) + ".");
    return text + briefly_refitted(f);
  }
  text.pop_back();
  return text + ", but the simulated motion comes no nearer.";
}

}  // namespace internal::diagnosis

std::string amount_words(const AddedEffect& added, const Diagnosis& diagnosis, Coordinates coordinates) {
  using namespace internal::diagnosis;
  const std::string name = without_asides(name_of(added, diagnosis, coordinates));
  std::string text = name.starts_with(readable(added.effect)) ? "" : "as " + name + ": ";
  text += fmt::format("{}", fmt::join(amounts_of(added, diagnosis, coordinates, ""), "; "));
  const std::vector<std::string> others = others_of(added, diagnosis);
  if (others.empty()) return text;
  return text + (text.empty() ? "" : "; ") + "it may as well be " + enumerated(others, "or");
}

}  // namespace gapscope
