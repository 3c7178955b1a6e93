#pragma once

#include <memory>
#include <span>

#include "gapscope/plant/drive.h"

namespace gapscope::benchmark_peers {

/// A general integrator on the drive's problem. What a run needs is allocated when the peer is made.
class Peer {
 public:
  virtual ~Peer() = default;
  /// From rest: x1 [rad] at the start of each sample, for the input u held over samples of dt [s]. Absolute
  /// and relative tolerance are the same number. Returns the number of events.
  virtual long run(std::span<const double> u, double dt, double tolerance, std::span<double> x1) = 0;
};

std::unique_ptr<Peer> make_odeint_peer(const DriveParameters<double>& drive);
/// SUNDIALS CVODE, by backward differentiation (Newton, dense, exact Jacobian) or by Adams' method (fixed
/// point).
std::unique_ptr<Peer> make_cvode_bdf_peer(const DriveParameters<double>& drive);
std::unique_ptr<Peer> make_cvode_adams_peer(const DriveParameters<double>& drive);

}  // namespace gapscope::benchmark_peers
