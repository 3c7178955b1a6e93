#pragma once

#include <string>
#include <vector>

#include "gapscope/base/encoder_side.h"
#include "gapscope/base/remark.h"
#include "gapscope/recording/recording_file.h"
#include "gapscope/recording/units.h"

namespace gapscope {

/// What a recording's columns are: what is declared, and what is taken for granted of the rest.
struct ColumnGuess {
  std::string time, input, position, speed, target;              ///< their names; empty: there is none
  std::string time_unit, input_unit, position_unit, speed_unit;  ///< empty: not known, or in the name
  RegisterForm input_form, position_form;  ///< of signed registers that were read as unsigned ones
  bool whole_positions = false;            ///< those of the first rows are whole numbers
  EncoderSide side = EncoderSide::kMotor;  ///< whose position is looked for
  std::vector<Remark> told = {};           ///< what was taken for granted
};

/// Fills in what is empty: columns by the words of their names (of a table without names by their order:
/// time, input, position; the time is the column that rises), units by a row below the names, and that of a
/// time by how it goes on. A target is looked for where there is no input, a speed where there is no
/// position.
/// @param rated  the rows come at a rate: no time is looked for
/// @throws ConfigError where a column cannot be told, with what there is and how to name it; where the file
/// is none
ColumnGuess guess_columns(const std::string& path, ColumnGuess declared, bool rated);

/// What the rows of a file come at in the mean by the column that has the time by its name [Hz].
struct NamedRate {
  std::string column;  ///< empty: there is none that rises
  double rate = 0.0;
};
NamedRate named_rate(const std::string& path, const RecordingColumns& columns);

}  // namespace gapscope
