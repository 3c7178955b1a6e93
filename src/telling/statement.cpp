#include "gapscope/telling/statement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "base/percents.h"
#include "base/require.h"
#include "base/shared_unit.h"
#include "base/text.h"

namespace gapscope {
namespace {

/// "a, b and c"; ", then to ", ", " and "; " stand between all.
std::string joined(const std::vector<ToldName>& all, std::string_view last, bool asides) {
  const bool alike = last == "then" || last == "," || last == ";";
  const std::string between = last == "then" ? ", then to " : last == ";" ? "; " : ", ";
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) text += alike || i + 1 < all.size() ? between : fmt::format(" {} ", last);
    text += all[i].name;
    if (asides && !all[i].aside.empty()) text += " (" + all[i].aside + ")";
  }
  return text;
}

class Writer {
 public:
  Writer(const Statement& statement, Coordinates coordinates)
      : statement_(statement), coordinates_(coordinates) {}

  std::string write(std::string_view wording) const {
    std::string text;
    for (std::size_t at = 0; at < wording.size();) {
      const char c = wording[at];
      const std::size_t end = c == '{' ? wording.find('}', at) : c == '[' ? wording.find(']', at) : at;
      GAPSCOPE_REQUIRE(end != wording.npos);
      const std::string_view inside = wording.substr(at + 1, end == at ? 0 : end - at - 1);
      if (c == '{')
        text += field(inside);
      else if (c == '[')
        text += all_there(inside) ? write(inside) : "";
      else
        text += c;
      at = end + 1;
    }
    return text;
  }

 private:
  const Fact* find(std::string_view key) const {
    const auto at = std::ranges::find(statement_.facts, key, &Fact::key);
    return at == statement_.facts.end() ? nullptr : &*at;
  }

  static std::string_view key_of(std::string_view field) {
    return field.substr(0, field.find_first_of("#:?"));
  }

  bool all_there(std::string_view wording) const {
    for (std::size_t at = wording.find('{'); at != wording.npos; at = wording.find('{', at + 1)) {
      const std::string_view key = key_of(wording.substr(at + 1, wording.find('}', at) - at - 1));
      const Fact* fact = find(key);
      if (key != "torque" && (fact == nullptr || !fact->is_there())) return false;
    }
    return true;
  }

  std::string field(std::string_view field) const {
    const std::string_view key = key_of(field), form = field.substr(key.size());
    const Fact* fact = find(key);
    if (fact == nullptr && key == "torque") return coordinates_.torque_word();
    GAPSCOPE_REQUIRE(fact != nullptr);
    if (form.starts_with('?')) {
      const std::size_t bar = form.find('|');
      const bool one = fact->names.empty() ? std::abs(fact->value - 1.0) < 0.5 : fact->names.size() == 1;
      return std::string(one ? form.substr(1, bar - 1) : form.substr(bar + 1));
    }
    if (!fact->names.empty()) {
      const bool asides = form.starts_with(":+");
      const std::string_view last = form.substr(std::min<std::size_t>(form.size(), asides ? 2 : 1));
      return joined(fact->names, last.empty() ? "and" : last, asides);
    }
    return told_number(*fact, form == "#");
  }

  std::string told_number(const Fact& fact, bool alone) const {
    if (!std::isfinite(fact.value)) return "unknown";
    if (fact.unit == "%") {
      std::vector<double> all;
      for (const Fact& f : statement_.facts)
        if (f.unit == "%" && f.is_there()) all.push_back(f.value);
      return alone ? Percents(all).number(fact.value) : Percents(all)(fact.value);
    }
    const auto first = std::ranges::find_if(
        statement_.facts, [&](const Fact& f) { return f.unit == fact.unit && f.is_there(); });
    const double size = fact.unit.empty() ? 1.0 : first->value;
    const SharedUnit shared(size, fact.unit.empty() ? "" : coordinates_.shown_unit(fact.unit));
    if (alone) return shared.number(fact.value);
    return shared.with_interval_aside(fact.value, fact.ci95);
  }

  const Statement& statement_;
  Coordinates coordinates_;
};

const Wording& wording_of(const std::string& code) {
  const auto all = wordings();
  const auto at = std::ranges::find(all, code, &Wording::code);
  GAPSCOPE_REQUIRE(at != all.end());
  return *at;
}

}  // namespace

bool Fact::is_there() const { return !names.empty() || std::isfinite(value); }

Fact number(std::string key, double value, std::string unit, const Interval& ci95) {
  return {std::move(key), value, std::move(unit), ci95, {}};
}
Fact ratio(std::string key, double value) { return {std::move(key), value}; }
Fact per_cent(std::string key, double value) { return {std::move(key), value, "%"}; }
Fact word(std::string key, std::string text) {
  Fact fact{std::move(key)};
  if (!text.empty()) fact.names.push_back({std::move(text)});
  return fact;
}
Fact names(std::string key, const std::vector<std::string>& all) {
  Fact fact{std::move(key)};
  for (const std::string& name : all) fact.names.push_back({name});
  return fact;
}
Fact names(std::string key, std::vector<ToldName> all) {
  Fact fact{std::move(key)};
  fact.names = std::move(all);
  return fact;
}

std::string in_words(const Statement& statement, const char* wording, Coordinates coordinates) {
  std::string text = Writer(statement, coordinates).write(wording);
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  const char end = text.back();
  return end == '.' || end == ':' || text.ends_with(".)") ? text : text + ".";
}

std::string as_clause(const Statement& statement, Coordinates coordinates) {
  return Writer(statement, coordinates).write(wording_of(statement.code).brief);
}

std::string in_words(const Told& told, Detail detail, Coordinates coordinates) {
  std::string text;
  for (const Statement& s : told) {
    std::string words = s.said;
    if (words.empty()) {
      const Wording& w = wording_of(s.code);
      const char* const wording = detail == Detail::kWhole && w.whole != nullptr ? w.whole : w.brief;
      if (*wording != '\0') words = in_words(s, wording, coordinates);
    }
    text += (text.empty() || words.empty() ? "" : " ") + words;
  }
  return text;
}

std::vector<std::string> codes_of(const Told& told) {
  std::vector<std::string> codes;
  for (const Statement& s : told)
    if (!contains(codes, s.code)) codes.push_back(s.code);
  return codes;
}

bool has_code(const Told& told, const std::string& code) {
  return std::ranges::find(told, code, &Statement::code) != told.end();
}

}  // namespace gapscope
