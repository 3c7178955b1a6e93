#include "gapscope/telling/card.h"

#include <cmath>

#include "base/text.h"
#include "diagnosis/rule.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "telling/answer.h"
#include "telling/card_lines.h"
#include "telling/gap_of_effect.h"

namespace gapscope {
namespace {

using namespace internal::telling;
using internal::diagnosis::kRule;

/// Whether the gap is within its tolerance; nothing where its interval does not decide.
std::optional<bool> gap_good_enough(const CardFacts& f) {
  if (f.answer == nullptr || std::isnan(f.answer->gap)) return {};
  const Interval& ci = f.answer->ci95;
  const double low = std::isfinite(ci.low) ? ci.low : f.answer->gap;
  const double high = std::isfinite(ci.high) ? ci.high : f.answer->gap;
  if (high <= *f.tolerance.gap) return true;
  if (low > *f.tolerance.gap) return false;
  return {};
}

std::optional<bool> torque_good_enough(const CardFacts& f, const Card& card) {
  if (std::isnan(card.percent)) return {};
  return card.percent <= *f.tolerance.torque_percent;
}

/// Of all that is stated: one that is missed decides, one that cannot be told leaves it open.
std::optional<bool> good_enough(const CardFacts& f, const Card& card) {
  std::optional<bool> all;
  bool open = false;
  const auto judge = [&](const std::optional<bool>& one) {
    open = open || !one;
    if (one) all = all.value_or(true) && *one;
  };
  if (f.tolerance.torque_percent) judge(torque_good_enough(f, card));
  if (f.tolerance.gap) judge(gap_good_enough(f));
  return open && all.value_or(true) ? std::nullopt : all;
}

Told gap_tolerance(const CardFacts& f) {
  if (!f.tolerance.gap) return {};
  const std::optional<bool> good = gap_good_enough(f);
  return {{!good   ? "tolerance.gap.open"
           : *good ? "tolerance.gap.within"
                   : "tolerance.gap.outside",
           {number("limit", *f.tolerance.gap, "rad")}}};
}

Told torque_tolerance(const CardFacts& f, const Card& card) {
  if (!f.tolerance.torque_percent) return {};
  const double limit = *f.tolerance.torque_percent;
  const std::optional<bool> good = torque_good_enough(f, card);
  return {{!good                         ? "tolerance.torque.open"
           : *good                       ? "tolerance.torque.within"
           : card.percent_after <= limit ? "tolerance.torque.then_within"
                                         : "tolerance.torque.outside",
           {per_cent("limit", limit)}}};
}

/// Who tells the gap without a model. An encoder on the load shows none, so that `detect` would send the
/// reader back.
Fact how_without_model(const Diagnosis& d) {
  const bool on_load = (d.model_gap && d.model_gap->encoder == EncoderSide::kLoad) ||
                       (!d.traces.empty() && d.traces.front().encoder == EncoderSide::kLoad);
  return word(
      "how", on_load ? "that needs the motor's position, which is not recorded" : "`gapscope detect CONFIG`");
}

/// Of a gap that a diagnosis does not estimate: who tells it.
Told gap_not_estimated(const Diagnosis* d) {
  if (d == nullptr || !d->model_gap) return {{"gap.elsewhere"}};
  const Fact how = how_without_model(*d);
  const MismatchSize& m = d->mismatch;
  const bool on_load = d->model_gap->encoder == EncoderSide::kLoad;
  switch (d->model_gap->origin) {
    case GapOrigin::kNone:
      return {{on_load                                 ? "gap.one_body.on_load"
               : d->verdict == DiagnosisVerdict::kNone ? "gap.one_body.as_good"
                                                       : "gap.one_body",
               {how}}};
    case GapOrigin::kGiven:
      return {{"gap.given", {how, number("gap", d->model_gap->value, "rad")}}};
    case GapOrigin::kEstimated:
      return {{m.remains < kRule.far ? "gap.not_determined" : "gap.not_followed",
               {how, ratio("floors", m.remains), floor_of_the_motion(m), ratio("least", kRule.far)}}};
  }
  return {{"gap.elsewhere"}};
}

/// Why the trust is limited in a gap that is denied by no model, or in that of a model which leaves
/// something.
Statement limited_trust(const CardFacts& f) {
  const Answer& a = *f.answer;
  if (a.says("none.model_free") && !a.says("gap.reference.contradicts") && std::isnan(a.gap))
    return {"trust.limited.light_load"};
  const MismatchSize* m = f.diagnosis != nullptr ? &f.diagnosis->mismatch : nullptr;
  const bool by_diagnosis = a.from == AnswerSource::kDiagnosis;
  if (by_diagnosis && m != nullptr && m->remains >= kRule.floor_ratio &&
      m->floor_from != FloorSource::kRepeatability)
    return {"trust.limited.floors", {ratio("floors", m->remains)}};
  if (by_diagnosis && is_open(a)) return {"trust.limited.open", {per_cent("share", 100.0 * open_share(a))}};
  const bool fitted = a.from == AnswerSource::kReference && f.reference != nullptr;
  if (fitted && f.reference->why.code() == "above_floor")
    return {"trust.limited.floors", {ratio("floors", f.reference->innovation_rmse / f.reference->floor)}};
  const bool beside = a.from == AnswerSource::kModelFree && f.reference != nullptr && f.reference->rejected();
  return {beside ? "trust.limited.reading" : "trust.limited"};
}

Statement trust_of(const CardFacts& f) {
  const Answer& a = *f.answer;
  if (a.trust == AnswerTrust::kNone) return {f.lost_motion ? "trust.lost_motion" : "trust.none"};
  if (a.says("play.bounds_gap") && a.from == AnswerSource::kModelFree) return {"trust.bound"};
  return a.trust == AnswerTrust::kGood ? Statement{"trust.good"} : limited_trust(f);
}

/// What stands in one line, in both lengths, with its codes.
void write(const Told& told, std::string CardText::*line, std::vector<std::string> CardCodes::*codes,
           Coordinates coordinates, Card& card) {
  const auto put = [](std::string& text, const std::string& more) {
    text += (text.empty() || more.empty() ? "" : " ") + more;
  };
  put(card.*line, in_words(told, Detail::kWhole, coordinates));
  put(card.brief.*line, in_words(told, Detail::kBrief, coordinates));
  for (const std::string& code : codes_of(told)) (card.codes.*codes).push_back(code);
}

void write_gap(const CardFacts& f, Card& card) {
  Told told;
  if (f.answer == nullptr) {
    told = gap_not_estimated(f.diagnosis);
  } else {
    card.gap = f.answer->sentence, card.codes.gap = f.answer->codes;
    card.brief.gap = f.answer->in_brief.empty() ? f.answer->sentence : f.answer->in_brief;
    told.push_back(trust_of(f));
    for (Statement& s : gap_tolerance(f)) told.push_back(std::move(s));
  }
  write(told, &CardText::gap, &CardCodes::gap, f.coordinates, card);
}

/// The period, where the motion does not go through one.
Told place_of_card(const CardFacts& f) {
  if (f.diagnosis == nullptr) return {{"by_diagnose"}};
  const Diagnosis& d = *f.diagnosis;
  if (d.verdict == DiagnosisVerdict::kNone) return {{"where.nowhere"}};
  Told told = {{"where.pattern", {word("where", d.where.headline)}}};
  const double turns = d.whole_run ? d.whole_run->travel / (2.0 * kPi) : kNaN;
  if (f.coordinates.rotational() && turns * d.where.periods_per_turn < 1.0)
    told.push_back({"where.short", {ratio("turns", turns)}});
  return told;
}

void measure(const CardFacts& f, Card& card) {
  if (f.diagnosis == nullptr) return;
  const MismatchSize& m = f.diagnosis->mismatch;
  if (!is_told_in_torque(*f.diagnosis)) {  // the balance still tells what the model as it is lacks
    const ErrorBudget& b = f.diagnosis->budget;
    if (b.exists()) card.torque = b.nominal, card.percent = 100.0 * b.nominal / b.input;
    return;
  }
  card.torque = m.before_torque, card.torque_after = m.after_torque;
  card.percent = 100.0 * card.torque / m.input_torque;
  card.percent_after = 100.0 * card.torque_after / m.input_torque;
}

}  // namespace

void Tolerance::fields(FieldVisitor& v) {
  v.field({"torque_percent", "%", "rms of the torque that the model misses, of what the input applies", 1e-6,
           1e3},
          torque_percent);
  v.field({"gap", "rad", "largest backlash gap", 1e-12, 10.0}, gap);
}

std::array<CardLine, 6> Card::lines() const {
  return {{{"gap", brief.gap, gap},
           {"model error", brief.mismatch, mismatch},
           {"where", brief.place, place},
           {"cause", brief.cause, cause},
           {"helps", brief.helps, helps},
           {"next", brief.next, next}}};
}

bool Card::asks(const std::string& code) const { return contains(codes.next, code); }

Card card_of(const CardFacts& f) {
  Card card;
  card.diagnosed = f.diagnosis != nullptr;
  measure(f, card);
  card.good_enough = good_enough(f, card);
  write_gap(f, card);
  Told error = error_of(f, card);
  for (Statement& s : torque_tolerance(f, card)) error.push_back(std::move(s));
  write(error, &CardText::mismatch, &CardCodes::mismatch, f.coordinates, card);
  write(place_of_card(f), &CardText::place, &CardCodes::place, f.coordinates, card);
  write(cause_of(f), &CardText::cause, &CardCodes::cause, f.coordinates, card);
  write(helps_of(f, card), &CardText::helps, &CardCodes::helps, f.coordinates, card);
  write(next_of(f, card), &CardText::next, &CardCodes::next, f.coordinates, card);
  return card;
}

}  // namespace gapscope
