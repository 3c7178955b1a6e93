// WPILOG 1.0, the log of WPILib's robots: after a header records of an entry, a time [µs] and bytes. Entry 0
// says which entries there are: their number, name and type. Each has rows of its own.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/limits.h"
#include "recording/log_file.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

constexpr std::size_t kMostEntries = 10'000, kMostElements = 1000;

/// Bytes of which no more are taken than there are.
class WpilogBytes {
 public:
  explicit WpilogBytes(std::string_view bytes) : bytes_(bytes) {}

  bool ended() const { return at_ == bytes_.size(); }
  std::size_t at() const { return at_; }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_)
      throw DamagedBytes{at_, fmt::format("has fewer than {} bytes left", count)};
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  std::uint64_t number(std::size_t count) {
    std::uint64_t value = 0;
    const std::string_view raw = take(count);
    for (std::size_t i = count; i-- > 0;) value = value << 8 | static_cast<unsigned char>(raw[i]);
    return value;
  }
  std::string text() { return std::string(take(number(4))); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

struct Series {
  std::vector<std::int64_t> times;  ///< [µs]
  std::vector<double> values;
};

struct Entry {
  std::string name, type;
};

/// Numbers of a type's bytes; nothing where it is no type of numbers.
std::vector<double> numbers_of_type(const std::string& type, std::string_view raw) {
  const bool list = type.ends_with("[]");
  const std::string one = list ? type.substr(0, type.size() - 2) : type;
  const std::size_t size = one == "double" || one == "int64" ? 8
                           : one == "float"                  ? 4
                           : one == "boolean"                ? 1
                                                             : 0;
  if (size == 0 || raw.size() / size > kMostElements) return {};
  WpilogBytes bytes(raw);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < raw.size() / size; ++i) {
    const std::uint64_t bits = bytes.number(size);
    numbers.push_back(one == "double" ? std::bit_cast<double>(bits)
                      : one == "float"
                          ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                          : static_cast<double>(static_cast<std::int64_t>(bits)));
  }
  return numbers;
}

class WpilogFile : public ArrayFile {
 public:
  explicit WpilogFile(const std::string& path) {
    std::string content(static_cast<std::size_t>(std::filesystem::file_size(path)), '\0');
    std::ifstream in = open_recording_file(path);
    in.read(content.data(), static_cast<std::streamsize>(content.size()));
    content.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
    WpilogBytes bytes(content);
    try {
      read(bytes);
    } catch (const DamagedBytes& damaged) {
      throw ConfigError(path,
                        fmt::format("{} (at byte {}), expected a whole WPILOG", damaged.what, damaged.at));
    }
    settle_times(path);
  }

  const char* noun() const override { return "entry"; }
  const char* row() const override { return "time"; }

  std::optional<StoredArray> find(const std::string& name) override {
    if (name != "t" && !series_.contains(name)) return {};
    return StoredArray{name, "", {times_.size()}};
  }

  std::vector<std::string> names() override {
    std::vector<std::string> all = {"t"};
    for (const auto& [name, series] : series_) all.push_back(name);
    return all;
  }

  /// NaN at the times that an entry has no number of.
  std::vector<double> numbers(const std::string& name, std::size_t) override {
    std::vector<double> out(times_.size(), kNaN);
    if (name == "t") {
      for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<double>(times_[i] - times_.front()) / 1e6;
      return out;
    }
    const Series& series = series_.at(name);
    for (std::size_t i = 0; i < series.times.size(); ++i) {
      const auto at = std::lower_bound(times_.begin(), times_.end(), series.times[i]);
      out[static_cast<std::size_t>(at - times_.begin())] = series.values[i];
    }
    return out;
  }

 private:
  void read(WpilogBytes& bytes) {
    if (bytes.take(6) != "WPILOG") throw DamagedBytes{0, "does not begin as a WPILOG"};
    if (bytes.number(2) >> 8 != 1) throw DamagedBytes{6, "is of another version than 1"};
    bytes.text();
    while (!bytes.ended()) read_record(bytes);
  }

  void read_record(WpilogBytes& bytes) {
    const std::uint64_t lengths = bytes.number(1);
    const std::uint64_t entry = bytes.number((lengths & 3) + 1), size = bytes.number((lengths >> 2 & 3) + 1);
    const auto time = static_cast<std::int64_t>(bytes.number((lengths >> 4 & 7) + 1));
    const std::string_view payload = bytes.take(size);
    if (entry == 0) return read_control(payload);
    const auto known = entries_.find(entry);
    if (known == entries_.end()) return;
    const std::vector<double> numbers = numbers_of_type(known->second.type, payload);
    const bool list = known->second.type.ends_with("[]");
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      Series& series = series_[list ? fmt::format("{}[{}]", known->second.name, i) : known->second.name];
      series.times.push_back(time), series.values.push_back(numbers[i]);
    }
  }

  void read_control(std::string_view payload) {
    WpilogBytes bytes(payload);
    if (bytes.number(1) != 0) return;  // an entry that ends, or what is said of one
    const std::uint64_t entry = bytes.number(4);
    Entry& started = entries_[entry];
    started.name = bytes.text(), started.type = bytes.text();
    if (entries_.size() > kMostEntries) throw DamagedBytes{0, "has too many entries"};
  }

  void settle_times(const std::string& path) {
    std::set<std::int64_t> all;
    for (const auto& [name, series] : series_) {
      all.insert(series.times.begin(), series.times.end());
      if (all.size() > kMostSamples)
        throw ConfigError(path,
                          fmt::format("has more than {} times, expected at most that many", kMostSamples));
    }
    times_.assign(all.begin(), all.end());
  }

  std::map<std::uint64_t, Entry> entries_;
  std::map<std::string, Series> series_;
  std::vector<std::int64_t> times_;  ///< of all, each once
};

}  // namespace

std::unique_ptr<ArrayFile> open_wpilog(const std::string& path) { return std::make_unique<WpilogFile>(path); }

}  // namespace gapscope::internal::recording
