#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/one_body.h"

namespace gapscope::internal::sliding_mode {

// Half and double of each were run on study_sliding_mode 4610001 24 gap_free sine and 4100001 24 gap sine: 14
// of the first get a `none` and no gap of the second is denied, whatever the value but where it is told. What
// is left changes as told; 4100005 and 4100010 (gaps) have several minima, 12 and 1.5 times apart, and change
// with any of them.
/// That a period is followed at; half leaves up to 7 times as much.
inline constexpr double kInstants = 400.0;
/// Over which what is left is averaged, of a period. Half averages more away: one `none` more (15), 0.6 to 1
/// times as much; double up to 1.6 times.
inline constexpr double kMeans = 80.0;

/// The recording at the instants at which it is followed.
struct Instants {
  double dt = 0.0;
  std::vector<double> u, x;
  struct Period {
    std::size_t first = 0, last = 0;
    std::size_t mean() const {  ///< instants that one takes
      return std::max<std::size_t>(1,
                                   static_cast<std::size_t>(static_cast<double>(last - first + 1) / kMeans));
    }
    std::size_t means() const { return (last - first + 1) / mean(); }
  };
  std::vector<Period> periods;
  double fastest = 0.0, strongest = 0.0;  ///< [rad/s], of u

  std::size_t means() const {
    std::size_t all = 0;
    for (const Period& p : periods) all += p.means();
    return all;
  }

  double speed(std::size_t i, std::size_t reach) const {
    const std::size_t from = i - std::min(i, reach), to = std::min(i + reach, x.size() - 1);
    return (x[to] - x[from]) / (dt * static_cast<double>(to - from));
  }
};

Instants instants_of(const MotorTrace& trace, const signals::SignalFacts& facts);

/// The law, the speed at the begin of each period [rad/s], and what they leave [rad].
struct OneBodyState {
  OneBodyLaw law;
  Eigen::VectorXd speeds;
  double left = kInfinity;
};

/// From `state` downhill.  @param fades  whether the friction may fade with speed
OneBodyState improved(const Instants& s, const OneBodyLaw& scales, const OneBodyState& state, bool fades);

/// One instant further: torque a and friction are constant meanwhile, but for the friction's sign.
void advance(const OneBodyLaw& law, double a, double dt, double& x, double& v);

}  // namespace gapscope::internal::sliding_mode
