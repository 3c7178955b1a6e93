#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "exports/export_source.h"
#include "gapscope/results/certificate.h"
#include "results/carriage.h"

namespace gapscope::internal::exports {

/// Every number that the drive has and every effect, as the table says; what it does not name is left out.
/// @param otherwise  why, and what would help
std::vector<CarriedPart> carried_parts(const ExportSource& source, std::span<const Carriage> table,
                                       const char* otherwise);

/// The value of an effect's parameter; 0 where it has none of that name.
double value_in(const ModelEffect& effect, std::string_view parameter);

/// The same of an effect by its name; 0 where the drive does not have the effect; of several
/// the first one.
double effect_value(const ExportSource& source, std::string_view effect, std::string_view parameter);

/// Whether a load_unbalance of the drive can be a mass beside the axis: once per turn of a rotating one.
bool hangs_from_the_axis(const ExportSource& source);

}  // namespace gapscope::internal::exports
