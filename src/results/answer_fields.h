#pragma once

#include <cmath>
#include <concepts>
#include <optional>

#include "results/json_archive.h"
#include "telling/answer.h"

/// The answer as result.json and diagnosis.json have it.
namespace gapscope::internal::results {

template <class Archive>
void limit_field(Archive& archive, const char* key, std::optional<double>& limit) {
  double value = limit.value_or(kNaN);
  archive.addition(key, value);
  limit = std::isfinite(value) ? std::optional(value) : std::nullopt;
}

template <class Archive>
void fields(Archive& archive, Tolerance& t) {
  limit_field(archive, "torque_percent", t.torque_percent);
  limit_field(archive, "gap_rad", t.gap);
}

/// The lines of a card as texts, and as the codes of what they say.
template <class Archive, class Lines>
requires std::same_as<Lines, CardText> || std::same_as<Lines, CardCodes>
void fields(Archive& archive, Lines& c) {
  archive("gap", c.gap);
  archive("mismatch", c.mismatch);
  archive("place", c.place);
  archive("cause", c.cause);
  archive("helps", c.helps);
  archive("next", c.next);
}

template <class Archive>
void fields(Archive& archive, Answer& a) {
  archive("gap_rad", a.gap);
  archive("ci95_rad", a.ci95);
  archive.choice("from", a.from,
                 Words<AnswerSource>{{AnswerSource::kModelFree, "model_free"},
                                     {AnswerSource::kReference, "reference"},
                                     {AnswerSource::kDiagnosis, "diagnosis"},
                                     {AnswerSource::kNone, "none"}});
  archive.choice(
      "trust", a.trust,
      Words<AnswerTrust>{
          {AnswerTrust::kGood, "good"}, {AnswerTrust::kLimited, "limited"}, {AnswerTrust::kNone, "none"}});
  archive.addition("gap_at_most_rad", a.gap_at_most);
  archive.added("codes", a.codes);
  archive("sentence", a.sentence);
  archive.addition("in_brief", a.in_brief);
  archive("next", a.next);
  archive.added("next_codes", a.next_codes);
  archive.added("card", static_cast<CardText&>(a.card));
  archive.added("brief", a.card.brief);
  archive.added("card_codes", a.card.codes);
  archive.addition("mismatch_torque_nm", a.card.torque);
  archive.addition("mismatch_percent", a.card.percent);
  archive.addition("mismatch_torque_after_nm", a.card.torque_after);
  archive.addition("mismatch_percent_after", a.card.percent_after);
  archive.added("good_enough", a.card.good_enough);
  archive.added("tolerance", a.tolerance);
}

}  // namespace gapscope::internal::results
