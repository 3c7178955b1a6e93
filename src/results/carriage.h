#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gapscope/diagnosis/added_effect.h"
#include "gapscope/results/certificate.h"

namespace gapscope {

/// How a format says one part of a drive.
struct Carriage {
  std::string_view part;  ///< a parameter of the drive or an effect
  Fidelity fidelity;
  const char* how;
  std::string_view exact_without = {};  ///< a parameter of the effect: at its neutral value all is exact
  std::string_view only_at_one = {};    ///< a parameter of the effect: at another value it is left out
};

/// What a format of `export` has of a drive; what the table does not name is left out.
struct TargetTable {
  std::string_view format;  ///< the word by which it is asked for
  std::span<const Carriage> parts;
};

/// All formats, in the order in which they are offered.
std::span<const TargetTable> target_tables();

/// The table of a format.  @throws std::logic_error where there is none of that name
std::span<const Carriage> carriage_of(std::string_view format);

/// The formats that have a drive and all that was added to its model exactly, first those that are offered
/// first.
/// @param gap  the model has one
std::vector<std::string> carriers_of(std::span<const AddedEffect> added, bool gap);

/// The effects that no format has exactly.
std::vector<std::string> carried_by_none(std::span<const AddedEffect> added);

}  // namespace gapscope
