#include "recording/json_cursor.h"

#include <fmt/format.h>

#include <charconv>

#include "base/shown.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::recording {

void JsonCursor::fail(const std::string& expected) const {
  const std::string_view rest = text_.substr(std::min(at_, text_.size()), 20);
  throw DamagedBytes{
      at_, fmt::format("is {} there, expected {}", rest.empty() ? "nothing more" : shown(rest), expected)};
}

char JsonCursor::peek() {
  at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
  return at_ < text_.size() ? text_[at_] : '\0';
}

void JsonCursor::expect(char c) {
  if (peek() != c) fail(fmt::format("{}", c));
  ++at_;
}

void JsonCursor::enter(char c) {
  constexpr int kDeepest = 64;
  expect(c);
  if (++depth_ > kDeepest) fail(fmt::format("no more than {} values within each other", kDeepest));
}

/// Whether an object or array ends here; else what comes before its next member is passed.
bool JsonCursor::leave(char c, bool first) {
  if (peek() != c) {
    if (!first) expect(',');
    return false;
  }
  ++at_, --depth_;
  return true;
}

void JsonCursor::escape(std::string& to) {
  const char c = at_ < text_.size() ? text_[at_++] : '\0';
  const std::string_view from = "\"\\/bfnrt", is = "\"\\/\b\f\n\r\t";
  if (const auto known = from.find(c); c != '\0' && known != from.npos) {
    to += is[known];
  } else if (c == 'u' && at_ + 4 <= text_.size()) {
    at_ += 4;
    to += '?';  // of a name, which is then shown so
  } else {
    fail("a character behind the backslash");
  }
}

std::string JsonCursor::text() {
  expect('"');
  std::string all;
  while (at_ < text_.size() && text_[at_] != '"') {
    const char c = text_[at_++];
    if (c == '\\')
      escape(all);
    else
      all += c;
  }
  if (at_ >= text_.size()) fail("a quotation mark");
  ++at_;
  return all;
}

bool JsonCursor::word(std::string_view w) {
  if (text_.substr(at_, w.size()) != w) return false;
  at_ += w.size();
  return true;
}

double JsonCursor::number() {
  peek();
  if (word("true")) return 1.0;
  if (word("false")) return 0.0;
  if (word("null") || word("NaN")) return kNaN;
  if (word("Infinity") || word("-Infinity")) return kInfinity;
  double value = 0.0;
  const char* const first = text_.data() + at_;
  const auto [end, problem] = std::from_chars(first, text_.data() + text_.size(), value);
  if (problem == std::errc::invalid_argument) fail("a number");
  at_ += static_cast<std::size_t>(end - first);
  return problem == std::errc() ? value : kNaN;
}

void JsonCursor::skip() {
  switch (peek()) {
    case '{':
      return object([&](const std::string&) { skip(); });
    case '[':
      return array([&] { skip(); });
    case '"':
      text();
      return;
    default:
      number();
  }
}

}  // namespace gapscope::internal::recording
