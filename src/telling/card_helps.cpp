#include <algorithm>
#include <cmath>

#include "base/percents.h"
#include "base/shared_unit.h"
#include "base/text.h"
#include "diagnosis/numbers.h"
#include "diagnosis/rule.h"
#include "diagnosis/simulator.h"
#include "telling/card_lines.h"
#include "telling/names.h"

namespace gapscope::internal::telling {

using diagnosis::kRule;

bool tells_torque(const Card& card) { return std::isfinite(card.torque) && card.torque_after > 0.0; }

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

bool read_alike(double a, double b) {
  const SharedUnit ratio(1.0, "");
  return ratio.number(a) == ratio.number(b);
}

/// Whether each effect has the torque that it leaves, and the last one that of the fitted model.
bool has_rungs(const Diagnosis& d) {
  if (d.added.size() < 2 || !d.budget.uncounted.empty() || !std::isfinite(d.mismatch.before_torque))
    return false;
  const std::vector<double> left = chain_of(d);
  return std::ranges::all_of(left, [](double torque) { return std::isfinite(torque); }) &&
         read_alike(left.back() / d.mismatch.before_torque,
                    d.mismatch.after_torque / d.mismatch.before_torque);
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
  return left.size() > 1 && read_alike(left.back() / m.after, 1.0) ? left : std::vector<double>();
}

/// "4 N with motor Coulomb friction (4 N, 95 %: 3.9 to 4.1)", one for each effect.
Fact rungs(const CardFacts& f, const std::vector<double>& left, const std::string& unit) {
  std::vector<ToldName> all;
  for (std::size_t i = 0; i < left.size(); ++i) {
    ToldName told = with_amount(f.diagnosis->added[i], *f.diagnosis, f.coordinates, "");
    told.name = SharedUnit(left[i], f.coordinates.shown_unit(unit))(left[i]) + " with " + told.name;
    all.push_back(std::move(told));
  }
  return names("left", std::move(all));
}

/// What a single effect of several takes, where no rungs say it: "cuts the free-run error by 64 %".
std::string share_of(const AddedEffect& a, const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  if (d.added.size() < 2 || !std::isfinite(a.shrink)) return "";
  const std::vector<double> left = chain_of(d);
  const auto i = static_cast<std::size_t>(&a - d.added.data());
  const double before = i == 0 ? d.mismatch.before_torque : left[i - 1];
  const bool torque = a.share_of == ShareOf::kTorque && is_told_in_torque(d) && d.budget.uncounted.empty();
  if (a.share_of == ShareOf::kMotion)
    return as_clause({i == 0 ? "share.motion" : "share.motion.left",
                      {error_word(d), per_cent("share", 100.0 * std::min(a.shrink, 1.0))}},
                     f.coordinates);
  if (!torque || !std::isfinite(before) || !std::isfinite(left[i])) return "";
  return as_clause({"share.torque", {number("before", before, "N m"), number("after", left[i], "N m")}},
                   f.coordinates);
}

/// How the additions shrink what was missing.
Statement fall(const CardFacts& f, const Card& card) {
  const Diagnosis& d = *f.diagnosis;
  const MismatchSize& m = d.mismatch;
  const Fact share = per_cent("share", card.percent), after = per_cent("share_after", card.percent_after);
  if (has_rungs(d))
    return {
        "helps.rungs",
        {number("before", card.torque, "N m"), rungs(f, chain_of(d), "N m"), share, after, source_word(d)}};
  if (const std::vector<double> left = rungs_of_motion(d); !left.empty() && !tells_torque(card))
    return {"helps.motion_rungs",
            {error_word(d), number("before", m.before, "rad"), rungs(f, left, "rad"),
             word("measure", m.measure)}};
  std::vector<ToldName> told;
  for (const AddedEffect& a : d.added) told.push_back(with_amount(a, d, f.coordinates, share_of(a, f)));
  if (tells_torque(card))
    return {"helps.torque",
            {names("added", std::move(told)), number("before", card.torque, "N m"),
             number("after", card.torque_after, "N m"), share, after, source_word(d)}};
  return {"helps.motion",
          {names("added", std::move(told)), error_word(d), number("before", m.before, "rad"),
           number("after", m.after, "rad"), word("measure", m.measure)}};
}

/// In torque against what no model gets below; else in the simulated motion.
Statement what_is_left(const CardFacts& f, const Card& card) {
  const Diagnosis& d = *f.diagnosis;
  const MismatchSize& m = d.mismatch;
  if (m.remains < kRule.floor_ratio)
    return {m.floor_from == FloorSource::kRepeatability ? "helps.left.varies" : "helps.left.noise"};
  const ErrorBudget& b = d.budget;
  const double floor = b.exists() && b.uncounted.empty() && tells_torque(card) ? b.floor() : kNaN;
  if (floor > 0.0 && card.torque_after > kRule.floor_ratio * floor)
    return {b.records >= floor ? "helps.left.records" : "helps.left.floor",
            {number("left", card.torque_after, "N m"), number("floor", floor, "N m"), parts_word(d)}};
  return {tells_torque(card) ? "helps.left.torque" : "helps.left.motion",
          {ratio("times", m.remains), floor_of_the_motion(m)}};
}

/// Torque may fall and the simulated motion not: where inertia or stiffness is hardly known, for one.
bool comes_no_nearer(const MismatchSize& m) { return m.after >= m.before; }

Told of_laws(const Diagnosis& d) {
  Told told;
  for (const LastResortLaw& law : d.laws)
    told.push_back({"helps.law",
                    {word("variable", law.variable), error_word(d), word("law", law.law),
                     per_cent("share", 100.0 * std::min(law.shrink, 1.0))}});
  return told;
}

/// What the fit has moved of the user's own numbers.
Told numbers(const CardFacts& f, const char* code, std::size_t most) {
  const std::vector<ChangedNumber> changed = changed_numbers(*f.diagnosis, f.coordinates);
  if (changed.empty()) return {};
  Told told = {{code, {briefly_changed(changed), changed_in_full(changed, most)}}};
  for (Statement& s : scaled_numbers(*f.diagnosis)) told.push_back(std::move(s));
  return told;
}

Told of_simulator(const CardFacts& f) {
  const std::size_t rows = differing_rows(f.simulated);
  if (rows == 0) return {};
  const SimulatorErrors& e = f.simulated->errors;
  const double mended = f.simulated->shrink > 0.0 ? e.mended : kNaN;
  const double all = rows > 1 && e.all_mended < e.stand_in ? e.all_mended : kNaN;
  if (std::isnan(mended) && std::isnan(all)) return {};
  return {{"helps.simulator",
           {number("error", e.stand_in, "rad"), number("mended", mended, "rad"),
            word("first", readable(f.simulated->rows.front().name)), number("all_mended", all, "rad"),
            ratio("rows", static_cast<double>(rows))}}};
}

/// Where no effect is missing: nothing, or other numbers, of the model and of the user's simulator.
Told other_numbers(const CardFacts& f) {
  Told told = numbers(f, "helps.as_good.other_numbers", 3);
  if (told.empty()) told = {{"helps.as_good"}};
  for (Statement& s : of_simulator(f)) told.push_back(std::move(s));
  return told;
}

}  // namespace

Told helps_of(const CardFacts& f, const Card& card) {
  if (f.diagnosis == nullptr) return {{"by_diagnose"}};
  const Diagnosis& d = *f.diagnosis;
  if (d.verdict == DiagnosisVerdict::kNone) return other_numbers(f);
  Told told;
  const auto put = [&](Told more) { told.insert(told.end(), more.begin(), more.end()); };
  if (!d.added.empty()) {
    put({fall(f, card), {"helps.fitted", {added_names(d)}}});
    if (comes_no_nearer(d.mismatch) && !d.loop)
      put({{"helps.no_nearer",
            {number("before", d.mismatch.before, "rad"), number("after", d.mismatch.after, "rad"),
             word("measure", d.mismatch.measure)}}});
    else if (d.laws.empty() && d.mismatch.remains > 0.0)
      put({what_is_left(f, card)});
  }
  put(of_laws(d));
  if (told.empty() && d.loop && !d.loop->added.empty() && d.closed_loop)
    return {{"helps.loop",
             {number("before", d.closed_loop->before, "rad"), number("after", d.closed_loop->after, "rad")}}};
  if (told.empty())
    return {{d.stopped                      ? "helps.stopped"
             : suspected_rung(d) != nullptr ? "helps.not_established"
                                            : "helps.none"}};
  if (!d.added.empty() && !d.stopped) put(numbers(f, "helps.numbers", 2));
  return told;
}

}  // namespace gapscope::internal::telling
