#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include "benchmark/peer_drive.h"
#include "benchmark/peers.h"

namespace gapscope::benchmark_peers {
namespace {

namespace odeint = boost::numeric::odeint;
using Dopri5 = odeint::runge_kutta_dopri5<PeerState>;
using Controlled = odeint::result_of::make_controlled<Dopri5>::type;

/// Dormand–Prince 5(4) with step control, the stepper's own dense output and events between steps. The last
/// derivative of a step is the first of the next, the step length lives on from sample to sample.
class OdeintPeer final : public Peer {
 public:
  explicit OdeintPeer(const DriveParameters<double>& drive) : drive_(drive) {}

  long run(std::span<const double> u, double dt, double tolerance, std::span<double> x1) override {
    PeerDrive drive = drive_;
    Controlled stepper = odeint::make_controlled<Dopri5>(tolerance, tolerance);
    PeerState z{};
    double reach = dt;
    for (std::size_t i = 0; i < u.size(); ++i) {
      x1[i] = z[0];
      drive.set_input(u[i]);
      advance(drive, stepper, z, dt, reach);
    }
    return drive.events;
  }

 private:
  /// One step as the dense output sees it.
  struct Step {
    const Controlled& stepper;
    const PeerState &z, &dz, &next, &dnext;
    double h;
    PeerState at(double t) const {
      PeerState z_at;
      stepper.stepper().calc_state(t, z_at, z, dz, 0.0, next, dnext, h);
      return z_at;
    }
  };

  static void advance(PeerDrive& drive, Controlled& stepper, PeerState& z, double rest, double& reach) {
    const auto system = [&drive](const PeerState& x, PeerState& dx, double) {
      drive.derivative(x.data(), dx.data());
    };
    PeerState dz, next, dnext;
    PeerGuards g, g_next;
    system(z, dz, 0.0);
    drive.guards(z.data(), g.data());
    const double least = 1e-14 * rest;
    while (rest > least) {
      const bool last = reach >= rest;
      double t = 0.0, h = last ? rest : reach;
      const bool accepted = stepper.try_step(system, z, dz, t, next, dnext, h) == odeint::success;
      reach = accepted && last ? std::max(reach, h) : h;
      if (!accepted) continue;
      drive.guards(next.data(), g_next.data());
      double event = t;
      const int guard = first_event(drive, {stepper, z, dz, next, dnext, t}, g, g_next, event);
      rest = guard < 0 && last ? 0.0 : rest - event;
      if (guard < 0) {
        z = next, dz = dnext, g = g_next;
        continue;
      }
      z = Step{stepper, z, dz, next, dnext, t}.at(event);
      drive.cross(guard, z.data());
      system(z, dz, 0.0);
      drive.guards(z.data(), g.data());
    }
  }

  /// The guard that falls to zero first within the step, and when; −1 if none does.
  static int first_event(const PeerDrive& drive, const Step& step, const PeerGuards& g,
                         const PeerGuards& g_next, double& event) {
    int first = -1;
    for (int i = 0; i < kGuards; ++i) {
      if (!(g[i] > 0.0 && g_next[i] <= 0.0)) continue;
      const double end = first < 0 ? g_next[i] : value(drive, step, i, event);
      if (end > 0.0) continue;
      event = root(drive, step, i, g[i], end, event);
      first = i;
    }
    return first;
  }

  static double value(const PeerDrive& drive, const Step& step, int guard, double t) {
    PeerGuards g;
    drive.guards(step.at(t).data(), g.data());
    return g[guard];
  }

  /// Bracketed secants (Illinois) until the time stands still: a few evaluations where bisection needs fifty.
  static double root(const PeerDrive& drive, const Step& step, int guard, double g_low, double g_high,
                     double high) {
    double low = 0.0, last = high;
    for (int i = 0; i < 100 && g_high != 0.0; ++i) {
      const double t = high - g_high * (high - low) / (g_high - g_low);
      if (!(t > low && t < high) || std::abs(t - last) < 1e-15 * step.h) return t;
      const double v = value(drive, step, guard, t);
      if (v > 0.0) {
        low = t, g_low = v, g_high *= 0.5;
      } else {
        high = t, g_high = v, g_low *= 0.5;
      }
      last = t;
    }
    return high;
  }

  PeerDrive drive_;
};

}  // namespace

std::unique_ptr<Peer> make_odeint_peer(const DriveParameters<double>& drive) {
  return std::make_unique<OdeintPeer>(drive);
}

}  // namespace gapscope::benchmark_peers
