#include "recording/unpack.h"

#include <fmt/format.h>
#ifdef GAPSCOPE_LZ4
#include <lz4frame.h>
#endif
#ifdef GAPSCOPE_ZSTD
#include <zstd.h>
#endif

#include "base/shown.h"

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

}  // namespace

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

}  // namespace gapscope::internal::recording
