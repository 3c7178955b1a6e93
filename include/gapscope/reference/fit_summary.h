#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gapscope/base/remark.h"
#include "gapscope/base/statistics.h"
#include "gapscope/plant/drive.h"
#include "gapscope/recording/recording.h"

namespace gapscope {

enum class FitStatus { kNotRun, kConverged, kNotConverged, kFailed };

/// How far the numbers of a fit can be relied on.
///   good      the model leaves what the encoder leaves: intervals mean what they say
///   limited   usable, with what `why` names in mind
///   rejected  the model misses the recordings by more than their noise and repeatability explain, or what it
///             says of the gap is not in them: its numbers stand without intervals
enum class FitTrust { kGood, kLimited, kRejected };

const char* to_string(FitTrust trust);  ///< "good", "limited", "rejected"

struct FittedParameter {
  std::string key;  ///< as in the YAML
  std::string unit;
  double start = kNaN;
  double value = kNaN;
  double std = kNaN;
  Interval ci95;          ///< NaN bounds when it is not identifiable or not estimated
  Interval profile_ci95;  ///< where the profile likelihood falls by that of 95 %; NaN unless asked for
  double low = kNaN;      ///< bounds
  double high = kNaN;
  bool estimated = false;     ///< false: fixed at its value
  bool identifiable = false;  ///< estimated and determined by the recordings
  bool at_bound = false;
};

/// Free run of the fitted model beside one recording.
struct FitTrace {
  std::string file;
  std::vector<double> x1;  ///< [rad]
  std::vector<double>
      predicted;           ///< position of the encoder by the model run as an observer, one step ahead [rad]
  std::vector<double> x2;  ///< [rad]; empty for a drive without a load behind a gap
  std::vector<Mode> mode;
  EncoderSide encoder = EncoderSide::kMotor;

  /// What the encoder would read [rad].
  const std::vector<double>& position() const { return encoder == EncoderSide::kLoad ? x2 : x1; }
};

/// Where the fitted model starts beside one recording.
struct FittedStart {
  std::string file;
  DriveState<double> state;
};

/// Residual of the free run in one mode.
struct ModeError {
  Mode mode = Mode::kGap;
  int samples = 0;
  double rmse = kNaN;  ///< [rad]
};

/// Correlations of the residual at some 40 lags against the band that holds 95 % of them where nothing is
/// left.
struct ResidualTest {
  double outside = kNaN;    ///< share of the lags outside the band [-]; 0.05 is what chance leaves
  double worst = kNaN;      ///< largest correlation in half widths of the band [-]
  double worst_lag = kNaN;  ///< where that is [s]
};

/// How much earlier than its own row the input acts, as the recordings have it. Where the input is held from
/// its row to the next, as a model takes it, that is zero. Of every second row of a drive whose loop is
/// faster than its log, half of the changes come half a row early, a quarter in the mean; of a line from row
/// to row, half a row.
struct InputTiming {
  double early_rows = kNaN;  ///< NaN: a controller makes the input, or the motion does not tell
  double std_rows = kNaN;    ///< its standard error

  /// Off by more than chance, two and a half standard errors, and by a tenth of a row: the rows are not what
  /// the model takes them for.
  bool is_off() const;
  /// Root mean square of what the recordings leave open of it, knowing that u belongs to its row: within a
  /// row a spread of a quarter [rows]; 0 where nothing is known of it.
  double open_rows() const;
};

/// What laws of contact and friction that explain the recordings as well as the model's own make of the gap.
struct FitStructure {
  std::vector<std::string> laws;           ///< in words, that of the model first
  double gap_low = kNaN, gap_high = kNaN;  ///< smallest and largest gap by them [rad]
};

/// What a piece of the recordings says of the estimated numbers, n of them in their order, near their values
/// v: what the model leaves there is square + 2 slope·d + dᵀ normal d [floor²] at v + d, the initial state of
/// each recording following. All pieces together are all recordings, each a whole one or cut into equal
/// parts.
struct FitPiece {
  int recording = 0;
  int samples = 0;
  double square = kNaN;
  std::vector<double> slope;   ///< [floor² per unit of the number] (n)
  std::vector<double> normal;  ///< lower triangle, row by row [floor² per unit of either] (n (n + 1)/2)
};

/// What the model-based reference says. A default-built one says that it was not run.
struct FitSummary {
  FitStatus status = FitStatus::kNotRun;
  Remark message = Remark("not_run", "fit() was not called.");
  FitTrust trust = FitTrust::kRejected;
  Remark why = Remark("not_run", "fit() was not called.");  ///< what the trust rests on, one sentence
  double fit_percent = kNaN;  ///< 100 (1 − |x1 − x̂1|/|x1 − mean|) of the free run, worst recording
  double rmse = kNaN;         ///< free-run − recorded position of the encoder, all recordings [rad]
  double floor = kNaN;        ///< what the encoder alone leaves [rad]
  double innovation_rmse = kNaN;    ///< one-step prediction error of the model run as an observer [rad]
  double observer_hz = kNaN;        ///< poles of that observer [Hz]
  double objective_hz = kNaN;       ///< poles of the observer that gave the values; 0: the free run [Hz]
  double coasting_rmse = kNaN;      ///< that error of an observer that knows no torque [rad]
  double without_gap_ratio = kNaN;  ///< that error with the gap closed, over that with it open; NaN: no gap
  int starts = 0;                   ///< starting points tried
  int simulations = 0;  ///< plain simulations spent, one with Jets or effects counted as its measured cost
  double lag1_autocorrelation = kNaN;       ///< of the residual [-]
  InputTiming input_timing;                 ///< by one more number of the fit
  ResidualTest whiteness;                   ///< of the residual with itself
  ResidualTest input_correlation;           ///< of the residual with the input
  std::vector<FittedParameter> parameters;  ///< estimated and fixed, in the order of the YAML keys
  std::optional<FitStructure> structure;    ///< nothing where no other law was tried
  std::vector<FittedStart> initial_states;  ///< one per recording
  std::vector<FitPiece> pieces;             ///< empty where the motion diverges
  std::vector<FitTrace> traces;
  std::vector<ModeError> mode_errors;
  std::vector<double> start_costs;  ///< final cost of each start, best first (waterfall)
  std::vector<Remark> advice;       ///< what would sharpen the parameters that are known least
  std::vector<Remark> warnings;     ///< null directions, bounds, advice: one sentence each

  bool converged() const { return status == FitStatus::kConverged; }
  bool rejected() const { return trust == FitTrust::kRejected; }
  /// The interval of one of its parameters as it may be shown: none where the fit is rejected or did not
  /// converge.
  Interval shown_interval(const FittedParameter& p) const {
    return rejected() || status == FitStatus::kNotConverged ? Interval{} : p.ci95;
  }
  std::vector<std::string> at_bound() const;  ///< keys of the estimated numbers that stand at a bound
  std::vector<std::string> given() const;     ///< keys of the numbers that it was told
  /// The fit leaves nothing of the gap, and the recordings are explained as well: the model says that there
  /// is none.
  bool closes_gap() const;
  const FittedParameter* find(const std::string& key) const;  ///< nullptr if there is none of that key
  std::string brief_report() const;                           ///< one line: log, command line
  std::string full_report() const;                            ///< table: terminal, report.md
};

}  // namespace gapscope
