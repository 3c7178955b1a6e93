#pragma once

#include <string>

/// Moves of files where others may put or change files at the same time: nothing is lost that came or changed
/// since the last look. What a file is like at that look is told by an identity.
namespace gapscope {

/// Changes with whatever is done to a file or to its name; empty where there is none.
std::string identity_of(const std::string& path);

/// Changes with what is written into a file or put in its place, not with its name; empty where there is
/// none. Taken before a look at whether a file may go: what came after it is not what was looked at.
std::string content_identity(const std::string& path);

/// A name in the folder of a file that nobody has or could have guessed.
std::string name_beside(const std::string& path);

/// A rename that takes nobody's place.
/// @returns false where something is there already  @throws std::runtime_error where it cannot be done
bool moved_where_nothing_is(const std::string& from, const std::string& to);

/// A rename that takes nobody's place, of a file that is still as it was found. Anything else stays, or is
/// put back: where that cannot be done, what it is called then is told.
/// @returns whether it was moved  @throws std::runtime_error where it cannot be done
bool moved_if_still(const std::string& found, const std::string& from, const std::string& to);

/// Removes a file that is still as it was found; anything else stays.
/// @returns whether it was removed  @throws std::runtime_error as moved_if_still()
bool remove_file(const std::string& found, const std::string& path);

/// A rename over what was found at the new name; empty: the name is free. Whatever else came there stays, and
/// is told; the file that was to be moved is removed then. On a file system that cannot exchange two files
/// the name is free for a moment.
/// @throws ConfigError where something else is there by now, std::runtime_error where it cannot be done
void replace_file(const std::string& found, const std::string& from, const std::string& to);

}  // namespace gapscope
