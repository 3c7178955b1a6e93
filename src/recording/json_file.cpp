// JSON as test benches of servos write it. One of: a list of objects, alone or as a member ("entries") of an
// object whose other numbers hold for all of them; an object of lists of numbers; an object on every line.
// Lists further down, as those of rollouts, are named by their path: "data[0].actions".
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/shown.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/json_cursor.h"
#include "recording/limits.h"
#include "recording/log_file.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

/// Keys of objects, and places in lists from 0 on: "data[0].actions" has three.
using JsonPath = std::vector<std::variant<std::string, std::size_t>>;

void follow(JsonCursor& json, const JsonPath& path, std::size_t step, const std::function<void()>& take) {
  if (step == path.size()) return take();
  const char next = json.peek();
  bool found = false;
  const auto go_on = [&](bool here) {
    if (!here || found) return json.skip();
    found = true;
    follow(json, path, step + 1, take);
  };
  if (const auto* const key = std::get_if<std::string>(&path[step]); key != nullptr && next == '{')
    return json.object([&](const std::string& name) { go_on(name == *key); });
  std::size_t at = 0;
  if (const auto* const index = std::get_if<std::size_t>(&path[step]); index != nullptr && next == '[')
    return json.array([&] { go_on(at++ == *index); });
  json.skip();
}

JsonPath json_path(const std::string& name) {
  JsonPath path;
  for (std::size_t at = 0; at < name.size();) {
    if (name[at] == '[') {
      std::size_t index = 0;
      const char* const end = name.data() + name.size();
      const auto [read, problem] = std::from_chars(name.data() + at + 1, end, index);
      if (problem != std::errc() || read == end || *read != ']') return {};
      path.emplace_back(index);
      at = static_cast<std::size_t>(read - name.data()) + 1;
    } else {
      if (name[at] == '.') ++at;
      const std::size_t end = std::min(name.find_first_of(".[", at), name.size());
      if (end == at) return {};
      path.emplace_back(name.substr(at, end - at));
      at = end;
    }
  }
  return path;
}

/// Goes over what is next in a text, and calls `take` where the path ends, which has to go over what is
/// there.
/// @throws DamagedBytes
void at_path(JsonCursor& json, const JsonPath& path, const std::function<void()>& take) {
  follow(json, path, 0, take);
}

/// Adds the paths of the lists of numbers below a path, of the first element where a list has objects.
/// @param depth  of the path
void add_lists(JsonCursor& json, const std::string& path, int depth, std::vector<std::string>& to) {
  constexpr int kDeepest = 6;
  constexpr std::size_t kMost = 1000;
  const char next = json.peek();
  if (depth > kDeepest || to.size() > kMost || (next != '{' && next != '[')) return json.skip();
  if (next == '{')
    return json.object([&](const std::string& key) {
      add_lists(json, path.empty() ? key : path + "." + key, depth + 1, to);
    });
  std::size_t at = 0;
  bool table = false;
  json.array([&] {
    if (at++ > 0) return json.skip();
    const char first = json.peek();
    table = first == '{' || first == '[' || first == '"';
    if (first == '{') return add_lists(json, path + "[0]", depth + 1, to);
    if (first != '[') return json.skip();
    json.array([&] {
      if (json.peek() != '[' && json.peek() != '{' && json.peek() != '"') table = false;
      json.skip();
    });
  });
  if (!table && at > 1 && depth > 1 && !contains(to, path)) to.push_back(path);
}

constexpr std::uintmax_t kLargestText = std::uintmax_t{1} << 30;

/// What a name stands for.
struct JsonColumn {
  enum { kOfRows, kList, kForAll } kind = kOfRows;
  std::size_t rows = 0, columns = 0;  ///< of a list; of a table of numbers
  double value = kNaN;                ///< for all rows
  JsonPath path = {};                 ///< of a list
};

void count_numbers(JsonCursor& json, std::size_t& count) {
  const char next = json.peek();
  if (next == '{')
    json.object([&](const std::string&) { count_numbers(json, count); });
  else if (next == '[')
    json.array([&] { count_numbers(json, count); });
  else
    ++count, json.skip();
}

/// Whether what is next has more numbers than a row: it is a rollout, whose lists are named by their paths.
bool is_long(JsonCursor json) {
  constexpr std::size_t kMostOfRow = 1000;
  std::size_t count = 0;
  count_numbers(json, count);
  return count > kMostOfRow;
}

class JsonFile : public ArrayFile {
 public:
  JsonFile(std::string path, const std::string& position) : path_(std::move(path)) {
    read_text();
    reading([&] { look(position); });
  }

  const char* noun() const override { return "column"; }
  const char* row() const override { return "entry"; }

  std::optional<StoredArray> find(const std::string& name) override {
    const auto found = columns_.find(name);
    if (found == columns_.end() && !look_further_down(name)) return {};
    const JsonColumn& c = columns_.at(name);
    if (c.kind != JsonColumn::kList) return StoredArray{name, "", {rows_}};
    return c.columns > 0 ? StoredArray{name, "", {c.rows, c.columns}, true} : StoredArray{name, "", {c.rows}};
  }

  std::vector<std::string> names() override {
    std::vector<std::string> all;
    const auto add = [&] {
      JsonCursor json(text_);
      add_lists(json, "", 0, all);
    };
    if (!by_line_) reading(add);  // fewer, and more likely meant, than the numbers of entries
    for (const auto& [name, column] : columns_)
      if (!contains(all, name)) all.push_back(name);
    return all;
  }

  std::vector<double> numbers(const std::string& name, std::size_t count) override {
    const JsonColumn& c = columns_.at(name);
    if (c.kind == JsonColumn::kForAll) return std::vector<double>(rows_, c.value);
    std::vector<double> values;
    reading([&] {
      if (c.kind == JsonColumn::kList)
        read_list(name, values);
      else
        for_each_row([&](const MessageNumbers& row) {
          const double* const value = row.find(name);
          if (!value)
            throw ConfigError(path_, fmt::format("entry {} has no {}, expected it in every one",
                                                 values.size() + 1, shown(name)));
          values.push_back(*value);
        });
    });
    if (values.size() == count) return values;
    throw ConfigError(path_, fmt::format("the column {} has {} numbers, expected {}, in each row as many",
                                         shown(name), values.size(), count));
  }

 private:
  void read_text() {
    const std::uintmax_t size = std::filesystem::file_size(path_);
    if (size > kLargestText)
      throw ConfigError(path_,
                        fmt::format("has {} bytes, expected at most {} of a JSON (write a CSV or .npz)", size,
                                    kLargestText));
    text_.resize(static_cast<std::size_t>(size));
    std::ifstream file = open_recording_file(path_);
    file.read(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  }

  /// What is wrong with the text is told with its line.
  template <class Read>
  void reading(Read read) const {
    try {
      read();
    } catch (const DamagedBytes& damaged) {
      const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(damaged.at, text_.size()));
      throw ConfigError(path_, 1 + std::count(text_.begin(), end, '\n'),
                        fmt::format("is no whole JSON: byte {} {}", damaged.at, damaged.what));
    }
  }

  void look(const std::string& position) {
    JsonCursor json(text_);
    is_list_ = json.peek() == '[';
    bool rollouts = false, first = true;
    if (is_list_)
      json.array([&] {
        if (std::exchange(first, false)) rollouts = json.peek() == '{' && is_long(json);
        json.skip();
      });
    else
      look_at_members(json, position);
    by_line_ = json.peek() == '{' && !is_list_;
    if (by_line_)
      columns_.clear(), table_.clear();
    else if (json.peek() != '\0')
      json.fail("the end of the text");
    if ((is_list_ && !rollouts) || by_line_ || !table_.empty()) look_at_rows();
  }

  /// Of an object: its lists, and its numbers that hold for all rows.
  void look_at_members(JsonCursor& json, const std::string& position) {
    bool has_position = false;
    json.object([&](const std::string& key) {
      if (json.peek() == '{' && is_long(json)) return json.skip();
      if (json.peek() != '[') {
        MessageNumbers constants;
        flatten(json, key, constants);
        for (const auto& [name, value] : constants.all())
          columns_.insert_or_assign(name, JsonColumn{JsonColumn::kForAll, 0, 0, value});
        return;
      }
      look_at_list(json, key, position, has_position);
    });
  }

  void look_at_list(JsonCursor& json, const std::string& key, const std::string& position,
                    bool& has_position) {
    JsonColumn list{JsonColumn::kList};
    list.path = {key};
    bool objects = false, rollouts = false, here = false;
    json.array([&] {
      const char next = json.peek();
      if (list.rows++ > 0 || next == '"') return json.skip();
      rollouts = next == '{' && is_long(json);
      objects = next == '{';
      if (rollouts) {
        json.skip();
      } else if (objects) {
        MessageNumbers row;
        flatten(json, "", row);
        row.finish();
        here = row.find(position) != nullptr;
      } else if (next == '[') {
        json.array([&] { ++list.columns, json.skip(); });
      } else {
        json.number();
      }
    });
    if (list.rows > kMostSamples) json.fail(fmt::format("at most {} elements of a list", kMostSamples));
    if (rollouts) return;
    if (!objects)
      columns_.insert_or_assign(key, list), rows_ = std::max(rows_, list.rows);
    else if (table_.empty() || (here && !has_position))
      table_ = key, has_position = here;
  }

  /// Of the rows: how many, and what they have.
  void look_at_rows() {
    rows_ = 0;
    for_each_row([&](const MessageNumbers& row) {
      constexpr std::size_t kEnough = 200;
      if (++rows_ > kMostSamples)
        throw ConfigError(path_, fmt::format("has more than {} entries, expected fewer", kMostSamples));
      if (rows_ > kEnough) return;
      for (const auto& [name, value] : row.all()) columns_.insert_or_assign(name, JsonColumn{});
    });
  }

  template <class Take>
  void for_each_row(Take take) const {
    MessageNumbers row;
    JsonCursor json(text_);
    const auto one = [&] {
      row.clear();
      flatten(json, "", row);
      row.finish();
      take(row);
    };
    if (by_line_) {
      while (json.peek() != '\0') one();
    } else if (is_list_) {
      json.array(one);
    } else {
      json.object([&](const std::string& key) {
        if (key == table_)
          json.array(one);
        else
          json.skip();
      });
    }
  }

  void read_list(const std::string& name, std::vector<double>& values) const {
    const std::size_t width = columns_.at(name).columns;
    JsonCursor json(text_);
    at_path(json, columns_.at(name).path, [&] {
      std::size_t in_row = 0;
      const auto one = [&] { values.push_back(json.number()), ++in_row; };
      json.array([&] {
        in_row = 0;
        if (width == 0) return one();
        json.array(one);
        if (in_row != width)
          throw DamagedBytes{
              json.at(), fmt::format("ends a row of {} numbers in {}, expected {} as in the first", in_row,
                                     shown(name), width)};
      });
    });
  }

  /// A list of numbers, or of rows of them, at a path.  @returns whether there is one
  bool look_further_down(const std::string& name) {
    JsonColumn list{JsonColumn::kList};
    list.path = json_path(name);
    bool numbers = false;
    reading([&] {
      JsonCursor json(text_);
      if (list.path.size() < 2 || by_line_) return;
      at_path(json, list.path, [&] {
        if (json.peek() != '[') return json.skip();
        json.array([&] {
          const char next = json.peek();
          if (list.rows++ > 0) return json.skip();
          numbers = next != '"' && next != '{';
          if (next != '[') return json.skip();
          json.array([&] { ++list.columns, json.skip(); });
        });
      });
    });
    if (numbers && list.rows > 1) columns_.insert_or_assign(name, list);
    return numbers && list.rows > 1;
  }

  std::string path_, text_;
  std::map<std::string, JsonColumn> columns_;
  std::string table_;  ///< the member that is the list of rows
  bool is_list_ = false, by_line_ = false;
  std::size_t rows_ = 0;
};

}  // namespace

std::unique_ptr<ArrayFile> open_json(const std::string& path, const RecordingColumns& columns) {
  return std::make_unique<JsonFile>(path, columns.position);
}

}  // namespace gapscope::internal::recording
