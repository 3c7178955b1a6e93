#pragma once

#include <string>
#include <vector>

namespace gapscope::internal::report {

/// A piece of text of one look.
struct TextRun {
  enum class Level { kBase, kSubscript, kSuperscript };
  std::string text;
  bool italic = false;
  Level level = Level::kBase;
  bool hat = false;  ///< an estimate: drawn with a circumflex over it
};

/// Takes markup apart. Outside of `$…$` text stands as it is. Inside, letters are variables and set in
/// italics, digits and signs upright; `_x` or `_{…}` is a subscript, `^x` or `^{…}` a superscript, `\hat{…}`
/// an estimate: `$$` is a dollar sign:
/// "error $50 × e_x$", "$2\hat{β} = 18.7$ mrad".
/// @throws std::logic_error for an unbalanced `$` or brace.
std::vector<TextRun> parse_markup(const std::string& markup);

/// Text that stands as it is, whatever signs are in it.
std::string literal(const std::string& text);

/// The text alone, for Markdown and messages: "2β̂ = 18.7 mrad", "x_1".
std::string plain_text(const std::string& markup);

/// Text as HTML and XML have it; control characters, which XML 1.0 cannot hold, are left out.
std::string markup_text(const std::string& text);

}  // namespace gapscope::internal::report
