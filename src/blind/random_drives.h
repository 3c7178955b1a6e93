#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace gapscope {

enum class RandomDriveKind { kGap, kGapFree };

/// Writes recordings of random drives, made by the independent plant, with what its estimators may know:
///   <kind>_<seed>.csv   t, u, x1
///   <kind>_<seed>.yaml  a configuration for `gapscope run`; its model is a data sheet off by up to 20 %
///   truth.csv           one row a drive: what the sheet does not say
/// A drive is a function of its seed alone.
/// @param progress called after each drive with the number done; may be empty
/// @throws std::runtime_error when a file cannot be written.
void write_random_drives(RandomDriveKind kind, std::uint64_t first_seed, std::uint64_t last_seed,
                         const std::string& folder, const std::function<void(std::uint64_t)>& progress = {});

}  // namespace gapscope
