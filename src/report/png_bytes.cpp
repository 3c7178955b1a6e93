#include "report/png_bytes.h"

#include <png.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kHead = 8 + 25;  ///< signature and IHDR, after which a pHYs may stand

std::string compressed(const std::string& name, const cv::Mat& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.cols);
  header.height = static_cast<png_uint_32>(image.rows);
  header.format = PNG_FORMAT_BGR;
  header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  const auto bytes = std::make_unique_for_overwrite<char[]>(size);
  if (png_image_write_to_memory(&header, bytes.get(), &size, 0, image.data,
                                static_cast<png_int_32>(image.step), nullptr) == 0)
    throw std::runtime_error(name + ": " + header.message);
  return {bytes.get(), size};
}

/// The cyclic redundancy code of PNG, section 5.5: x³² + x²⁶ + x²³ + ... + 1, low bits first.
std::uint32_t check_code(const std::string& bytes) {
  std::uint32_t rest = ~0u;
  for (const char byte : bytes) {
    rest ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) rest = rest & 1u ? rest >> 1 ^ 0xEDB88320u : rest >> 1;
  }
  return ~rest;
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFFu);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
         big_endian(check_code(type + data));
}

}  // namespace

std::string png_bytes(const std::string& name, const cv::Mat& image, double per_metre) {
  std::string bytes = compressed(name, image);
  const std::string resolution = big_endian(static_cast<std::uint32_t>(std::lround(per_metre)));
  const char metre = 1;
  return bytes.insert(kHead, chunk("pHYs", resolution + resolution + metre));
}

}  // namespace gapscope::internal::report
