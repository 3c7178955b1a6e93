// MCAP (mcap.dev/spec): a magic, then records of an opcode (1 byte), a length (8) and their content, to a
// second magic. Read from the first to the last; its index is not needed.
#include <fmt/format.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/message_log.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

#ifdef GAPSCOPE_LZ4
bool unpack_lz4(std::string_view packed, std::string& to) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return false;
  std::size_t had = 0, left = 1;
  while (!packed.empty() && left != 0) {
    std::size_t out = to.size() - had, in = packed.size();
    left = LZ4F_decompress(context, to.data() + had, &out, packed.data(), &in, nullptr);
    if (LZ4F_isError(left) != 0 || (in == 0 && out == 0)) break;
    packed.remove_prefix(in);
    had += out;
  }
  LZ4F_freeDecompressionContext(context);
  return left == 0 && had == to.size() && packed.empty();
}
#endif

#ifdef GAPSCOPE_ZSTD
bool unpack_zstd(std::string_view packed, std::string& to) {
  return ZSTD_decompress(to.data(), to.size(), packed.data(), packed.size()) == to.size();
}
#endif

/// Bytes that were compressed, of a size that is known; takes no more memory than that.
/// @param compression  "", "lz4" (frames) or "zstd"
/// @param problem  why there are none: damaged, or a compression that this build has not
bool unpack(const std::string& compression, std::string_view packed, std::size_t size, std::string& to,
            std::string& problem) {
  bool whole = false, known = true;
  to.resize(size);
  if (compression.empty()) {
    whole = packed.size() == size;
    if (whole) to = packed;
#ifdef GAPSCOPE_LZ4
  } else if (compression == "lz4") {
    whole = unpack_lz4(packed, to);
#endif
#ifdef GAPSCOPE_ZSTD
  } else if (compression == "zstd") {
    whole = unpack_zstd(packed, to);
#endif
  } else {
    known = false;
  }
  if (!known)
    problem = fmt::format("is compressed by {}, which this build does not read", shown(compression));
  else if (!whole)
    problem = fmt::format("does not unpack to {} bytes", size);
  return whole;
}

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::uint64_t kLargestRecord = 256u << 20;  ///< that is read or unpacked at once [bytes]
constexpr std::uint64_t kMostKept = 64u << 20;        ///< of all schemas and channels together [bytes]
enum Opcode : unsigned char { kSchema = 3, kChannel = 4, kMessage = 5, kChunk = 6, kDataEnd = 15 };

/// The fields of a record.  @throws DamagedBytes where they are longer than it
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number(std::size_t width) {
    const std::string_view raw = take(width);
    std::uint64_t value = 0;
    for (std::size_t i = width; i-- > 0;) value = (value << 8) | static_cast<unsigned char>(raw[i]);
    return value;
  }
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size() - at_)
      throw DamagedBytes{at_,
                         fmt::format("has a field of {} bytes, {} are left", count, bytes_.size() - at_)};
    const std::string_view part = bytes_.substr(at_, static_cast<std::size_t>(count));
    at_ += part.size();
    return part;
  }
  std::string text() { return std::string(take(number(4))); }
  std::string_view rest() { return take(bytes_.size() - at_); }
  bool ended() const { return at_ == bytes_.size(); }
  std::size_t at() const { return at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

struct Schema {
  std::string name, encoding, definition;
};

class McapLog : public MessageLog {
 public:
  explicit McapLog(std::string path) : path_(std::move(path)), size_(std::filesystem::file_size(path_)) {}

  void for_each(const std::function<void(const LogMessage&)>& take) override {
    std::ifstream file = open_recording_file(path_);
    std::string record(kMagic.size(), '\0');
    if (!file.read(record.data(), static_cast<std::streamsize>(record.size())) || record != kMagic)
      throw ConfigError(path_, "does not begin as an MCAP, expected one (\"\\x89MCAP0\\r\\n\" at byte 0)");
    schemas_.clear(), channels_.clear(), kept_ = 0;
    for (std::uint64_t at = kMagic.size(); read_record(file, at, record, take);)
      ;
  }

 private:
  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const {
    throw ConfigError(
        path_,
        fmt::format("is damaged at byte {}: {}, expected a whole MCAP (mcap recover FILE -o OUT)", at, what));
  }

  /// Attachments, indices and the like are passed over, however long.
  static bool is_read(unsigned char opcode) {
    return opcode == kSchema || opcode == kChannel || opcode == kMessage || opcode == kChunk;
  }

  /// @param at  of the record; becomes that of the next one
  /// @returns whether messages may follow
  bool read_record(std::ifstream& file, std::uint64_t& at, std::string& record,
                   const std::function<void(const LogMessage&)>& take) {
    std::string head(9, '\0');
    if (size_ - at < head.size() || !file.read(head.data(), 9))
      fail(at, "it ends there, without its last records");
    Fields fields(head);
    const auto opcode = static_cast<unsigned char>(fields.number(1));
    const std::uint64_t length = fields.number(8);
    if (length > size_ - at - 9)
      fail(at, fmt::format("a record of {} bytes, of which {} are there", length, size_ - at - 9));
    if (opcode == kDataEnd) return false;
    if (opcode == 0) fail(at, "a record of no kind");
    if (!is_read(opcode)) {
      if (!file.seekg(static_cast<std::streamoff>(length), std::ios::cur))
        fail(at, "it cannot be read there");
      at += 9 + length;
      return true;
    }
    if (length > kLargestRecord)
      fail(at, fmt::format("a record of {} bytes, more than {}", length, kLargestRecord));
    record.resize(static_cast<std::size_t>(length));
    if (!file.read(record.data(), static_cast<std::streamsize>(length))) fail(at, "it cannot be read there");
    try {
      if (opcode == kChunk)
        read_chunk(record, take);
      else
        read_plain(opcode, record, take);
    } catch (const DamagedBytes& damaged) {
      fail(at, damaged.what);
    }
    at += 9 + length;
    return true;
  }

  /// Counts what stays in memory: definitions shrink well, and a small chunk can hold a lot of them.
  void keep(std::uint64_t bytes) {
    kept_ += bytes;
    if (kept_ > kMostKept)
      throw DamagedBytes{0, fmt::format("schemas and channels of more than {} bytes", kMostKept)};
  }

  void read_chunk(std::string_view record, const std::function<void(const LogMessage&)>& take) {
    Fields fields(record);
    fields.number(8), fields.number(8);
    const std::uint64_t size = fields.number(8);
    const auto checksum = static_cast<std::uint32_t>(fields.number(4));
    const std::string compression = fields.text();
    const std::string_view packed = fields.take(fields.number(8));
    if (size > kLargestRecord)
      throw DamagedBytes{0, fmt::format("a chunk of {} bytes, more than {}", size, kLargestRecord)};
    std::string problem;
    if (!unpack(compression, packed, static_cast<std::size_t>(size), chunk_, problem))
      throw DamagedBytes{0, "a chunk that " + problem};
    if (checksum != 0 &&
        checksum != crc32(0, reinterpret_cast<const Bytef*>(chunk_.data()), static_cast<uInt>(size)))
      throw DamagedBytes{0, "a chunk whose checksum is another one"};
    for (Fields inner(chunk_); !inner.ended();) {
      const auto opcode = static_cast<unsigned char>(inner.number(1));
      read_plain(opcode, inner.take(inner.number(8)), take);
    }
  }

  void read_plain(unsigned char opcode, std::string_view record,
                  const std::function<void(const LogMessage&)>& take) {
    Fields fields(record);
    if (opcode == kSchema || opcode == kChannel) keep(record.size());
    if (opcode == kSchema) {
      const auto id = fields.number(2);
      Schema s{fields.text(), fields.text(), {}};
      s.definition = fields.text();
      schemas_[id] = std::move(s);
    } else if (opcode == kChannel) {
      const auto id = fields.number(2), schema = fields.number(2);
      LogChannel c{fields.text(), fields.text(), {}};
      if (schema != 0 && !schemas_.contains(schema))
        throw DamagedBytes{
            0, fmt::format("the channel {} of a schema {} that is not there", shown(c.topic), schema)};
      const Schema& s = schemas_[schema];
      c.type = s.name;
      keep(s.name.size() + s.definition.size());
      if (s.encoding == "ros2msg" || s.encoding == "ros1msg") c.definition = s.definition;
      channels_.emplace(id, std::move(c));  // one that is there already is the same, and is pointed at
    } else if (opcode == kMessage) {
      const auto channel = channels_.find(fields.number(2));
      fields.number(4);
      const auto logged = static_cast<std::int64_t>(fields.number(8)),
                 published = static_cast<std::int64_t>(fields.number(8));
      if (channel == channels_.end()) throw DamagedBytes{0, "a message of a channel that is not there"};
      take({&channel->second, logged, published, fields.rest()});
    }
  }

  std::string path_;
  std::uint64_t size_;
  std::map<std::uint64_t, Schema> schemas_;
  std::map<std::uint64_t, LogChannel> channels_;
  std::string chunk_;
  std::uint64_t kept_ = 0;  ///< [bytes]
};

}  // namespace

std::unique_ptr<MessageLog> open_mcap_log(const std::string& path) { return std::make_unique<McapLog>(path); }

}  // namespace gapscope::internal::recording
