#include "report/png_bytes.h"

#include <png.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kHead = 8 + 25;  ///< signature and IHDR, after which a pHYs may stand

std::string written(const std::string& name, png_image header, const void* pixels, png_int_32 stride,
                    const void* colours) {
  header.version = PNG_IMAGE_VERSION;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  const auto bytes = std::make_unique_for_overwrite<char[]>(size);
  if (png_image_write_to_memory(&header, bytes.get(), &size, 0, pixels, stride, colours) == 0)
    throw std::runtime_error(name + ": " + header.message);
  return {bytes.get(), size};
}

png_image header_of(const cv::Mat& image, png_uint_32 format, png_uint_32 flags) {
  png_image header{};
  header.width = static_cast<png_uint_32>(image.cols);
  header.height = static_cast<png_uint_32>(image.rows);
  header.format = format, header.flags = flags;
  return header;
}

/// Pixels as places in a list of colours.
struct ListedColours {
  std::vector<png_byte> places, colours;  ///< (rows × cols), (entries × 3)
};

/// With so many levels of each primary colour, white and black among them.
ListedColours listed(const cv::Mat& image, int levels) {
  const int most = levels - 1;
  ListedColours out;
  std::vector<int> place(static_cast<std::size_t>(levels * levels * levels), -1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto& pixel = image.at<cv::Vec3b>(y, x);
      int level[3], which = 0;
      for (int i = 0; i < 3; ++i) which = which * levels + (level[i] = (pixel[i] * most + 127) / 255);
      int& known = place[static_cast<std::size_t>(which)];
      if (known < 0) {
        known = static_cast<int>(out.colours.size() / 3);
        for (const int l : level) out.colours.push_back(static_cast<png_byte>((l * 255 + most / 2) / most));
      }
      out.places.push_back(static_cast<png_byte>(known));
    }
  return out;
}

std::string compressed(const std::string& name, const cv::Mat& image) {
  return written(name, header_of(image, PNG_FORMAT_BGR, PNG_IMAGE_FLAG_FAST), image.data,
                 static_cast<png_int_32>(image.step), nullptr);
}

/// Lines that cross blend into many colours: then fewer levels, of which six cannot make too many.
std::string packed(const std::string& name, const cv::Mat& image) {
  constexpr std::size_t kMostColours = 256;
  ListedColours l;
  for (const int levels : {16, 12, 9, 6})
    if (l = listed(image, levels); l.colours.size() <= 3 * kMostColours) break;
  png_image header = header_of(image, PNG_FORMAT_BGR | PNG_FORMAT_FLAG_COLORMAP, 0);
  header.colormap_entries = static_cast<png_uint_32>(l.colours.size() / 3);
  return written(name, header, l.places.data(), image.cols, l.colours.data());
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

std::string png_bytes(const std::string& name, const cv::Mat& image, double per_metre, bool tight) {
  std::string bytes = tight ? packed(name, image) : compressed(name, image);
  const std::string resolution = big_endian(static_cast<std::uint32_t>(std::lround(per_metre)));
  const char metre = 1;
  return bytes.insert(kHead, chunk("pHYs", resolution + resolution + metre));
}

}  // namespace gapscope::internal::report
