#pragma once

#include <cstddef>
#include <functional>

namespace gapscope {

/// Calls work(i) once for each i in [0, count), on at most `threads` threads at a time (0: as many as there
/// are cores), in no particular order. Pieces may take unequal time. An exception of a piece stops those that
/// have not begun and is thrown again here.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// `threads`, or the number of cores for 0.
int thread_count(int threads);

}  // namespace gapscope
