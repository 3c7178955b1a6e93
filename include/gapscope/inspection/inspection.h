#pragma once

#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/remark.h"
#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording_file.h"

namespace gapscope {

inline constexpr const char* kTimeRule = "time";                ///< rows in order, none missing, uniform
inline constexpr const char* kInputRule = "input";              ///< its range and its noise
inline constexpr const char* kPositionUnitRule = "unit of x1";  ///< as declared: not counts, degrees, turns
inline constexpr const char* kEncoderRule = "encoder";          ///< its step, and the noise of a position
/// On reversals of the motion: the one rule that concerns the detector alone.
inline constexpr const char* kReversalsRule = "reversals";

/// What a finding means for the estimates: nothing, worth knowing, or they will be wrong or refused.
enum class Severity { kFine, kNote, kSpoils };

const char* to_string(Severity severity);  ///< "fine", "note", "spoils"

/// One question put to a recording, and its answer.
struct Finding {
  std::string rule;  ///< what was looked at: "time", "sign", ...; always all of them, in the same order
  Severity severity = Severity::kFine;
  std::string found;    ///< what there is, with figures
  std::string advice;   ///< what to do; empty where nothing is
  bool warned = false;  ///< a note that `init` and `diagnose` warn of as well
};

/// The figures behind the findings; NaN where one could not be had. On a translational axis rad reads m.
struct RecordingFacts {
  int samples = 0;                                   ///< rows that go forward in time
  int skipped_rows = 0;                              ///< rows that do not
  bool uniform = false;                              ///< time, as the detector expects it
  int missing_samples = 0;                           ///< that the pauses have room for
  bool coarse_clock = false;                         ///< stamps are whole ticks of 15.6 ms
  double start = kNaN, duration = kNaN;              ///< [s]
  double rate = kNaN;                                ///< one over the median step [Hz]
  double shortest_step = kNaN, longest_step = kNaN;  ///< [s]
  double quantum = kNaN;                             ///< step of the encoder [rad]
  double noise = kNaN;      ///< standard deviation of a position, rounding included [rad]
  double travel = kNaN;     ///< of x1, peak to peak, without drift [rad]
  double speed_rms = kNaN;  ///< [rad/s]
  double period = kNaN;     ///< of the motion [s]
  int half_periods = 0;
  double input_peak = kNaN;       ///< largest |u| [unit of u]
  double input_noise = kNaN;      ///< standard deviation of a sample of u [unit of u]
  double input_period = kNaN;     ///< after which u repeats itself [s]
  double input_frequency = kNaN;  ///< that holds most of the power of u [Hz]
  double line_share = kNaN;       ///< share of that power at it [-]
  Interval input_band;            ///< that 90 % of that power lies in [Hz]
  double clipped_share = kNaN;    ///< of the samples, in which u stays at its largest or smallest value [-]
  double work_cosine = kNaN;      ///< ∫u w dt/√(∫u² dt ∫w² dt): of a passive drive above zero [-]
  double inertia = kNaN;          ///< of motor and load, as one body [unit of u s²/rad]
  double damping = kNaN;          ///< [unit of u s/rad]
  double friction = kNaN;         ///< [unit of u]
  double hangs_at = kNaN;    ///< position at which what hangs on the axis hangs down, where it shows [rad]
  double feedback = kNaN;    ///< correlation of the fast part of u with that of x1 just before [-]
  double rest_share = kNaN;  ///< of the time in which x1 stands still [-]
};

/// What a recording is wanted for.
enum class Purpose { kAll, kGap, kFit, kDiagnosis };

const char* to_string(Purpose purpose);  ///< "all", "gap", "fit", "diagnosis"

/// What a recording says about itself before anything is estimated from it.
struct Inspection {
  std::string file;  ///< as it was named
  Coordinates coordinates;
  RecordingFacts facts;
  std::vector<Finding> findings;
  Purpose purpose = Purpose::kAll;   ///< that they are judged for
  std::vector<Remark> assumed = {};  ///< how the file was read, where that does not go without saying
  bool spoilt() const;               ///< whether any finding is kSpoils
  std::string report() const;        ///< a line for each finding and each advice, and the sum: terminal
};

/// Puts every question to a recording. Only t, u and x1 are looked at. Rows that do not go forward in time
/// and time that is not uniform are findings here; the other questions are then put to what is left, on a
/// uniform grid.
/// @param coordinates  of a translation: the position is in m
/// @throws ConfigError where read_recording() would for another reason than time.
Inspection inspect(const std::string& path, const ReadOptions& options = {}, Coordinates coordinates = {});

/// What spoils the answers to other questions alone becomes a note, which says so.
void judge_for(Purpose purpose, Inspection& inspection);

/// Of a current whose peak no motor has: it is likely one of mA.
/// @param unit  of u, as it was declared: "A", "V", ...; empty: none was
void judge_for_unit(const std::string& unit, Inspection& inspection);

/// Of an encoder whose step is declared, where x1 steps otherwise: what one of them makes of it is not so. Of
/// counts, which are whole numbers, a finer step spoils the estimates.
/// @param quantum  as it is declared, on the axis of x1 [rad]; 0: it is not
/// @param counts   x1 is recorded in counts of that encoder
void judge_for_encoder(double quantum, bool counts, Inspection& inspection);

/// Of an encoder on the load: no detector reads a gap there, so what the motion lacks for one spoils nothing,
/// and no motion is asked for.
void judge_for_load_encoder(Inspection& inspection);
/// Of an output that is held: a missing period, which impacts need, spoils nothing.
void judge_for_locked_output(Inspection& inspection);

}  // namespace gapscope
