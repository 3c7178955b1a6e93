#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/figure_data.h"
#include "results/run_result.h"

namespace gapscope::internal::report {

enum class StateSource { kNone, kRecorded, kFitted };

/// What the figures of a run have in common: the one recording that they show, with all that is known of it.
struct ReportView {
  explicit ReportView(const RunResult& result);

  const RunResult& run;
  /// The one with most accepted passages, else the first; nullptr: none.
  const Recording* recording = nullptr;
  const ErrorTrace* error = nullptr;  ///< nullptr where there is none
  const FitTrace* fit = nullptr;
  std::vector<GapEvent> events;  ///< of this recording, in time
  std::vector<double> time;      ///< [s]
  StateSource source = StateSource::kNone;
  std::vector<double> state;  ///< x1 − x2, recorded or fitted, around zero [rad]
  double state_offset = 0.0;  ///< that was taken off to bring it there [rad]
  double half_period = kNaN;  ///< median time from one crossing of the middle to the next [s]
  Interval window;            ///< the part that figures of single periods show [s]
  bool whole = true;          ///< the window is the whole recording
  std::string length_unit;    ///< "rad" or "m"

  std::size_t index(double t) const;  ///< of the sample nearest to a time
  std::vector<GapEvent> accepted() const;
  double true_gap() const;  ///< of the simulated plant, else read off the x1–x2 map; NaN
  std::string true_gap_name() const;

  /// The samples of an interval.
  std::span<const double> part(const std::vector<double>& values, const Interval& interval) const;
  /// A line over time, cut to an interval; of a long one no more samples than a picture can show.
  Series over_time(const std::string& label, const LineStyle& style, const std::vector<double>& values,
                   const Interval& interval) const;
  Axis time_axis(const Interval& interval) const;
  /// "Estimation error, L = 6 rad/s²": with the bound of the differentiator whose e_x is drawn.
  std::string error_title(const std::string& title = "Estimation error") const;
  /// "; L = 6 rad/s² was given", or by which rule it was chosen; empty where no e_x is drawn.
  std::string drawn_bound() const;
  bool reads_load() const { return recording && recording->encoder == EncoderSide::kLoad; }
  std::string position_name() const { return reads_load() ? "$x_2$" : "$x_1$"; }  ///< that estimators read
  std::string state_title() const;  ///< "Backlash state", and whether the model that has it was rejected
  std::string state_name() const;   ///< "backlash state $x_1 − x_2$", fitted where it is
};

}  // namespace gapscope::internal::report
