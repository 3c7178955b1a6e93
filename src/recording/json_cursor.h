#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gapscope::internal::recording {

/// What is wrong with the bytes of a text or a message, and where in them.
struct DamagedBytes {
  std::size_t at = 0;
  std::string what;
};

/// Walks over a JSON text (RFC 8259) from its first character to its last, without keeping anything of it.
/// What stands at a place is told by peek(); whoever asks for something else throws DamagedBytes.
class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text) : text_(text) {}

  char peek();  ///< the first character of what is next: { [ " t f n - 0..9; 0 at the end
  std::string text();
  double number();  ///< also true, false and null: 1, 0, NaN; NaN and Infinity as Python writes them
  void skip();      ///< any value

  /// @param value  called with each key; takes its value
  template <class Value>
  void object(Value value) {
    enter('{');
    for (bool first = true; !leave('}', first); first = false) {
      const std::string key = text();
      expect(':');
      value(key);
    }
  }

  /// @param value  called for each element; takes it
  template <class Value>
  void array(Value value) {
    enter('[');
    for (bool first = true; !leave(']', first); first = false) value();
  }

  std::size_t at() const { return at_; }
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  void expect(char c);
  void enter(char c);
  bool leave(char c, bool first);
  void escape(std::string& to);
  bool word(std::string_view w);

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace gapscope::internal::recording
