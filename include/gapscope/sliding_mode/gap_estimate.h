#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gapscope/base/remark.h"
#include "gapscope/base/statistics.h"

namespace gapscope {

enum class GapVerdict { kNotRun, kBacklash, kNone, kInconclusive };
enum class GapMethod { kImpact, kPaper, kLiteral, kLostMotion, kReversal };
enum class GapQuantity {
  kGap,
  kFirstGap,  ///< of several in series, as a second impact or a fitted model says; the whole is larger
  kPlayAtZeroTorque
};

/// What a lost motion consists of, as far as the loops tell.
enum class LostMotionCause {
  kNotRead,
  kGap,       ///< mostly a gap: x1 runs free on each ramp over most of it
  kFriction,  ///< friction and compliance: x1 runs free nowhere, or it grows with the torque
  kOpen,      ///< cannot be told
};

/// How far a reading can be relied on.
enum class GapTrust {
  kNone,     ///< none is told
  kLimited,  ///< it is what it is told as, but something that it presumes was not seen, or was contradicted
  kGood,     ///< of readings told so, on drives that others made, 95 % lie in their interval
};

const char* to_string(GapVerdict verdict);     ///< "not_run", "backlash", "none", "inconclusive"
const char* to_string(GapMethod method);       ///< "impact", "paper", "literal", "lost_motion", "reversal"
const char* to_string(GapQuantity quantity);   ///< "gap", "play_at_zero_torque"
const char* to_string(GapTrust trust);         ///< "none", "limited", "good"
const char* to_string(LostMotionCause cause);  ///< "not_read", "gap", "friction_and_compliance", "open"

/// One passage of the gap: contact lost at t1 (S3), regained at t2 (S4).
struct GapEvent {
  std::string file;               ///< recording it was found in
  double t1 = kNaN;               ///< [s]; NaN: only the impact is seen
  double t2 = kNaN;               ///< [s]
  double x1_t1 = kNaN;            ///< [rad]
  double x1_t2 = kNaN;            ///< [rad]
  double gap = kNaN;              ///< estimate of 2β from this passage [rad]
  double gap_uncorrected = kNaN;  ///< S5 as published, |x1(t2) − x1(t1)| [rad]
  double std = kNaN;              ///< standard error of `gap` [rad]
  int direction = 0;              ///< +1: the motor crossed the gap with rising x1; −1: falling
  bool accepted = true;           ///< false: seen, but not used in the estimate
  std::string remark;             ///< why it was not used, or what was corrected
  double t_c = kNaN;              ///< e_x of `traces` is at rest since [s]; NaN: it was not just before t1
};

/// The error signal e_x (forward Euler) that shows t1 and t2, one per recording; kept for the figures.
struct ErrorTrace {
  std::string file;
  std::vector<double> error;     ///< e_x [rad], as long as the recording
  std::vector<double> velocity;  ///< ŵ1 [rad/s]
};

/// How far each bound's |e_x| is above its floor, over a few strokes of one recording; kept for the figures.
struct BoundMap {
  std::string file;
  double start = 0.0;          ///< beginning of the first column [s]
  double dt = 0.0;             ///< width of a column [s]
  std::vector<double> bounds;  ///< L, rising [rad/s²]
  std::vector<double> levels;  ///< largest |e_x|/floor within a column (n_columns × n_bounds) [-]
  std::size_t columns() const { return bounds.empty() ? 0 : levels.size() / bounds.size(); }
};

/// What the quasi-static loops of one torque level read.
struct LostMotionLevel {
  double amplitude = kNaN;    ///< of the ramps [unit of u]
  double lost_motion = kNaN;  ///< travel of x1 between both branches at zero torque [rad]
  Interval ci95;              ///< [rad]
  int ramps = 0;              ///< passages of zero torque that it was read from
  double free_run = kNaN;     ///< travel over which x1 runs free, median over the branches [rad]
  double flank = kNaN;        ///< compliance of the loaded flank [rad per unit of u]
};

/// The lost motion of gear testing: measured wherever x1 is a quasi-static loop of u, whatever it means.
struct LostMotion {
  double value = kNaN;                  ///< of all levels where they agree, else of the smallest torque [rad]
  Interval ci95;                        ///< [rad]
  double gap_limit = kNaN;              ///< no gap can be larger than this [rad]; NaN: no such limit
  double limit_amplitude = kNaN;        ///< of the ramps that set this limit [unit of u]
  std::vector<LostMotionLevel> levels;  ///< by rising torque; empty: there is no loop
  LostMotionCause cause = LostMotionCause::kNotRead;
  Remark meaning;  ///< what speaks for the cause
  bool read() const { return !levels.empty(); }
  /// By ramps larger than the smallest, which need not have overcome the friction.
  bool limited_by_larger() const { return read() && limit_amplitude > levels.front().amplitude; }
  Interval range() const;  ///< smallest and largest of the levels [rad]
};

/// Something that a reading takes for true, and what the recordings say of it.
struct ReadingTest {
  Remark what;  ///< such as "same in both directions"
  bool passed = false;
};

/// What the model-free detector says. A default-built one says that it was not run.
struct GapEstimate {
  GapVerdict verdict = GapVerdict::kNotRun;
  Remark reason = Remark("not_run", "detect_gap() was not called.");  ///< never empty for kInconclusive
  GapMethod method = GapMethod::kImpact;
  GapQuantity quantity = GapQuantity::kGap;
  double gap = kNaN;                   ///< 2β̂ [rad]; NaN unless the verdict is kBacklash
  double std = kNaN;                   ///< of the estimate; by kLiteral the scatter of its passages [rad]
  Interval ci95;                       ///< [rad]; kLiteral claims none
  double smallest_visible_gap = kNaN;  ///< [rad], for loads that the reason names; always there for kNone
  double gap_at_most = kNaN;           ///< no gap is larger [rad]; NaN: no such bound is known
  double whole = kNaN;                 ///< kFirstGap: all gaps together, by the second impact [rad]
  double bound = kNaN;                 ///< L that decided t2 [rad/s²]
  double bound_t1 = kNaN;              ///< L whose e_x is in `traces`, where a bank has read [rad/s²]
  double paper_bound = kNaN;           ///< lower end of (13), where a model gave one [rad/s²]
  double scale = 1.0;                  ///< N of step S2: e_x × N is comparable with x1
  LostMotion lost_motion;              ///< beside the verdict, whatever that is
  std::vector<GapEvent> events;
  std::vector<ErrorTrace> traces;
  std::optional<BoundMap> map;
  GapTrust trust = GapTrust::kNone;
  std::vector<Remark> presumes;     ///< what a reading takes for true that no test of these recordings holds
  std::vector<ReadingTest> tested;  ///< what was looked at; what failed limits the trust
  std::vector<Remark> warnings;

  /// No gap is larger, where the verdict denies one: what binds most of what would have shown and what the
  /// loop of the smallest torque leaves room for [rad].
  double none_above() const;
  bool by_one_bound() const { return method == GapMethod::kPaper || method == GapMethod::kLiteral; }
  std::string brief_report() const;  ///< one line: log, command line
};

}  // namespace gapscope
