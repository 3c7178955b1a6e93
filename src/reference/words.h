#pragma once

#include <string>
#include <vector>

#include "gapscope/base/doubt.h"
#include "gapscope/base/remark.h"
#include "reference/information.h"

/// Everything that the fit says, in one place. Values and units as the parameters have them.
namespace gapscope::internal::reference::words {

/// What would bring a parameter out: "faster changes of the input".
std::string excitation_for(const std::string& key);

// How it ended.
Remark diverges();
Remark iterations_ran_out();
Remark not_explained(double floors, double observer_hz);
Remark leaves_some(double unexplained_percent, double observer_hz);
Remark free_run_departs(double observer_hz);
Remark not_random(double lag1, double quantiser);
Remark input_timing(const InputTiming& timing);
Remark worse_than_still(double ratio);

// Where it began.
/// @param begun  the start in its place
Remark impossible_start(const std::string& key, double start, double begun, const std::string& unit);

// What is determined.
Remark at_bound(const std::string& key, double value, const std::string& unit);
Remark no_trace(const std::string& key);
Remark like_initial_state(const std::string& key);
/// @param changes  relative, along the direction that leaves no trace
Remark change_together(const std::vector<std::string>& keys, const std::vector<double>& changes);
/// @param partner  empty: none
Remark not_determined(const std::string& key, double std, const std::string& unit,
                      const std::string& partner);
Remark no_information(const std::string& key);
Remark little_known(const std::string& key, double percent);

// How far it is trusted.
Remark at_the_floor(double fit_percent);
Remark failed_to_fit();
/// @param share  0 to 1, and more where a coasting motor predicts better
Remark leaves_unexplained(double share, double floors);
Remark as_well_without_gap(double ratio);
Remark gap_bears_little(double ratio, double floors);
Remark gap_differs();
Remark odd_coupling(const std::string& key, double value, const std::string& unit);
Remark not_settled();
Remark gap_at_bound();
Remark gap_not_determined();
Remark parts_disagree();
Remark above_floor(double fit_percent, double floors, double unexplained_percent);
Remark residual_patterned();
Remark pressed_by_bound(const std::vector<std::string>& keys);
Remark other_law(const std::string& law);
Remark input_mistimed(const InputTiming& timing);

// What speaks against any number that is fitted.
Doubt mistimed(const InputTiming& timing);
Doubt patterned(const Correlation& correlation);

// What differs from part to part.
struct ValueShift {
  std::string key;
  double from, to;
  std::string unit;
};
Remark another_gap(double from, double to);
Remark values_move(const Remark& where, const std::vector<ValueShift>& moved);
Remark between_recordings(const std::string& from, const std::string& to);  ///< "from a.csv to b.csv"
Remark between_parts(double split);
Remark between_gains(double from_hz, double to_hz);

}  // namespace gapscope::internal::reference::words
