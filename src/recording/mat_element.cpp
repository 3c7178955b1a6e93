#include "recording/mat_element.h"

#include <algorithm>
#include <cstring>

namespace gapscope::internal::recording {

std::uint32_t swapped(std::uint32_t x) {
  return (x >> 24) | ((x >> 8) & 0xff00u) | ((x << 8) & 0xff0000u) | (x << 24);
}

MatElement::MatElement(std::ifstream& file, std::uintmax_t place, std::uintmax_t length, bool deflated,
                       bool foreign)
    : file_(file), left_(length), deflated_(deflated), foreign_(foreign) {
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(place));
  if (deflated_ && inflateInit(&zip_) != Z_OK) throw DamagedVariable();
}

MatElement::~MatElement() {
  if (deflated_) inflateEnd(&zip_);
}

MatElement::Tag MatElement::tag() {
  std::array<char, 8> raw{};
  std::array<std::uint32_t, 2> words{};
  read(raw.data(), raw.size());
  std::memcpy(words.data(), raw.data(), raw.size());
  if (foreign_) words = {swapped(words[0]), swapped(words[1])};
  Tag t{words[0], words[1]};
  t.is_small = words[0] >> 16 != 0;
  if (!t.is_small) return t;
  t.type = words[0] & 0xffff, t.length = words[0] >> 16;
  std::copy(raw.begin() + 4, raw.end(), t.within.begin());
  return t;
}

std::vector<char> MatElement::bytes(const Tag& t) {
  if (t.is_small && t.length > t.within.size()) throw DamagedVariable();
  if (t.is_small) return {t.within.begin(), t.within.begin() + t.length};
  if (!deflated_ && t.length > left_) throw DamagedVariable();
  std::vector<char> out(t.length);
  read(out.data(), out.size());
  std::array<char, 8> filling{};
  if (t.length % 8 != 0) read_some(filling.data(), 8 - t.length % 8);
  return out;
}

std::vector<char> MatElement::small_part() {
  constexpr std::uint32_t kMost = 512;
  const Tag t = tag();
  if (t.length > kMost) throw DamagedVariable();
  return bytes(t);
}

std::vector<std::uint32_t> MatElement::small_words() {
  const std::vector<char> raw = small_part();
  std::vector<std::uint32_t> words(raw.size() / 4);
  if (!words.empty()) std::memcpy(words.data(), raw.data(), 4 * words.size());
  if (foreign_) std::transform(words.begin(), words.end(), words.begin(), swapped);
  return words;
}

void MatElement::skip(std::uintmax_t count) {
  std::array<char, 4096> piece{};
  for (; count > 0; count -= std::min<std::uintmax_t>(count, piece.size()))
    read(piece.data(), static_cast<std::size_t>(std::min<std::uintmax_t>(count, piece.size())));
}

void MatElement::finish() {
  char beyond = 0;
  if (deflated_ && read_some(&beyond, 1) != 0) throw DamagedVariable();
}

void MatElement::read(char* to, std::size_t count) {
  if (read_some(to, count) != count) throw DamagedVariable();
}

/// As many bytes as there are left, at most `count`.
std::size_t MatElement::read_some(char* to, std::size_t count) {
  if (!deflated_) {
    const auto some = static_cast<std::size_t>(std::min<std::uintmax_t>(count, left_));
    if (!file_.read(to, static_cast<std::streamsize>(some))) throw DamagedVariable();
    left_ -= some, taken_ += some;
    return some;
  }
  zip_.next_out = reinterpret_cast<Bytef*>(to);
  zip_.avail_out = static_cast<uInt>(count);  // a part has less than 2^32 bytes
  while (zip_.avail_out > 0 && !ended_) {
    if (zip_.avail_in == 0) refill();
    const int status = inflate(&zip_, Z_NO_FLUSH);
    ended_ = status == Z_STREAM_END;
    if (status != Z_OK && !ended_) throw DamagedVariable();
  }
  taken_ += count - zip_.avail_out;
  return count - zip_.avail_out;
}

void MatElement::refill() {
  constexpr std::uintmax_t kPiece = 1 << 16;
  packed_.resize(static_cast<std::size_t>(std::min(left_, kPiece)));
  if (packed_.empty() || !file_.read(packed_.data(), static_cast<std::streamsize>(packed_.size())))
    throw DamagedVariable();
  left_ -= packed_.size();
  zip_.next_in = reinterpret_cast<Bytef*>(packed_.data());
  zip_.avail_in = static_cast<uInt>(packed_.size());
}

}  // namespace gapscope::internal::recording
