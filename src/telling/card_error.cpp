#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared_unit.h"
#include "base/text.h"
#include "diagnosis/rule.h"
#include "telling/card_lines.h"
#include "telling/names.h"

namespace gapscope::internal::telling {

using diagnosis::kRule;

namespace {

/// What is left of the motion that the fit follows, where nobody has diagnosed it.
Told fit_of_motion(const CardFacts& f) {
  if (f.reference == nullptr || std::isnan(f.reference->fit_percent)) return {{"error.not_fitted"}};
  const double fit = f.reference->fit_percent;
  Told told = {{fit > 0.0 ? "error.fit" : "error.fit.departs", {word("fit", fmt::format("{:.4g} %", fit))}}};
  if (f.reference->rejected())
    told.push_back({fit > 0.0 ? "error.fit.rejected.all_the_same" : "error.fit.rejected"});
  return told;
}

/// What the size of an error is of: whether the model is refitted, and the effects that it has.
std::vector<Fact> of_model(const Diagnosis& d) {
  std::vector<std::string> has;
  for (const std::string& effect : d.modelled)  // of a known mass on an arm, as its user knows it
    has.push_back(effect == "load_unbalance" ? "gravity of the load" : readable(effect));
  return {word("refitted", d.refitted.empty() ? "" : "refitted"), names("has", has)};
}

Statement torque_size(const CardFacts& f, const Card& card) {
  const Diagnosis& d = *f.diagnosis;
  constexpr double kMany = 200.0;  // per cent, from which on times are plainer
  const ErrorBudget& b = d.budget;
  const double input = 100.0 * card.torque / card.percent;
  Statement s{std::isnan(card.percent) ? "error.torque.alone"
              : card.percent < kMany   ? "error.torque"
                                       : "error.torque.many",
              of_model(d)};
  for (Fact fact :
       {number("missing", card.torque, "N m"), per_cent("share", card.percent),
        ratio("times", 0.01 * card.percent), source_word(d), ratio("band", b.exists() ? b.band_hz : kNaN),
        word("input", SharedUnit(input, f.coordinates.shown_unit("N m"))(input))})
    s.facts.push_back(std::move(fact));
  return s;
}

Statement motion_size(const CardFacts& f) {
  const MismatchSize& m = f.diagnosis->mismatch;
  Statement s{std::isfinite(m.before) ? "error.motion" : "error.diverges", of_model(*f.diagnosis)};
  s.facts.push_back(number("off", m.before, "rad"));
  s.facts.push_back(word("measure", m.measure));
  return s;
}

/// What the encoder's noise alone makes an observer correct [N m]; NaN: not told.
double correction_floor(const Diagnosis& d, Coordinates coordinates) {
  const auto row = std::ranges::find(d.measures, coordinates.torque_unit(), &MismatchMeasure::unit);
  return row == d.measures.end() ? kNaN : row->floor;
}

/// What no model gets below, in the unit of the size, so that a diagnosis that goes on from another is
/// measured by the same. Nothing where no floor in torque is known, or a model has got below. Recordings may
/// disagree by more than a model leaves of those held out: that is no bound. What does not come back holds
/// the encoder's noise: it is the drive's where it is clearly more.
Told torque_floor(const CardFacts& f, const Card& card) {
  const ErrorBudget& b = f.diagnosis->budget;
  const double floor = !b.exists()           ? correction_floor(*f.diagnosis, f.coordinates)
                       : b.uncounted.empty() ? b.floor()
                                             : kNaN;
  if (f.diagnosis->verdict == DiagnosisVerdict::kNone || !(floor > 0.0 && floor < card.torque)) return {};
  const bool records = b.records >= floor;
  if (card.torque_after < floor) return {};  // a floor that is undercut is no floor
  return {{records              ? "error.floor.records"
           : is_of_the_drive(b) ? "error.floor.drive"
                                : "error.floor.encoder",
           {number("floor", floor, "N m"), parts_word(*f.diagnosis)}}};
}

/// Of a model that nothing is missing of: that what is left is no more than the encoder's noise, or than the
/// drive's own repetition.
Told noise(const Diagnosis& d) {
  const MismatchSize& m = d.mismatch;
  if (d.verdict != DiagnosisVerdict::kNone || !(m.before > 0.0 && m.floor > 0.0)) return {};
  return {
      {m.floor_from == FloorSource::kRepeatability ? "error.repeats" : "error.noise",
       {number("off", m.before, "rad"), number("floor", m.floor, "rad"), ratio("ratio", kRule.floor_ratio)}}};
}

/// With a prefix of its own: an error may be far smaller.
Fact travel_word(double travel, Coordinates coordinates) {
  return word("travel", std::isfinite(travel) ? SharedUnit(travel, coordinates.position_unit())(travel) : "");
}

Told closed_loop(const Diagnosis& d, Coordinates coordinates) {
  if (!d.closed_loop) return {};
  const ClosedLoop& c = *d.closed_loop;
  const double travel = d.whole_run ? d.whole_run->travel : kNaN;
  return {{std::isfinite(c.before) ? "error.closed_loop" : "error.closed_loop.diverges",
           {number("before", c.before, "rad"),
            number("after", d.added.empty() && !d.loop ? kNaN : c.after, "rad"),
            travel_word(travel, coordinates)}}};
}

/// Of the model that is fitted in the loop, over what was held out.
Told fitted_loop(const Diagnosis& d) {
  if (!d.loop || d.held_out_runs.empty()) return {};
  double sum = 0.0;
  const HeldOutRun* worst = &d.held_out_runs.front();
  for (const HeldOutRun& run : d.held_out_runs) {
    sum += run.mae;
    if (!(run.mae <= worst->mae)) worst = &run;
  }
  const double count = static_cast<double>(d.held_out_runs.size());
  return {{"error.fitted_loop",
           {number("mae", sum / count, "rad"), ratio("count", count), number("most", worst->mae, "rad"),
            word("worst", worst->file)}}};
}

/// Of the recommended model, in the recording held out that it misses most [rad].
double worst_rms(const Diagnosis& d) {
  double worst = kNaN;
  for (const HeldOutRun& run : d.held_out_runs)
    if (!run.closed) worst = std::fmax(worst, run.rmse);
  return worst;
}

/// Under its controller a drive is judged by that.
Told free_run(const Diagnosis& d, Coordinates coordinates) {
  if (!d.whole_run || d.closed_loop) return {};
  const WholeRun& w = *d.whole_run;
  const bool stays = std::isfinite(w.before), stays_after = d.added.empty() || std::isfinite(w.after);
  Told told = {{!stays         ? "error.free_run.diverges"
                : !stays_after ? "error.free_run.then_diverges"
                               : "error.free_run",
                {number("before", w.before, "rad"), number("after", d.added.empty() ? kNaN : w.after, "rad"),
                 travel_word(w.travel, coordinates), number("rms", worst_rms(d), "rad")}}};
  const bool grows =
      w.after > kRule.floor_ratio * w.before && d.mismatch.after < d.mismatch.before && !drifts_farther(d);
  if (!d.added.empty() && stays && stays_after && grows) told.push_back({"error.free_run.grows"});
  return told;
}

Told as_configured(const Diagnosis& d) {
  const MismatchSize& m = d.mismatch;
  if (!d.as_configured || d.refitted.empty() || d.stopped || !std::isfinite(m.before)) return {};
  const double given = d.as_configured->error;
  if (given <= kRule.floor_ratio * m.before) return {};
  return {{std::isfinite(given) ? "error.as_configured" : "error.as_configured.diverges",
           {word("judged", m.judged_by == JudgedBy::kPrediction ? "predicted" : "simulated"),
            number("given", given, "rad"), number("before", m.before, "rad"),
            number("after", d.added.empty() ? kNaN : m.after, "rad"), word("measure", m.measure)}}};
}

}  // namespace

Told error_of(const CardFacts& f, const Card& card) {
  if (f.diagnosis == nullptr) return fit_of_motion(f);
  const Diagnosis& d = *f.diagnosis;
  const bool torque = std::isfinite(card.torque);
  Told told = {torque ? torque_size(f, card) : motion_size(f)};
  const auto put = [&](Told more) { told.insert(told.end(), more.begin(), more.end()); };
  put(noise(d));
  put(torque_floor(f, card));
  if (torque && f.constant_guessed) put({{"error.constant_guessed"}});
  put(as_configured(d));
  put(free_run(d, f.coordinates));
  put(closed_loop(d, f.coordinates));
  put(fitted_loop(d));
  return told;
}

}  // namespace gapscope::internal::telling
