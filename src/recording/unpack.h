#pragma once

#include <string>
#include <string_view>

namespace gapscope::internal::recording {

/// Bytes that were compressed, of a size that is known; takes no more memory than that.
/// @param compression  "", "lz4" (frames) or "zstd"
/// @param problem  why there are none: damaged, or a compression that this build has not
bool unpack(const std::string& compression, std::string_view packed, std::size_t size, std::string& to,
            std::string& problem);

}  // namespace gapscope::internal::recording
