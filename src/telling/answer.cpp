#include "telling/answer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "gapscope/reference/fit.h"

namespace gapscope {
namespace {

/// The fit ends with the gap closed, and without a model none is seen either.
bool none_by_both(const Findings& f) {
  return f.reference != nullptr && f.reference->closes_gap() && f.model_free != nullptr &&
         f.model_free->verdict == GapVerdict::kNone;
}

/// The gap that the reference tells; nullptr where it tells none, or is rejected.
const FittedParameter* told_gap(const Findings& f) {
  if (f.reference == nullptr || f.reference->rejected()) return nullptr;
  const FittedParameter* gap = f.reference->find("gap");
  const bool told = gap != nullptr && gap->estimated && gap->identifiable && std::isfinite(gap->ci95.low);
  return told ? gap : nullptr;
}

bool is_good(const Findings& f) { return f.reference->trust == FitTrust::kGood; }

double width(const Interval& i) { return i.high - i.low; }

/// Without its full stop, as a part of another sentence.
std::string clause(const Remark& remark) {
  std::string text = remark.text();
  if (text.ends_with('.')) text.pop_back();
  return text;
}

Fact length(std::string key, double value, const Interval& ci95 = {}) {
  return number(std::move(key), value, "rad", ci95);
}

/// What an estimate says, before its trust is known.
struct Said {
  Told told;
  double gap = kNaN;
  Interval ci95;
  AnswerSource from = AnswerSource::kNone;
  AnswerTrust trust = AnswerTrust::kNone;
};

void add(Said& said, Told more) { said.told.insert(said.told.end(), more.begin(), more.end()); }

Said from_model_free(const Findings& f, AnswerTrust trust) {
  const GapEstimate& g = *f.model_free;
  const char* const code = g.method == GapMethod::kLiteral ? "gap.literal"
                           : g.method == GapMethod::kPaper ? "gap.paper"
                                                           : "gap.model_free";
  const Told told = {{code,
                      {length("gap", g.gap, g.ci95), ratio("bound", g.bound),
                       word("per", f.coordinates.shown_unit("rad/s^2")), length("scatter", g.std)}}};
  return {told, g.gap, g.ci95, AnswerSource::kModelFree, trust};
}

Said from_reference(const Findings& f, const FittedParameter& gap, AnswerTrust trust) {
  const Interval ci95 = f.reference->shown_interval(gap);
  return {{{"gap.reference", {length("gap", gap.value, ci95)}}},
          gap.value,
          ci95,
          AnswerSource::kReference,
          trust};
}

Said from_reference(const Findings& f, const FittedParameter& gap) {
  return from_reference(f, gap, is_good(f) ? AnswerTrust::kGood : AnswerTrust::kLimited);
}

/// Of a reading by itself: what its own recordings bear out.
AnswerTrust trust_in(const GapEstimate& reading) {
  return reading.trust == GapTrust::kGood ? AnswerTrust::kGood : AnswerTrust::kLimited;
}

Said agreed(const Findings& f, const FittedParameter& gap) {
  const bool sharper = is_good(f) && width(gap.ci95) < width(f.model_free->ci95);
  const AnswerTrust trust = is_good(f) ? AnswerTrust::kGood : trust_in(*f.model_free);
  Said a = sharper ? from_reference(f, gap, trust) : from_model_free(f, trust);
  add(a, {{sharper ? "gap.model_free.agrees" : "gap.reference.agrees"}});
  return a;
}

Said contradicted(const Findings& f, const FittedParameter& gap) {
  const GapEstimate& g = *f.model_free;
  const bool model = is_good(f);
  Said a = model ? from_reference(f, gap, AnswerTrust::kLimited) : from_model_free(f, AnswerTrust::kLimited);
  add(a, {{model ? "gap.model_free.contradicts" : "gap.reference.contradicts",
           {model ? length("other", g.gap, g.ci95)
                  : length("other", gap.value, f.reference->shown_interval(gap))}}});
  return a;
}

/// What goes without the reference.
Told without_model(const Findings& f) {
  if (f.reference == nullptr || !f.reference->rejected()) return {{"reference.tells_none"}};
  return {{"reference.rejected", {word("why", f.reference->why.text())}}};
}

/// The paper's steps claim no interval, so a fit that tells one comes first.
Said as_printed(const Findings& f, const FittedParameter* gap) {
  Said a = gap == nullptr ? from_model_free(f, AnswerTrust::kLimited) : from_reference(f, *gap);
  add(a, gap == nullptr
             ? without_model(f)
             : Told{{"gap.literal.reads",
                     {length("other", f.model_free->gap),
                      per_cent("apart", 100.0 * std::abs(f.model_free->gap / gap->value - 1.0))}}});
  return a;
}

Said read(const Findings& f) {
  const FittedParameter* gap = told_gap(f);
  if (f.model_free->method == GapMethod::kLiteral) return as_printed(f, gap);
  // A wide interval agrees with anything, and contradicts as well as a narrow one.
  if (gap != nullptr && f.agree && (!*f.agree || width(gap->ci95) < gap->value))
    return *f.agree ? agreed(f, *gap) : contradicted(f, *gap);
  const bool rejected = f.reference != nullptr && f.reference->rejected();
  Said a = from_model_free(f, rejected ? AnswerTrust::kLimited : trust_in(*f.model_free));
  add(a, without_model(f));
  return a;
}

Said denied(const Findings& f) {
  const double limit = f.model_free->none_above();
  const FittedParameter* gap = told_gap(f);
  if (gap != nullptr && !none_by_both(f) && !(gap->ci95.low > limit)) {
    Said a = from_reference(f, *gap);
    add(a, {{"none.model_free.agrees", {length("least", limit)}}});
    return a;
  }
  Said a;
  a.told = {{"none.model_free", {length("least", limit), per_cent("share", 100.0 * limit / f.travel)}}};
  a.from = AnswerSource::kModelFree;
  a.trust = none_by_both(f) ? AnswerTrust::kGood : AnswerTrust::kLimited;
  if (none_by_both(f))
    a.told.push_back({"none.reference.agrees"});
  else if (gap == nullptr)
    add(a, without_model(f));
  else
    a.told.push_back(
        {"gap.reference.contradicts", {length("other", gap->value, f.reference->shown_interval(*gap))}});
  return a;
}

/// What was measured of the loop, then what it means; empty where no loop is read.
Told lost_motion(const Findings& f) {
  if (f.model_free == nullptr || !f.model_free->lost_motion.read()) return {};
  const LostMotion& l = f.model_free->lost_motion;
  const LostMotionLevel &small = l.levels.front(), &large = l.levels.back();
  Told told;
  if (l.levels.size() > 1)
    told.push_back({"lost_motion.levels",
                    {length("small", small.lost_motion), length("large", large.lost_motion),
                     ratio("to_small", small.amplitude), ratio("to_large", large.amplitude)}});
  else
    told.push_back({"lost_motion", {length("lost", l.value, l.ci95)}});
  if (large.lost_motion > small.ci95.high) told.push_back({"lost_motion.grows"});
  if (l.gap_limit > f.travel)
    told.push_back({"gap.beyond_travel", {length("travel", f.travel)}});
  else if (std::isfinite(l.gap_limit))
    told.push_back({l.limited_by_larger() ? "gap.at_most.larger" : "gap.at_most",
                    {length("limit", l.gap_limit),
                     word("by", l.levels.size() > 1 ? fmt::format("{:.3g}", l.limit_amplitude) : "")}});
  told.push_back({l.cause == LostMotionCause::kGap        ? "lost_motion.gap"
                  : l.cause == LostMotionCause::kFriction ? "lost_motion.friction"
                                                          : "lost_motion.open"});
  return told;
}

/// Lost motion is no gap: the reader gets its limit in words.
Said play(const Findings& f) {
  const Told bound = {{"play.model_free", {length("play", f.model_free->gap, f.model_free->ci95)}},
                      {"play.bounds_gap"}};
  const FittedParameter* gap = told_gap(f);
  if (gap == nullptr || gap->value > f.model_free->ci95.high)
    return {bound, kNaN, {}, AnswerSource::kModelFree, AnswerTrust::kLimited};
  Said model = from_reference(f, *gap);
  add(model, bound);
  add(model, {{"play.model_free.agrees"}});
  return model;
}

/// A second impact tells first and whole. Else the model has the whole; where it tells no more than that it
/// is larger, the reading is what is known.
Said first(const Findings& f) {
  const FittedParameter* gap = told_gap(f);
  if (const GapEstimate& g = *f.model_free; std::isfinite(g.whole)) {
    Said a{{{"gap.first", {length("gap", g.gap, g.ci95), length("whole", g.whole)}}},
           g.gap,
           g.ci95,
           AnswerSource::kModelFree,
           AnswerTrust::kLimited};
    if (gap != nullptr)
      add(a, {{"gap.first.reference", {length("other", gap->value, f.reference->shown_interval(*gap))}}});
    return a;
  }
  Said a = gap == nullptr ? from_model_free(f, AnswerTrust::kLimited)
                          : from_reference(f, *gap, AnswerTrust::kLimited);
  add(a, {{"gap.model_free.first", {length("other", f.model_free->gap, f.model_free->ci95)}}});
  return a;
}

/// Why the reference tells no gap.
/// @param said  that it is rejected
Told no_number(const FitSummary& fit, bool said) {
  const FittedParameter* gap = fit.find("gap");
  Told told;
  if (gap == nullptr) told.push_back({"reference.one_body"});
  if (gap != nullptr && !fit.rejected() && !gap->estimated) told.push_back({"reference.gap_given"});
  const bool told_so = said || !fit.rejected();
  told.push_back({told_so          ? "reference.why"
                  : gap == nullptr ? "reference.rejected"
                                   : "reference.rejected.why",
                  {word("why", fit.why.text())}});
  return told;
}

bool rejects(const Findings& f) { return f.reference && f.reference->rejected() && f.reference->find("gap"); }

Said by_model_alone(const Findings& f) {
  if (const FittedParameter* gap = told_gap(f)) {
    Said a = from_reference(f, *gap);
    add(a, {{"reference.why", {word("why", f.reference->why.text())}}, {"model_free.inconclusive"}});
    return a;
  }
  Said a;
  a.told = lost_motion(f);
  if (a.told.empty() && f.model_free != nullptr)
    a.told.push_back({"gap.not_known",
                      {word("rejected", rejects(f) ? "the fitted model is rejected" : ""),
                       word("reason", clause(f.model_free->reason))}});
  else if (a.told.empty() && rejects(f))
    a.told.push_back({"gap.not_known.rejected"});
  if (f.model_free != nullptr && !f.model_free->lost_motion.read() &&
      std::isfinite(f.model_free->gap_at_most))
    a.told.push_back({"gap.at_most.if_any", {length("limit", f.model_free->gap_at_most)}});
  const bool said = has_code(a.told, "gap.not_known") && rejects(f);
  if (f.reference != nullptr) add(a, no_number(*f.reference, said));
  if (a.told.empty()) a.told.push_back({"gap.not_estimated"});
  return a;
}

/// Where the detector reads a gap, or the model is far from the drive, no remedy is a model without one.
bool may_have_gap(const Findings& f) {
  if (f.reference->innovation_rmse > FitOptions{}.rejected_ratio * f.reference->floor) return true;
  return f.model_free != nullptr && f.model_free->verdict == GapVerdict::kBacklash &&
         f.model_free->quantity == GapQuantity::kGap;
}

/// What to do about a fit that is not good, or about no reading without a model, by the code of the reason.
const char* remedy(const std::string& reason) {
  static const std::map<const char*, std::set<std::string>> all = {
      {"next.diagnose.lacks",
       {"leaves_unexplained", "above_floor", "residual_patterned", "parts_disagree", "gap_bears_little",
        "odd_coupling"}},
      {"next.without_gap", {"as_well_without_gap", "gap_differs", "gap_at_bound"}},
      {"next.close_contact", {"gap_not_determined"}},
      {"next.start_nearer.iterations", {"not_settled"}},
      {"next.start_nearer.unit", {"failed"}},
      {"next.unload", {"held_closed"}},
      {"next.larger_ramps", {"locked_without_loop"}},
      {"next.faster", {"too_slow", "only_large_gaps", "no_impact_stands_out"}}};
  for (const auto& [step, reasons] : all)
    if (reasons.contains(reason)) return step;
  return "";
}

/// What would give a reading without a model where the detector was inconclusive and saw no loop.
Statement step_to_a_reading(const GapEstimate& g) {
  if (g.reason.has_code("bounds_to_try") || g.reason.has_code("bound_to_try")) return {"next.bound_as_told"};
  if (g.reason.has_code("auto_reads")) return {"next.bound_auto"};
  if (const std::string step = remedy(g.reason.code()); !step.empty()) return {step};
  const bool bank = g.reason.has_code("nothing_reads");
  const Remark reason = bank ? g.reason.behind("nothing_reads") : g.reason;
  const bool advises = reason.code() == "gap_uncertain" || reason.code() == "few_passages";
  if (const Remark advice = advises ? reason.behind(reason.code()) : reason;
      (advises || bank) && !advice.empty())
    return {"next.advice", {word("advice", clause(advice))}};
  return {"next.free_motion"};
}

/// Without a code: none.
Statement step_without_model(const GapEstimate& g) {
  const bool open = g.verdict == GapVerdict::kInconclusive, loop = g.lost_motion.read();
  if (open && g.reason.code() == "locked_with_bound") return {"next.bound_auto.loop"};
  if (g.reason.code() == "passages_as_printed" && open)
    return {"next.other_bound", {word("auto", "{bound: auto}")}};
  if (g.reason.code() == "encoder_on_load") return {"next.model_of_load"};
  if (open && (g.reason.has_code("bounds_to_try") || g.reason.has_code("bound_to_try") || !loop))
    return step_to_a_reading(g);
  if (open && g.reason.has_code("auto_reads")) return {"next.bound_auto"};
  const std::size_t levels = g.lost_motion.levels.size();
  if (open && levels > 1)
    return {g.lost_motion.limited_by_larger() ? "next.ramps_between" : "next.smaller_ramps"};
  if (g.verdict == GapVerdict::kBacklash && g.quantity == GapQuantity::kFirstGap) return {"next.hold_output"};
  const bool play = g.verdict == GapVerdict::kBacklash && g.quantity == GapQuantity::kPlayAtZeroTorque;
  return {open || (levels < 2 && play) ? "next.two_levels" : ""};
}

/// Where the configuration holds a gap that the reading without a model excludes, and no good fit bears out.
Statement step_of_held_gap(const Findings& f) {
  const FittedParameter* gap = f.reference == nullptr ? nullptr : f.reference->find("gap");
  if (gap == nullptr || gap->estimated || f.model_free == nullptr || is_good(f)) return {};
  const GapEstimate& g = *f.model_free;
  if (g.verdict != GapVerdict::kBacklash || g.quantity != GapQuantity::kGap) return {};
  if (std::isnan(g.ci95.low) || (g.ci95.low <= gap->value && gap->value <= g.ci95.high)) return {};
  return {"next.estimate_gap",
          {length("held", gap->value), length("read", g.gap, g.ci95), word("estimate", "{estimate: true}")}};
}

constexpr std::size_t kMostSteps = 3;

/// The most telling first.
Told steps(const Findings& f) {
  Told next = {step_of_held_gap(f)};
  if (f.reference != nullptr && f.reference->rejected() &&
      f.reference->innovation_rmse >= f.reference->coasting_rmse)
    next.push_back({"next.sign"});
  if (f.agree && !*f.agree) next.push_back({"next.once_more"});
  // Where the lost motion is read, what it is made of is the question; else a model answers before another
  // recording.
  const Statement reading = f.model_free != nullptr ? step_without_model(*f.model_free) : Statement();
  const bool loop = f.model_free != nullptr && f.model_free->lost_motion.read();
  if (loop) next.push_back(reading);
  if (f.reference != nullptr && !none_by_both(f)) {
    const std::string step = remedy(f.reference->why.code());
    next.push_back({step == "next.without_gap" && may_have_gap(f) ? "next.diagnose.lacks" : step});
  }
  if (!loop) next.push_back(reading);
  std::erase_if(next, [](const Statement& s) { return s.code.empty(); });
  next.resize(std::min(next.size(), kMostSteps));
  return next;
}

Answer written(const Said& said, Coordinates coordinates) {
  Answer a;
  a.gap = said.gap, a.ci95 = said.ci95, a.from = said.from, a.trust = said.trust;
  go_on(a, said.told, coordinates);
  return a;
}

}  // namespace

const char* to_string(AnswerSource source) {
  constexpr const char* kWords[] = {"model_free", "reference", "diagnosis", "none"};
  return kWords[static_cast<int>(source)];
}

const char* to_string(AnswerTrust trust) {
  constexpr const char* kWords[] = {"good", "limited", "none"};
  return kWords[static_cast<int>(trust)];
}

Answer answer_of(const Findings& f) {
  const GapVerdict verdict = f.model_free == nullptr ? GapVerdict::kNotRun : f.model_free->verdict;
  Answer a = written(verdict == GapVerdict::kNone                               ? denied(f)
                     : verdict != GapVerdict::kBacklash                         ? by_model_alone(f)
                     : f.model_free->quantity == GapQuantity::kPlayAtZeroTorque ? play(f)
                     : f.model_free->quantity == GapQuantity::kFirstGap         ? first(f)
                                                                                : read(f),
                     f.coordinates);
  for (const Statement& step : steps(f)) {
    a.next.push_back(in_words({step}, Detail::kWhole, f.coordinates));
    a.next_codes.push_back(step.code);
  }
  if (f.model_free != nullptr) a.gap_at_most = f.model_free->gap_at_most;
  return a;
}

bool Answer::says(const std::string& code) const { return contains(codes, code); }

void go_on(Answer& a, const Told& told, Coordinates coordinates) {
  const auto put = [](std::string& text, const std::string& more) {
    text += (text.empty() || more.empty() ? "" : " ") + more;
  };
  put(a.sentence, in_words(told, Detail::kWhole, coordinates));
  put(a.in_brief, in_words(told, Detail::kBrief, coordinates));
  for (const std::string& code : codes_of(told))
    if (!a.says(code)) a.codes.push_back(code);
}

void put_in_doubt(Answer& a, const std::vector<Doubt>& doubts) {
  if (doubts.empty()) return;
  const Doubt& first = doubts.front();
  if (a.trust != AnswerTrust::kNone) go_on(a, {{"gap.if_recording", {word("doubt", first.found)}}}, {});
  if (a.trust == AnswerTrust::kGood) a.trust = AnswerTrust::kLimited;
  const Statement step{"next.see_to_recording", {word("advice", first.advice)}};
  a.next.insert(a.next.begin(), in_words({step}, Detail::kWhole, {}));
  a.next_codes.insert(a.next_codes.begin(), step.code);
  a.next.resize(std::min(a.next.size(), kMostSteps)), a.next_codes.resize(a.next.size());
}

}  // namespace gapscope
