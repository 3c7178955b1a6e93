// NumPy's .npz: a ZIP archive with a member NAME.npy for each array.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/array_file.h"
#include "recording/npy_header.h"
#include "recording/recorded_rows.h"
#include "recording/zip_archive.h"

namespace gapscope::internal::recording {
namespace {

constexpr const char* kAgain = "expected a whole .npz, as numpy.savez or savez_compressed writes it";

class NpzFile : public ArrayFile {
 public:
  explicit NpzFile(std::string path) : path_(std::move(path)), file_(open_recording_file(path_)) {
    try {
      size_ = std::filesystem::file_size(path_);
      for (ZipMember& m : zip_members(file_, size_)) {
        const std::string name = m.name.ends_with(".npy") ? m.name.substr(0, m.name.size() - 4) : m.name;
        members_.insert_or_assign(name, std::move(m));
      }
    } catch (const DamagedArchive& damaged) {
      throw ConfigError(path_, fmt::format("{}, {}", damaged.what, kAgain));
    }
  }

  std::optional<StoredArray> find(const std::string& name) override {
    const auto member = members_.find(name);
    if (member == members_.end()) return {};
    return reading(name, [&] {
      if (!member->second.flaw.empty()) return StoredArray{name, member->second.flaw, {}, true, "savez"};
      ZipReader reader(file_, size_, member->second);
      const NpyHeader h = header_of(reader);
      return StoredArray{name, h.flaw, h.shape, h.by_rows, h.remedy};
    });
  }

  std::vector<std::string> names() override {
    std::vector<std::string> all;
    for (const auto& [name, member] : members_) all.push_back(name);
    return all;
  }

  std::vector<double> numbers(const std::string& name, std::size_t count) override {
    return reading(name, [&] {
      ZipReader reader(file_, size_, members_.at(name));
      const NpyHeader header = header_of(reader);
      std::vector<double> out;
      std::vector<char> raw;
      for (std::size_t left = count * header.bytes; left > 0; left -= raw.size()) {
        constexpr std::size_t kPiece = 1 << 16;  // of whole elements
        raw.resize(std::min(left, kPiece));
        if (reader.read_some(raw.data(), raw.size()) != raw.size())
          throw DamagedArchive{fmt::format("ends after {} of {} numbers", out.size(), count)};
        append_numbers(header, raw, out);
      }
      reader.finish();
      return out;
    });
  }

 private:
  static NpyHeader header_of(ZipReader& reader) {
    const auto header =
        read_npy_header([&](char* to, std::size_t count) { return reader.read_some(to, count) == count; });
    if (!header) throw DamagedArchive{"is damaged: it does not begin as an array of NumPy"};
    return *header;
  }

  /// What goes wrong within an array is said with its name and place.
  template <class Read>
  auto reading(const std::string& name, Read read) -> decltype(read()) {
    try {
      return read();
    } catch (const DamagedArchive& damaged) {
      throw ConfigError(path_, fmt::format("the array {} (at byte {}) {}, {}", shown(name),
                                           members_.at(name).place, damaged.what, kAgain));
    }
  }

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::map<std::string, ZipMember> members_;
};

}  // namespace

std::unique_ptr<ArrayFile> open_npz(const std::string& path) { return std::make_unique<NpzFile>(path); }

}  // namespace gapscope::internal::recording
