#include "report/paper.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

namespace gapscope::internal::report {
namespace {

struct Piece {
  uchar* memory = nullptr;
  std::size_t size = 0;
};

/// Memory in pages as large as the system has them.
Piece in_large_pages(std::size_t bytes) {
  constexpr std::size_t kPage = std::size_t{1} << 21;
  const std::size_t size = (bytes + kPage - 1) / kPage * kPage;
  const Piece piece{static_cast<uchar*>(std::aligned_alloc(kPage, size)), size};
  if (piece.memory == nullptr) throw std::bad_alloc();
  madvise(piece.memory, size, MADV_HUGEPAGE);  // a wish: without it everything is as it was
  return piece;
}

/// Where sheets come from, and where the library brings their memory back to.
class Stock final : public cv::MatAllocator {
 public:
  ~Stock() override {
    for (const Piece& piece : pieces_) std::free(piece.memory);
  }

  cv::UMatData* allocate(int dims, const int* sizes, int type, void*, std::size_t* step, cv::AccessFlag,
                         cv::UMatUsageFlags) const override {
    std::size_t bytes = CV_ELEM_SIZE(type);
    for (int i = dims - 1; i >= 0; --i) {
      step[i] = bytes;
      bytes *= static_cast<std::size_t>(sizes[i]);
    }
    const Piece piece = take(bytes);
    auto* sheet = new cv::UMatData(this);
    sheet->data = sheet->origdata = piece.memory;
    sheet->size = piece.size;
    return sheet;
  }

  bool allocate(cv::UMatData* sheet, cv::AccessFlag, cv::UMatUsageFlags) const override {
    return sheet != nullptr;
  }

  void deallocate(cv::UMatData* sheet) const override {
    if (sheet == nullptr) return;
    const std::lock_guard lock(mutex_);
    pieces_.push_back({sheet->origdata, sheet->size});
    delete sheet;
  }

 private:
  /// The smallest that is large enough, or a new one in place of the largest that is not.
  Piece take(std::size_t bytes) const {
    const std::lock_guard lock(mutex_);
    std::sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.size < b.size; });
    auto found =
        std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return p.size >= bytes; });
    if (found != pieces_.end()) {
      const Piece piece = *found;
      pieces_.erase(found);
      return piece;
    }
    if (!pieces_.empty()) {
      std::free(pieces_.back().memory);
      pieces_.pop_back();
    }
    return in_large_pages(bytes);
  }

  mutable std::mutex mutex_;
  mutable std::vector<Piece> pieces_;
};

}  // namespace

cv::Mat sheet(int rows, int columns) {
  static Stock stock;
  cv::Mat image;
  image.allocator = &stock;
  image.create(rows, columns, CV_8UC3);
  return image;
}

}  // namespace gapscope::internal::report
