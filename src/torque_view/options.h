#pragma once

#include <cstdint>

namespace gapscope::internal::torque_view {

/// Every number of the torque view that was chosen, on recordings of a linear axis and of a servo with a
/// pendulum. docs/torque_balance.md tells what half and double of each make of these (study_torque_view
/// --vary).
struct TorqueViewOptions {
  // Regressors
  double inner_share = 0.6;     ///< σ of the states over σ of the band [-]; (0.6, 0.8, 1) is a triangle
  double kernel_reach = 4.0;    ///< half the length of a kernel [σ]; with 3 J rises by 3 % with frequency
  double rows_per_hertz = 6.0;  ///< rows a second per hertz of the band [-]
  double lost_step = 2.5;       ///< a time step beyond it lost samples [median steps]
  double jump = 12.0;           ///< a step of x beyond it is a jump [median moving steps]
  double stuck_speed = 0.01;    ///< below it the drive stands [std of the speed]
  double stuck_quanta = 3.0;    ///< or where a kernel sees no more than these [quanta]
  double most_stuck = 0.3;      ///< of a row's kernel [-]
  // FrequencyBand
  double lowest_hz = 1.0;       ///< top of the lowest octave [Hz]
  double fewest_samples = 1.2;  ///< in σ of the states in the widest band [samples]
  double most_noise = 0.2;      ///< N/A of the band's last octave: J is 4 % low there, at 0.3 9 % [-]
  double inertia_drift = 0.1;   ///< an octave's J below that of those under it [-]
  double least_inertia = 0.03;  ///< share of the input's power in an octave for its J to count
  double constant_speed = 0.3;  ///< std over mean of the speed: below it a free constant [-]
  double given_hz = 0.0;        ///< the band where it is known; 0: chosen from the recordings [Hz]
  // Evidence
  double block = 0.5;  ///< of held-out time [s]
  int draws = 400;     ///< of the bootstrap
  std::uint64_t seed = 1;
  double least_share = 0.2;   ///< of what was left, to be accepted [-]
  double least_low = 0.1;     ///< the same of its 95 % lower bound [-]
  double least_better = 0.6;  ///< share of the blocks that improve [-]
  /// Over rivals outside the group, of its own share or, where that is less, of what the rival leaves [-]
  double least_margin = 0.3;
  double least_leading = 0.95;  ///< share of the draws in which it leads them [-]
  double most_left = 0.5;       ///< of the input's rms by a model whose torque a law may read
  double most_absorbed = 0.98;  ///< of a law's torque by the model that it adds to: beyond it they are one
  double same_group = 0.9;      ///< overlap from which laws are one group [-]
  // Ladder
  int most_rungs = 8;         ///< laws that are added at most
  double most_encoder = 0.5;  ///< share of what is left that is the encoder's, at which it ends [-]
  double last_share = 0.1;    ///< below it the ladder ends [-]
};

}  // namespace gapscope::internal::torque_view
