#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/answer_fields.h"
#include "results/diagnosis_result.h"
#include "results/json_archive.h"
#include "results/shared_fields.h"
#include "results/simulator_fields.h"
#include "results/torque_fields.h"

/// The fields of a stored diagnosis, each named once; those that readers outside the project rely on first.
namespace gapscope::internal::results {

inline constexpr const char* kDiagnosisSchema = "gapscope.diagnosis/2";

/// A trace without its columns, which are in the trace file.
struct StoredMismatch {
  std::string trace;
  int samples = 0, scored_from = 0;
  MismatchTrace mismatch;
};

struct DiagnosisDocument {
  std::string schema = kDiagnosisSchema;
  DiagnosisResult result;
  std::vector<StoredMismatch> held_out;
  std::optional<SimulatorDocument> simulated = {};
};

template <class Archive>
void fields(Archive& archive, StoredMismatch& s) {
  archive("file", s.mismatch.file);
  archive("trace", s.trace);
  archive("samples", s.samples);
  archive("start_s", s.mismatch.start);
  archive("dt_s", s.mismatch.dt);
  archive("scored_from", s.scored_from);
  encoder_side_field(archive, s.mismatch.encoder);
}

template <class Archive>
void fields(Archive& archive, RankedEffect& r) {
  archive("effect", r.effect);
  archive("probability", r.probability);
  archive("held_out_rmse_rad", r.held_out);
  archive("shrink", r.shrink);
  archive.named_members("parameters", r.parameters, &NamedValue::key, &NamedValue::value);
  units(archive, "units", r.parameters);
  archive("score", r.score);
  archive("relative_gain", r.rel);
  archive("windows_better", r.windows_better);
  archive("remark", r.remark);
}

template <class Archive>
void fields(Archive& archive, MismatchSize& g) {
  archive("measure", g.measure);
  archive.seldom_choice(
      "judged_by", g.judged_by,
      Words<JudgedBy>{{JudgedBy::kFreeRun, "free_run"}, {JudgedBy::kPrediction, "prediction"}},
      JudgedBy::kFreeRun);
  archive("before_rad", g.before);
  archive("after_rad", g.after);
  archive("floor_rad", g.floor);
  archive.choice("floor_from", g.floor_from,
                 Words<FloorSource>{{FloorSource::kEncoder, "encoder"},
                                    {FloorSource::kNoise, "noise"},
                                    {FloorSource::kRepeatability, "repeatability"},
                                    {FloorSource::kRecords, "records"}});
  archive("before_torque_nm", g.before_torque);
  archive("after_torque_nm", g.after_torque);
  archive("floor_torque_nm", g.floor_torque);
  archive("input_torque_rms_nm", g.input_torque);
  archive.addition("floor_of", g.floor_of);
  archive("shrink", g.shrink);
  archive("shrink_ci95", g.shrink_ci95);
  archive("remains_ratio", g.remains);
}

template <class Archive>
void fields(Archive& archive, AddedEffect& a) {
  archive("effect", a.effect);
  archive.choice("cause", a.established, Words<bool>{{true, "established"}, {false, "open"}});
  archive("group", a.group);
  archive("probability", a.probability);
  archive.named_members("parameters", a.parameters, &NamedValue::key, &NamedValue::value);
  units(archive, "units", a.parameters);
  archive.added_members("parameters_ci95", a.parameters, &NamedValue::key, &NamedValue::ci95);
  archive("shrink", a.shrink);
  archive("shrink_ci95", a.shrink_ci95);
  archive("after_torque_nm", a.after_torque);
  archive.seldom("at_bound", a.at_bound);
  archive.seldom_choice("shrink_of", a.share_of,
                        Words<ShareOf>{{ShareOf::kMotion, "motion"}, {ShareOf::kTorque, "torque"}},
                        ShareOf::kMotion);
}

template <class Archive>
void fields(Archive& archive, DetectableEffect& d) {
  archive("effect", d.effect);
  archive("parameter", d.smallest.key);
  archive("unit", d.smallest.unit);
  archive("smallest", d.smallest.value);
  archive.named_members("at", d.at, &NamedValue::key, &NamedValue::value);
  units(archive, "at_units", d.at);
  archive("torque_rms_nm", d.torque);
  archive("hidden_by", d.hidden_by);
  archive("why", d.why);
}

template <class Archive>
void fields(Archive& archive, DiagnosisStep& s) {
  archive("on_top_of", s.on_top_of);
  archive("effect", s.effect);
  archive("accepted", s.accepted);
  archive("group", s.group);
  archive("dropped", s.dropped);
  archive.single("gap", s.mismatch);
  archive("remaining", s.remaining);
  archive.list("ranking", s.ranking);
}

template <class Archive>
void fields(Archive& archive, PeriodicTorque& p) {
  archive("periods_per_turn", p.periods_per_turn);
  archive("period_rad", p.period);
  archive("amplitude_nm", p.amplitude);
  archive("phase_rad", p.phase);
  archive("over_neighbours_ratio", p.stands_out);
  archive("windows", p.windows);
  archive("windows_better", p.better);
  archive("holds", p.holds);
  archive("given", p.given);
}

template <class Archive>
void fields(Archive& archive, Separation& s) {
  archive("truth", s.truth);
  archive("rival", s.rival);
  archive("excess_sigma", s.excess);
  archive("contained", s.contained);
}

template <class Archive>
void fields(Archive& archive, TriedInput& t) {
  archive("input", t.input);
  archive("travel_rad", t.travel);
  archive("worst_sigma", t.worst);
  archive.list("separations", t.separations);
}

template <class Archive>
void fields(Archive& archive, NextExperiment& n) {
  archive("sentence", n.sentence);
  archive("rate_hz", n.rate);
  archive("duration_s", n.duration);
  archive.list("tried", n.tried);
}

template <class Archive>
void fields(Archive& archive, MismatchMeasure& m) {
  archive("measure", m.name);
  archive("unit", m.unit);
  archive("before", m.before);
  archive("after", m.after);
  archive("floor", m.floor);
}

template <class Archive>
void fields(Archive& archive, ClosedLoopRun& r) {
  archive("file", r.file);
  archive("before_rad", r.before);
  archive("after_rad", r.after);
}

template <class Archive>
void fields(Archive& archive, LoopNumber& n) {
  archive("parameter", n.key);
  archive("unit", n.unit);
  archive("value", n.value);
  archive("ci95", n.ci95);
}

template <class Archive>
void fields(Archive& archive, LoopFit& f) {
  archive("mae_before_rad", f.mae_before);
  archive("mae_after_rad", f.mae_after);
  archive("added", f.added);
  archive.list("numbers", f.numbers);
  archive.list("fitted_runs", f.fitted_runs);
}

template <class Archive>
void fields(Archive& archive, ClosedLoop& c) {
  archive("before_rad", c.before);
  archive("after_rad", c.after);
  archive.list("recordings", c.recordings);
}

template <class Archive>
void fields(Archive& archive, ModelGap& g) {
  const Words<GapOrigin> origins = {
      {GapOrigin::kNone, "one_body"}, {GapOrigin::kGiven, "given"}, {GapOrigin::kEstimated, "estimated"}};
  archive.choice("origin", g.origin, origins);
  archive("value_rad", g.value);
  archive("ci95_rad", g.ci95);
  encoder_side_field(archive, g.encoder);
}

template <class Archive>
void fields(Archive& archive, BlameShift& b) {
  const Words<BoundReached> bounds = {{BoundReached::kLower, "lower"}, {BoundReached::kUpper, "upper"}};
  archive("unit", b.unit);
  archive("without", b.without);
  archive("with", b.with);
  archive.seldom_choice("without_at_bound", b.without_at, bounds, BoundReached::kNone);
  archive.seldom_choice("with_at_bound", b.with_at, bounds, BoundReached::kNone);
  archive.seldom_choice("held", b.held, Words<bool>{{true, "yes"}, {false, "no"}}, false);
}

template <class Archive>
void fields(Archive& archive, RefittedNumber& n) {
  archive("parameter", n.key);
  archive("unit", n.unit);
  archive("configured", n.configured);
  archive("fitted", n.fitted);
  archive("fitted_ci95", n.ci95);
}

template <class Archive>
void fields(Archive& archive, WholeRun& w) {
  archive("before_rad", w.before);
  archive("after_rad", w.after);
  archive("travel_rad", w.travel);
}

template <class Archive>
void fields(Archive& archive, HeldOutRun& r) {
  archive("file", r.file);
  archive("from_s", r.from);
  archive("to_s", r.to);
  archive.choice("loop", r.closed, Words<bool>{{true, "closed"}, {false, "open"}});
  archive("rmse_rad", r.rmse);
  archive("mae_rad", r.mae);
  archive("fit_percent", r.fit);
  archive("nominal_fit_percent", r.nominal_fit);
}

template <class Archive>
void fields(Archive& archive, AsConfigured& c) {
  archive("error_rad", c.error);
}

/// The seven maps of a place: shares, or what an error without a place would have.
struct MapsOf {
  MismatchPlace& place;
  double MapShare::*value;
};

template <class Archive>
void maps(Archive& archive, MismatchPlace& p, double MapShare::*value) {
  archive.named_members("mode", p.mode, &MapShare::bin, value);
  archive.named_members("direction", p.direction, &MapShare::bin, value);
  archive.named_members("speed", p.speed, &MapShare::bin, value);
  archive.named_members("angle", p.angle, &MapShare::bin, value);
  archive.named_members("input", p.input, &MapShare::bin, value);
  archive.named_members("frequency", p.frequency, &MapShare::bin, value);
  archive.named_members("time", p.time, &MapShare::bin, value);
}

template <class Archive>
void fields(Archive& archive, MapsOf& m) {
  maps(archive, m.place, m.value);
}

/// Those of these names.
inline std::vector<ResidualPattern> patterns_of(const std::vector<std::string>& codes) {
  std::vector<ResidualPattern> patterns;
  for (const std::string& code : codes)
    for (int p = 0; p <= static_cast<int>(ResidualPattern::kMode); ++p)
      if (to_string(static_cast<ResidualPattern>(p)) == code)
        patterns.push_back(static_cast<ResidualPattern>(p));
  return patterns;
}

template <class Archive>
void fields(Archive& archive, MismatchPlace& p) {
  archive("headline", p.headline);
  std::vector<std::string> codes;
  for (const ResidualPattern pattern : p.follows) codes.emplace_back(to_string(pattern));
  archive.seldom("codes", codes);
  p.follows = patterns_of(codes);
  maps(archive, p, &MapShare::share);
  archive("periods_per_turn", p.periods_per_turn);
  MapsOf expected{p, &MapShare::expected};
  archive.single("expected", expected);
}

template <class Archive>
void fields(Archive& archive, DiagnosisDocument& d) {
  Diagnosis& g = d.result.diagnosis;
  archive("schema", d.schema);
  verdict_field(archive, g.verdict);
  archive.seldom_choice("search", g.stopped, Words<bool>{{true, "stopped"}, {false, "ended"}}, false);
  archive.seldom_choice("search_work", g.exhausted, Words<bool>{{true, "all_taken"}, {false, "within"}},
                        false);
  archive.seldom_choice("numbers_of", g.balanced, Words<bool>{{true, "balance"}, {false, "motion"}}, false);
  archive.seldom_choice("better_swapped", g.better_swapped, Words<bool>{{true, "yes"}, {false, "no"}}, false);
  archive.seldom("answer", d.result.answer);
  archive("effects", g.effects);
  archive("group", g.group);
  archive.list("added", g.added);
  archive.single("gap", g.mismatch);
  archive.seldom("model_gap", g.model_gap);
  archive("undetermined_rad", g.undetermined);
  archive.seldom("whole_run", g.whole_run);
  archive.added_list("held_out_runs", g.held_out_runs);
  archive.addition("looked_at_hz", g.looked_at_hz);
  archive.seldom("as_configured", g.as_configured);
  archive.single("error_budget", g.budget);
  archive.list("ranking", g.ranking);
  archive("outside_catalogue_probability", g.outside_probability);
  archive.list("steps", g.steps);
  archive.added_list("detectable", g.detectable);
  archive.list("periodic_torque", g.periodic);
  archive.added_list("laws", g.laws);
  archive.single("next_experiment", g.next_experiment);
  archive.single("where", g.where);
  archive.single("remaining", g.remaining);
  archive("sentence", g.sentence);
  archive.list("measures", g.measures);
  archive.seldom("closed_loop", g.closed_loop);
  archive.seldom("closed_loop_fit", g.loop);
  archive.named("blame", g.blame, &BlameShift::key);
  archive.added_list("refitted", g.refitted);
  archive.seldom("held_numbers", g.held);
  archive.seldom("modelled", g.modelled);
  archive("observer_hz", g.observer_hz);
  archive.added_list("doubts", g.doubts);
  archive("warnings", g.warnings);
  archive("name", d.result.name);
  archive("version", d.result.version);
  coordinates_field(archive, d.result.coordinates);
  archive.seldom("input", d.result.input);
  archive.seldom("simulated_data", d.result.simulated_data);
  archive.configuration(d.result.configuration);
  archive.added_list("sources", d.result.sources);
  archive.list("held_out", d.held_out);
  archive.seldom("simulated", d.simulated);
}

}  // namespace gapscope::internal::results
