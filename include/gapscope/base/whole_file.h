#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace gapscope {

/// Makes an empty file in the folder of another one, under a name that nobody has or could have guessed.
/// @throws std::runtime_error naming `path` where none can be made
std::string new_file_beside(const std::string& path);

/// Content identity of the file that another one may take the place of; empty: the name is free and stays so.
/// Nothing: whatever is there as the writing begins.
using Replaceable = std::optional<std::string>;

/// Writes a file aside, under a name of its own, and gives it its name when it is complete: nobody ever finds
/// a part of it, what was there before stays until then, and of two that write the same file one is whole.
/// Who may read the one before may read this one. A pipe or a device is written as it is, and so is what the
/// process has open anyway (/dev/stdout, /dev/fd/N): where that is written to next, as its handle allows.
/// @throws std::runtime_error where it cannot be written, ConfigError for a link to another file, which would
/// be lost; nothing is left of it
/// @param found  whatever else is there by then stays, and is told
void write_whole_file(const std::string& path, const std::function<void(std::ostream&)>& write,
                      Replaceable found = {});

}  // namespace gapscope
