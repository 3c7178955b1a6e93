#include "report/rich_text.h"

#include "base/require.h"

namespace gapscope::internal::report {
namespace {

using Level = TextRun::Level;

/// Cuts the next UTF-8 character off the text.
std::string next_character(const std::string& text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  const std::string character = text.substr(at, length);
  at += character.size();
  return character;
}

/// Latin and Greek letters.
bool is_letter(const std::string& character) {
  const auto lead = static_cast<unsigned char>(character[0]);
  return (character.size() == 1 && ((lead | 32) >= 'a' && (lead | 32) <= 'z')) || lead == 0xCE ||
         lead == 0xCF;
}

/// The content of "{…}" or the single character at `at`.
std::string argument(const std::string& text, std::size_t& at) {
  GAPSCOPE_REQUIRE(at < text.size());
  if (text[at] != '{') return next_character(text, at);
  const std::size_t end = text.find('}', at);
  GAPSCOPE_REQUIRE(end != std::string::npos);
  const std::string inside = text.substr(at + 1, end - at - 1);
  at = end + 1;
  return inside;
}

class Parser {
 public:
  std::vector<TextRun> runs;

  void maths(const std::string& text, Level level, bool hat) {
    for (std::size_t at = 0; at < text.size();) {
      if (text[at] == '_')
        maths(argument(text, ++at), Level::kSubscript, hat);
      else if (text[at] == '^')
        maths(argument(text, ++at), Level::kSuperscript, hat);
      else if (text.compare(at, 4, "\\hat") == 0)
        maths(argument(text, at += 4), level, true);
      else
        add(next_character(text, at), level, hat);
    }
  }

  void add(const std::string& character, Level level, bool hat, bool upright = false) {
    const bool italic = !upright && is_letter(character);
    const bool joins = !runs.empty() && runs.back().italic == italic && runs.back().level == level &&
                       !runs.back().hat && !hat;
    if (joins)
      runs.back().text += character;
    else
      runs.push_back({character, italic, level, hat});
  }
};

}  // namespace

std::vector<TextRun> parse_markup(const std::string& markup) {
  Parser parser;
  for (std::size_t at = 0; at < markup.size();) {
    if (markup.compare(at, 2, "$$") == 0) {
      parser.add("$", Level::kBase, false, true);
      at += 2;
    } else if (markup[at] == '$') {
      const std::size_t end = markup.find('$', at + 1);
      GAPSCOPE_REQUIRE(end != std::string::npos);
      parser.maths(markup.substr(at + 1, end - at - 1), Level::kBase, false);
      at = end + 1;
    } else {
      parser.add(next_character(markup, at), Level::kBase, false, true);
    }
  }
  return parser.runs;
}

std::string literal(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '$' ? "$$" : std::string(1, c);
  return escaped;
}

std::string plain_text(const std::string& markup) {
  std::string text;
  Level last = Level::kBase;
  for (const TextRun& run : parse_markup(markup)) {
    if (run.level != last && run.level != Level::kBase) text += run.level == Level::kSubscript ? "_" : "^";
    text += run.text + (run.hat ? "\u0302" : "");
    last = run.level;
  }
  return text;
}

std::string markup_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
      out += c;
  }
  return out;
}

}  // namespace gapscope::internal::report
