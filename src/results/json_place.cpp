#include "results/json_place.h"

#include <algorithm>

namespace gapscope::internal::results {
namespace {

constexpr int kDeepestFollowed = 64;  ///< levels that are followed; no stored result has as many

/// Walks a valid JSON text until it stands before the value of one place.
class JsonWalk {
 public:
  JsonWalk(std::string_view text, const std::string& place) : text_(text), wanted_(place) {}

  /// Place of the value in the text; npos if it is not there.
  std::size_t find() {
    value("", 0);
    return found_;
  }

 private:
  bool done() const { return found_ != std::string_view::npos || at_ >= text_.size(); }
  void blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  std::string word() {  // a string, escapes as they stand
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    const std::string inside(text_.substr(begin, at_ - begin));
    ++at_;
    return inside;
  }

  void value(const std::string& place, int depth) {
    blanks();
    if (done()) return;
    if (place == wanted_ || depth > kDeepestFollowed)
      return void(found_ = place == wanted_ ? at_ : text_.size());
    if (text_[at_] == '{' || text_[at_] == '[') return members(place, depth);
    if (text_[at_] == '"') return void(word());
    at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
  }

  void members(const std::string& place, int depth) {
    const bool object = text_[at_++] == '{';
    for (int index = 0; !done(); ++index) {
      blanks();
      if (done() || text_[at_] == '}' || text_[at_] == ']') break;
      if (text_[at_] == ',') ++at_, blanks();
      std::string inner = place + "[" + std::to_string(index) + "]";
      if (object) {
        inner = (place.empty() ? "" : place + ".") + word();
        at_ = std::min(text_.find(':', at_), text_.size() - 1) + 1;
      }
      value(inner, depth + 1);
    }
    if (!done()) ++at_;
  }

  std::string_view text_;
  const std::string& wanted_;
  std::size_t at_ = 0, found_ = std::string_view::npos;
};

}  // namespace

int line_of_byte(std::string_view text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

std::size_t byte_of_level(std::string_view text, std::size_t level) {
  std::size_t open = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if ((c == '[' || c == '{') && ++open == level) return i;
    if ((c == ']' || c == '}') && open > 0) --open;
  }
  return text.npos;
}

int line_of_place(std::string_view text, std::string place) {
  for (;;) {
    const std::size_t at = JsonWalk(text, place).find();
    if (at != std::string_view::npos && at < text.size()) return line_of_byte(text, at);
    const std::size_t last = place.find_last_of(".[");
    if (place.empty()) return 1;
    place = last == std::string::npos ? "" : place.substr(0, last);
  }
}

}  // namespace gapscope::internal::results
