#include "report/html_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "report/rich_text.h"

namespace gapscope::internal::report {
namespace {

/// Puts what stands between pairs of a mark into an element; a mark without its partner stays.
std::string marked(const std::string& text, const std::string& mark, const char* element) {
  std::string out;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find(mark, at);
    const std::size_t close = open == text.npos ? text.npos : text.find(mark, open + mark.size());
    if (close == text.npos) return out + text.substr(at);
    out += text.substr(at, open - at) + fmt::format("<{}>", element) +
           text.substr(open + mark.size(), close - open - mark.size()) + fmt::format("</{}>", element);
    at = close + mark.size();
  }
}

/// Links within the page alone: `[Words](#words)`. Others stay as they are written.
std::string linked(const std::string& text) {
  const std::size_t open = text.find('['), middle = text.find("](#", open), close = text.find(')', middle);
  if (open == text.npos || middle == text.npos || close == text.npos) return text;
  const std::string place = text.substr(middle + 2, close - middle - 2);
  return text.substr(0, open) + fmt::format("<a href=\"{}\">", place) +
         text.substr(open + 1, middle - open - 1) + "</a>" + linked(text.substr(close + 1));
}

/// Cells of a row "| a | b |"; "\|" is no border.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells(1);
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    if (row[i] == '\\' && row[i + 1] == '|')
      cells.back() += row[++i];
    else if (row[i] == '|')
      cells.emplace_back();
    else
      cells.back() += row[i];
  }
  for (std::string& cell : cells) {
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
  }
  return cells;
}

/// A number keeps its unit beside it, and a sentence is not squeezed into a column of single words.
constexpr std::ptrdiff_t kUnbroken = 20, kSentence = 40;  ///< letters of a cell

const char* breaking_of(const std::string& cell) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };  // a letter
  const auto letters = std::count_if(cell.begin(), cell.end(), begins);
  if (cell.find(' ') == cell.npos) return "";
  return letters <= kUnbroken ? " class=\"short\"" : letters > kSentence ? " class=\"long\"" : "";
}

/// A row of headings (th) or of data (td).
std::string row_html(const std::string& row, const std::string& element) {
  std::string text = "<tr>";
  for (const std::string& cell : cells_of(row))
    text +=
        fmt::format("<{0}{1}>{2}</{0}>", element, element == "td" ? breaking_of(cell) : "", html_line(cell));
  return text + "</tr>\n";
}

/// "![title](file.png)"
bool is_picture(const std::string& line) { return line.starts_with("!["); }

bool shows(const std::string& line, const std::string& file) { return line.ends_with("](" + file + ")"); }

std::string figure_html(const Picture& p) { return "<figure>" + p.svg + "</figure>\n"; }

std::string picture_html(const std::string& line, const std::vector<Picture>& pictures) {
  const std::size_t middle = line.rfind("](");
  const std::string title = line.substr(2, middle - 2),
                    file = line.substr(middle + 2, line.size() - middle - 3);
  for (const Picture& p : pictures)
    if (p.file == file) return figure_html(p);
  return fmt::format("<p>{}</p>\n", markup_text(title));
}

/// The place that a link to a heading goes to.
std::string anchor(const std::string& title) {
  std::string id;
  for (const char c : title)
    id += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return id;
}

/// Goes through a report line by line.
class Writer {
 public:
  Writer(const std::vector<Picture>& pictures, const std::string& head, const std::string& carrying)
      : pictures_(pictures), head_(head), carrying_(carrying) {}

  void take(const std::string& line) {
    const bool item = line.starts_with("- "), row = line.starts_with("|");
    if (!item) close(list_, "</ul>\n");
    if (!row) end_table();
    if (line.empty()) return;
    if (line.starts_with("# ")) return title(line.substr(2));
    if (line.starts_with("## ")) return section(line.substr(3));
    if (line.starts_with("### ")) return void(out_ += "<h3>" + html_line(line.substr(4)) + "</h3>\n");
    if (item) return list_item(line.substr(2));
    if (row) return void(rows_.push_back(line));
    if (line.starts_with("> "))
      return void(out_ += "<blockquote>" + html_line(line.substr(2)) + "</blockquote>\n");
    if (is_picture(line) && carried_ && !carrying_.empty() && shows(line, carrying_)) return;  // above
    out_ += is_picture(line) ? picture_html(line, pictures_) : "<p>" + html_line(line) + "</p>\n";
  }

  std::string finished() {
    close(list_, "</ul>\n");
    end_table();
    close(section_, "</details>\n");
    return std::move(out_);
  }

 private:
  void close(bool& open, const char* end) {
    if (open) out_ += end;
    open = false;
  }

  void title(const std::string& text) { out_ += "<h1>" + html_line(text) + "</h1>\n" + head_; }

  /// Once, where the card ends.
  void carrying_picture() {
    const auto at = std::ranges::find(pictures_, carrying_, &Picture::file);
    if (at != pictures_.end() && !carried_) out_ += figure_html(*at);
    carried_ = true;
  }

  void section(const std::string& text) {
    close(section_, "</details>\n");
    carrying_picture();
    const bool shown = text == "Warnings" || text == "Figures" || text == "Error budget";
    out_ += fmt::format("<details id=\"{}\"{}><summary>{}</summary>\n", anchor(text), shown ? " open" : "",
                        html_line(text));
    section_ = true;
  }

  void list_item(const std::string& text) {
    if (!list_) out_ += section_ ? "<ul>\n" : "<ul class=\"card\">\n";
    list_ = true;
    out_ += "<li>" + html_line(text) + "</li>\n";
  }

  /// The second row is the rule below the headings.
  void end_table() {
    if (rows_.size() >= 2) {
      out_ += "<div class=\"wide\"><table><thead>" + row_html(rows_[0], "th") + "</thead><tbody>\n";
      for (std::size_t i = 2; i < rows_.size(); ++i) out_ += row_html(rows_[i], "td");
      out_ += "</tbody></table></div>\n";
    }
    rows_.clear();
  }

  const std::vector<Picture>& pictures_;
  const std::string& head_;
  const std::string& carrying_;
  bool carried_ = false;
  std::string out_;
  std::vector<std::string> rows_;  ///< of the table that is being read
  bool list_ = false, section_ = false;
};

}  // namespace

std::string html_line(const std::string& line) {
  std::string out;
  std::istringstream parts(markup_text(line));
  std::string part;
  for (bool code = false; std::getline(parts, part, '`'); code = !code)
    out += code ? "<code>" + part + "</code>" : linked(marked(marked(part, "**", "b"), "*", "i"));
  return out;
}

std::string html_body(const std::string& markdown, const std::vector<Picture>& pictures,
                      const std::string& head, const std::string& carrying) {
  Writer writer(pictures, head, carrying);
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) writer.take(line);
  return writer.finished();
}

}  // namespace gapscope::internal::report
