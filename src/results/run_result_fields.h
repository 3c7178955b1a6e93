#pragma once

#include <string>
#include <vector>

#include "results/answer_fields.h"
#include "results/json_archive.h"
#include "results/run_result.h"
#include "results/shared_fields.h"

/// The fields of a stored result, each named once. The first ones of every list are those that readers
/// outside the project rely on; the rest is what a report needs beside them.
namespace gapscope::internal::results {

inline constexpr const char* kSchema = "gapscope.result/1";

/// A recording without its columns, which are in the trace file.
struct StoredRecording {
  std::string trace;
  int samples = 0;
  bool has_error = false, has_fit = false;
  Recording recording;
};

/// The document: a run result whose recordings are replaced by what the JSON keeps of them.
struct Document {
  std::string schema = kSchema;
  RunResult run;
  std::vector<StoredRecording> recordings;
};

template <class Archive>
void fields(Archive& archive, GapEvent& e) {
  archive("file", e.file);
  archive("t1_s", e.t1);
  archive("t2_s", e.t2);
  archive("x1_t1_rad", e.x1_t1);
  archive("x1_t2_rad", e.x1_t2);
  archive("gap_rad", e.gap);
  archive("direction", e.direction);
  archive("gap_uncorrected_rad", e.gap_uncorrected);
  archive("std_rad", e.std);
  archive("accepted", e.accepted);
  archive("remark", e.remark);
  archive.added("t_c_s", e.t_c);
}

/// Its levels are in a file of their own.
template <class Archive>
void fields(Archive& archive, BoundMap& m) {
  archive("file", m.file);
  archive("start_s", m.start);
  archive("column_s", m.dt);
  archive("bounds_rad_s2", m.bounds);
}

template <class Archive>
void fields(Archive& archive, LostMotionLevel& l) {
  archive("amplitude_u", l.amplitude);
  archive("lost_motion_rad", l.lost_motion);
  archive("ci95_rad", l.ci95);
  archive("ramps", l.ramps);
  archive("free_run_rad", l.free_run);
  archive("flank_rad_per_u", l.flank);
}

/// What the one number beside it is made of and means.
template <class Archive>
void fields(Archive& archive, LostMotion& m) {
  archive.choice("cause", m.cause,
                 Words<LostMotionCause>{{LostMotionCause::kNotRead, "not_read"},
                                        {LostMotionCause::kGap, "gap"},
                                        {LostMotionCause::kFriction, "friction_and_compliance"},
                                        {LostMotionCause::kOpen, "open"}});
  archive("meaning", m.meaning);
  archive("gap_limit_rad", m.gap_limit);
  archive("gap_limit_amplitude_u", m.limit_amplitude);
  archive.list("levels", m.levels);
}

template <class Archive>
void fields(Archive& archive, ReadingTest& t) {
  archive("test", t.what);
  archive("passed", t.passed);
}

template <class Archive>
void fields(Archive& archive, GapEstimate& g) {
  archive.choice("verdict", g.verdict,
                 Words<GapVerdict>{{GapVerdict::kBacklash, "backlash"},
                                   {GapVerdict::kNone, "none"},
                                   {GapVerdict::kInconclusive, "inconclusive"}});
  archive("reason", g.reason);
  archive.choice("method", g.method,
                 Words<GapMethod>{{GapMethod::kImpact, "impact"},
                                  {GapMethod::kPaper, "paper"},
                                  {GapMethod::kLiteral, "literal"},
                                  {GapMethod::kLostMotion, "lost_motion"},
                                  {GapMethod::kReversal, "reversal"}});
  archive.choice("quantity", g.quantity,
                 Words<GapQuantity>{{GapQuantity::kGap, "gap"},
                                    {GapQuantity::kFirstGap, "first_gap"},
                                    {GapQuantity::kPlayAtZeroTorque, "play_at_zero_torque"}});
  archive("gap_rad", g.gap);
  archive("std_rad", g.std);
  archive("ci95_rad", g.ci95);
  archive.added("lost_motion_rad", g.lost_motion.value);
  archive.added("lost_motion_ci95_rad", g.lost_motion.ci95);
  archive.added("lost_motion", g.lost_motion);
  archive("smallest_visible_gap_rad", g.smallest_visible_gap);
  archive.added("whole_gap_rad", g.whole);
  archive.added("gap_at_most_rad", g.gap_at_most);
  archive.added_choice(
      "trust", g.trust,
      Words<GapTrust>{{GapTrust::kNone, "none"}, {GapTrust::kLimited, "limited"}, {GapTrust::kGood, "good"}},
      GapTrust::kNone);
  archive.added("presumes", g.presumes);
  archive.added_list("tested", g.tested);
  archive("bound_rad_s2", g.bound);
  archive("bound_t1_rad_s2", g.bound_t1);
  archive("paper_bound_rad_s2", g.paper_bound);
  archive("scale", g.scale);
  archive("warnings", g.warnings);
  archive.list("events", g.events);
  archive.part("bound_map", g.map);
}

template <class Archive>
void fields(Archive& archive, FittedParameter& p) {
  archive("value", p.value);
  archive("unit", p.unit);
  archive("std", p.std);
  archive("ci95", p.ci95);
  archive("identifiable", p.identifiable);
  archive("estimated", p.estimated);
  archive("at_bound", p.at_bound);
  archive("start", p.start);
  archive("profile_ci95", p.profile_ci95);
  archive.bound("low", p.low);
  archive.bound("high", p.high);
}

template <class Archive>
void fields(Archive& archive, FittedStart& s) {
  archive("file", s.file);
  archive("x1_rad", s.state.x1);
  archive("w1_rad_s", s.state.w1);
  archive("x2_rad", s.state.x2);
  archive("w2_rad_s", s.state.w2);
}

template <class Archive>
void fields(Archive& archive, FitPiece& p) {
  archive("recording", p.recording);
  archive("samples", p.samples);
  archive("square", p.square);
  archive("slope", p.slope);
  archive("normal", p.normal);
}

template <class Archive>
void fields(Archive& archive, ModeError& m) {
  archive.choice("mode", m.mode,
                 Words<Mode>{{Mode::kGap, "gap"},
                             {Mode::kEngagementPlus, "engagement+"},
                             {Mode::kEngagementMinus, "engagement-"},
                             {Mode::kImpact, "impact"}});
  archive("samples", m.samples);
  archive("rmse_rad", m.rmse);
}

template <class Archive>
void fields(Archive& archive, ResidualTest& t) {
  archive("lags_outside", t.outside);
  archive("worst_in_bands", t.worst);
  archive("worst_lag_s", t.worst_lag);
}

template <class Archive>
void fields(Archive& archive, FitStructure& s) {
  archive("laws", s.laws);
  archive("gap_low_rad", s.gap_low);
  archive("gap_high_rad", s.gap_high);
}

template <class Archive>
void fields(Archive& archive, FitSummary& f) {
  bool converged = f.converged();  // follows from the status, kept for readers of the file
  archive("converged", converged);
  archive("rmse_rad", f.rmse);
  archive.choice("status", f.status,
                 Words<FitStatus>{{FitStatus::kNotRun, "not_run"},
                                  {FitStatus::kConverged, "converged"},
                                  {FitStatus::kNotConverged, "not_converged"},
                                  {FitStatus::kFailed, "failed"}});
  archive("message", f.message);
  archive.added_choice(
      "trust", f.trust,
      Words<FitTrust>{
          {FitTrust::kGood, "good"}, {FitTrust::kLimited, "limited"}, {FitTrust::kRejected, "rejected"}},
      FitTrust::kLimited);
  archive.addition("why", f.why);
  archive.addition("fit_percent", f.fit_percent);
  archive.named("parameters", f.parameters, &FittedParameter::key);
  std::vector<std::string> at_bound = f.at_bound();  // follows from the parameters
  archive.seldom("at_bound", at_bound);
  archive.seldom("structure", f.structure);
  archive("floor_rad", f.floor);
  archive("innovation_rmse_rad", f.innovation_rmse);
  archive.addition("coasting_rmse_rad", f.coasting_rmse);
  archive.addition("without_gap_ratio", f.without_gap_ratio);
  archive("observer_hz", f.observer_hz);
  archive("objective_hz", f.objective_hz);
  archive("starts", f.starts);
  archive("simulations", f.simulations);
  archive("lag1_autocorrelation", f.lag1_autocorrelation);
  archive.addition("input_early_rows", f.input_timing.early_rows);
  archive.addition("input_early_std_rows", f.input_timing.std_rows);
  archive.single("whiteness", f.whiteness);
  archive.single("input_correlation", f.input_correlation);
  archive("start_costs", f.start_costs);
  archive.list("mode_errors", f.mode_errors);
  archive.list("initial_states", f.initial_states);
  archive.added_list("pieces", f.pieces);
  archive("advice", f.advice);
  archive("warnings", f.warnings);
}

template <class Archive>
void fields(Archive& archive, Comparison& c) {
  archive("difference_rad", c.difference);
  archive("joint_std_rad", c.joint_std);
  archive("agree", c.agree);
  archive("x2_map_gap_rad", c.map_width);
}

template <class Archive>
void fields(Archive& archive, SecondEncoder& s) {
  archive("x2_rmse_rad", s.rmse);
  archive("x1_rmse_rad", s.motor_rmse);
  archive("fit_percent", s.fit_percent);
  archive("floor_rad", s.floor);
  archive("map_gap_rad", s.gap);
  archive("gap_difference_rad", s.difference);
}

template <class Archive>
void fields(Archive& archive, StoredRecording& r) {
  archive("file", r.recording.file);
  archive("trace", r.trace);
  archive("samples", r.samples);
  archive("start_s", r.recording.start);
  archive("dt_s", r.recording.dt);
  archive("quantum_rad", r.recording.quantum);
  archive("resampling", r.recording.resampling);
  archive("error_trace", r.has_error);
  archive("fit_trace", r.has_fit);
  encoder_side_field(archive, r.recording.encoder);
}

template <class Archive>
void fields(Archive& archive, Document& d) {
  archive("schema", d.schema);
  archive("name", d.run.name);
  archive("version", d.run.version);
  coordinates_field(archive, d.run.coordinates);
  archive.seldom("input", d.run.input);
  archive.seldom("answer", d.run.answer);
  archive.part("model_free", d.run.model_free);
  archive.seldom("literal", d.run.literal);
  archive.part("reference", d.run.reference);
  archive.part("comparison", d.run.comparison);
  archive.seldom("second_encoder", d.run.second_encoder);
  archive("simulated_gap_rad", d.run.simulated_gap);
  archive.added_list("doubts", d.run.doubts);
  archive("notes", d.run.notes);
  archive.seldom("simulated_data", d.run.simulated_data);
  archive.configuration(d.run.configuration);
  archive.added_list("sources", d.run.sources);
  archive.list("recordings", d.recordings);
}

template <class Archive>
void fields(Archive& archive, Timing& t) {
  archive("model_free_s", t.model_free_s);
  archive("reference_s", t.reference_s);
  archive.addition("wall_s", t.wall_s);
  archive.addition("literal_s", t.literal_s);
}

}  // namespace gapscope::internal::results
