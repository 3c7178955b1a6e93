#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace gapscope {

/// Makes an empty file in the folder of another one, under a name that nobody has or could have guessed.
/// @throws std::runtime_error naming `path` where none can be made
std::string new_file_beside(const std::string& path);

/// Changes with whatever is done to a file or to its name; empty where there is none.
std::string identity_of(const std::string& path);

/// Changes with what is written into a file or put in its place, not with its name; empty where there is
/// none. Taken before a look at whether a file may go: what came after it is not what was looked at.
std::string content_identity(const std::string& path);

/// Content identity of the file that another one may take the place of; empty: the name is free and stays so.
/// Nothing: whatever is there as the writing begins.
using Replaceable = std::optional<std::string>;

/// A rename over what was found at the new name. Whatever else came there stays, and is told.
/// @throws ConfigError where something else is there by now, std::runtime_error where it cannot be done
void replace_file(const std::string& found, const std::string& from, const std::string& to);

/// A rename that takes nobody's place.
/// @returns false where something is there already  @throws std::runtime_error where it cannot be done
bool moved_where_nothing_is(const std::string& from, const std::string& to);

/// Writes a file aside, under a name of its own, and gives it its name when it is complete: nobody ever finds
/// a part of it, what was there before stays until then, and of two that write the same file one is whole. A
/// pipe or a device is written as it is.
/// @throws std::runtime_error where it cannot be written, ConfigError for a link to another file, which would
/// be lost; nothing is left of it
/// @param found  whatever else is there by then stays, and is told
void write_whole_file(const std::string& path, const std::function<void(std::ostream&)>& write,
                      Replaceable found = {});

}  // namespace gapscope
