#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/encoder_side.h"
#include "gapscope/base/remark.h"
#include "gapscope/recording/controller.h"

namespace gapscope {

/// What the coupling did during a sample (the paper's words). Impact: a contact closed within the sample.
/// A drive of one body has no coupling.
enum class Mode : signed char {
  kEngagementMinus = -1,
  kGap = 0,
  kEngagementPlus = 1,
  kImpact = 2,
  kOneBody = 3
};

/// "gap", "engagement+", "engagement-", "impact" or "one_body": the words of the mode column of a simulated
/// recording.
const char* to_string(Mode mode);

/// What the load of one recording has beyond that of the model, as where another mass hung on the arm.
struct AddedLoad {
  double inertia = 0.0;  ///< [kg m²]; of a lighter load negative
  double gravity = 0.0;  ///< torque of its weight where the arm is level [N m]

  bool is_none() const { return inertia == 0.0 && gravity == 0.0; }
};

/// The view that estimators take: one encoder and the input, nothing of the other body.
struct MotorTrace {
  std::string file;                  ///< name of the recording, for events and messages
  double start = 0.0;                ///< time of the first sample [s]
  double dt = 0.0;                   ///< sampling interval, of uneven sampling the mean one [s]
  std::span<const double> u;         ///< input, held from its own sample to the next [unit of u]
  std::span<const double> x1;        ///< position that the encoder reads, before u acts [rad]: the motor's,
                                     ///< or the load's where the structure of the drive says so
  double quantum = 0.0;              ///< encoder quantum [rad]; 0 = unknown
  std::span<const double> stamps{};  ///< time of each sample [s]; empty: evenly sampled
  const CommandRows* command = nullptr;  ///< what u was made of by a controller; null: it was recorded
  std::size_t command_first = 0;         ///< the row of the first sample
  std::span<const double> sent{};  ///< what a controller sends at its own sample, to act `delay` later: where
                                   ///< there is any, u is its mean over each interval
  double delay = 0.0;              ///< [s]
  AddedLoad load{};                ///< beyond that of the model

  std::size_t size() const { return x1.size(); }
  bool even() const { return stamps.empty(); }
  double time(std::size_t i) const { return even() ? start + dt * static_cast<double>(i) : stamps[i]; }
  /// Time since the first sample [s].
  double elapsed(std::size_t i) const { return even() ? dt * static_cast<double>(i) : stamps[i] - start; }
  /// Time from sample i to the next, in which u[i] acts; of the last sample dt [s].
  double step(std::size_t i) const {
    return even() || i + 1 >= stamps.size() ? dt : stamps[i + 1] - stamps[i];
  }
};

/// What a controller makes of the rows of a recording that has a command.
template <class T>
std::vector<T> commanded_input(const ControllerOf<T>& controller, const MotorTrace& recording) {
  return commanded_input(controller, *recording.command, recording.command_first, recording.size());
}

/// A recording, simulated or recorded. All filled columns have the same length.
struct Recording {
  std::string file;        ///< name of the file (or of the simulation)
  double start = 0.0;      ///< time of the first sample [s]
  double dt = 0.0;         ///< sampling interval, of uneven sampling the mean one [s]
  std::vector<double> u;   ///< [unit of u]
  std::vector<double> x1;  ///< motor position [rad]; empty if unknown
  std::vector<double> x2;  ///< load position [rad]; empty if unknown
  std::vector<Mode> mode;  ///< empty unless simulated
  double quantum = 0.0;    ///< encoder quantum of the sheet, else the one seen in the raw samples [rad]
  std::string resampling;  ///< what was done to make the sampling uniform; empty if nothing was
  bool open_end = false;   ///< the last line of its file has no end: the last number may be cut off
  std::vector<double> stamps = {};                  ///< time of each sample [s]; empty: evenly sampled
  EncoderSide encoder = EncoderSide::kMotor;        ///< whose position estimators read; never the other one
  std::shared_ptr<const CommandRows> command = {};  ///< what u was made of by a controller; null: recorded
  std::size_t command_first = 0;                    ///< the row of the first sample
  std::vector<double> sent = {};                    ///< see MotorTrace; empty: u is all there is
  double delay = 0.0;                               ///< of what was sent [s]
  std::vector<Remark> assumed = {};  ///< how its file was read, where that does not go without saying
  AddedLoad load = {};               ///< beyond that of the model

  /// What estimators read [rad].
  const std::vector<double>& position() const { return encoder == EncoderSide::kLoad ? x2 : x1; }
  std::size_t size() const { return position().size(); }
  bool even() const { return stamps.empty(); }
  double time(std::size_t i) const { return even() ? start + dt * static_cast<double>(i) : stamps[i]; }
  double duration() const { return dt * static_cast<double>(size()); }
  MotorTrace motor_trace() const {
    return {file, start, dt, u, position(), quantum, stamps, command.get(), command_first, sent, delay, load};
  }
};

/// Whether each update of the controller is at a row of the recording.
bool updates_at_rows(const DriveController& controller, const MotorTrace& recording);

/// Gives a recording that has a command the input that this controller makes of it. Where each update is at a
/// row and acts later, what was sent and its delay stand beside u: a model can then be moved exactly.
void command_by(const DriveController& controller, Recording& recording);

/// `count` samples from `first` on, with their own start time; dt stays that of the whole. The view must not
/// outlive what it looks at.
/// @throws std::logic_error if there are not that many.
Recording part(const Recording& recording, std::size_t first, std::size_t count);
MotorTrace part(const MotorTrace& trace, std::size_t first, std::size_t count);

/// The quantum that raw encoder samples show: the smallest step that recurs, steps of less than 1e-6 of the
/// range taken as text rounding, on whose multiples the others lie [rad]. 0 if the samples show none (fewer
/// than 20 steps, or a smooth signal).
double seen_quantum(std::span<const double> x1);

}  // namespace gapscope
