#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace gapscope {

/// `text` with every `from` in it replaced by `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// An identifier for people: "motor_coulomb_friction" reads "motor Coulomb friction".
std::string readable(const std::string& identifier);

/// The key of a parameter for people, without the SI unit of a rotation at its end: "level_nm" reads "level".
std::string name_of_key(const std::string& key);

/// A range for people: "34..51 mm/s" reads "34–51 mm/s", "-62..-53 N m" reads "-62 to -53 N·m".
std::string range_words(const std::string& range);

/// Number of letters to insert, delete or replace to make one word of the other (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The name that was probably meant: the shortest one that has the word in it, else the one that is fewest
/// letters away.
/// @param names  at least one
const std::string& nearest_name(const std::string& word, std::span<const std::string> names);

bool contains(std::span<const std::string> names, const std::string& name);

}  // namespace gapscope
