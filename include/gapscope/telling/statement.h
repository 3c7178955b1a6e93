#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/statistics.h"

namespace gapscope {

/// A name in a list, and what is known of it beside: brief texts do without that.
struct ToldName {
  std::string name, aside = "";
};

/// A number of a statement, or names, by the key that its wording calls it by.
struct Fact {
  std::string key;
  double value = kNaN;
  std::string unit = "";  ///< SI, of a rotation: "rad", "N m", "s"; "%"; empty: a ratio or a count
  Interval ci95 = {};
  std::vector<ToldName> names = {};  ///< in place of a number

  bool is_there() const;  ///< a finite number, or a name
};

/// A finding: what programs and decisions go by, and what its wording needs.
struct Statement {
  std::string code;  ///< "cause.established"
  std::vector<Fact> facts = {};
  std::string said = "";  ///< in words already, as it was stored; empty: as the wording has it
};

/// What is told in one line, in its order.
using Told = std::vector<Statement>;

Fact number(std::string key, double value, std::string unit, const Interval& ci95 = {});
Fact ratio(std::string key, double value);
Fact per_cent(std::string key, double value);  ///< [%]
Fact word(std::string key, std::string text);
Fact names(std::string key, const std::vector<std::string>& all);
Fact names(std::string key, std::vector<ToldName> all);

/// How much is told: what a terminal has room for, or all of it.
enum class Detail { kBrief, kWhole };

/// The sentences of all statements, each as its wording has it.
/// @throws std::logic_error for a code without a wording
std::string in_words(const Told& told, Detail detail, Coordinates coordinates);

/// A statement as a part of a sentence: as its wording has it, no capital letter, no full stop.
std::string as_clause(const Statement& statement, Coordinates coordinates);

/// The codes of all statements, each once, in their order.
std::vector<std::string> codes_of(const Told& told);
bool has_code(const Told& told, const std::string& code);

/// What a code is told as.
///
/// A wording names facts in braces: `{gap}` is a number with its unit and its 95 % interval, or names joined
/// by "and"; `{gap#}` the number alone, `{names:or}` names joined by "or" (or another word), `{names:then}`
/// by ", then to ", `{names:,}` and `{names:;}` by that sign, `{names:+}` names with their asides,
/// `{names?it|them}` the first word of one, the second of several.
/// `{torque}` is "torque" or "force". What stands between [ and ] is left out where a fact in it is not
/// there. Numbers of one unit share the prefix of the first of them; per cents their decimals.
struct Wording {
  const char* code;
  const char* brief;            ///< empty: only the whole text has it
  const char* whole = nullptr;  ///< nullptr: as in brief
};

/// All of them, sorted by the line of the card that they stand in.
std::span<const Wording> wordings();

/// A statement in the words of one wording: what lists them all with made-up facts goes by that, too.
std::string in_words(const Statement& statement, const char* wording, Coordinates coordinates);

}  // namespace gapscope
