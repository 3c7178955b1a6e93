#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "run/run_pipeline.h"

namespace gapscope::internal::python {

/// Does work in a thread of its own while this one, which holds the interpreter's lock, lets go of it and
/// looks for signals: what their handlers raise (KeyboardInterrupt at Ctrl-C), and what the callback raises,
/// stops the work at its next stop point and is raised here. Of several calls in one process one works at a
/// time, since whoever stops it stops all.
/// @param callback  a callable that is told what begins, or None
/// @throws whatever the work does
void watch(const pybind11::object& callback, const std::function<void(const Progress& progress)>& work);

}  // namespace gapscope::internal::python
