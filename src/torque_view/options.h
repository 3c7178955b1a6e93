#pragma once

#include <cstdint>

namespace gapscope::internal::torque_view {

/// Every number of the torque view that was chosen. "Study" is the study of real drives whose sections the
/// origins name; "here" means set with study_torque_view on the recordings that it lists.
struct TorqueViewOptions {
  // Regressors
  double inner_share = 0.6;  ///< σ of the states over σ of the band [-]; here: (0.6, 0.8, 1) is a triangle
  double kernel_reach =
      4.0;  ///< half the length of a kernel [σ]; here: with 3 (study 10.1) J rises by 3 % with frequency
  double rows_per_hertz = 6.0;  ///< rows a second per hertz of the band [-]; study 10.1
  double lost_step = 2.5;       ///< a time step beyond it lost samples [median steps]; study 4.4
  double jump = 12.0;           ///< a step of x beyond it is a jump [median moving steps]; study 4.4
  double stuck_speed = 0.01;    ///< below it the drive stands [std of the speed]; study 2
  double stuck_quanta = 3.0;    ///< or where a kernel sees no more than these [quanta]; study 2
  double most_stuck = 0.3;      ///< of a row's kernel [-]; study 2
  // FrequencyBand
  double lowest_hz = 1.0;       ///< top of the lowest octave [Hz]; study 2
  double fewest_samples = 1.2;  ///< in σ of the states in the widest band [samples]; here
  double most_noise = 0.2;      ///< N/A of the band's last octave: J is 4 % low there [-]; study 2 (0.3: 9 %)
  double inertia_drift = 0.1;   ///< an octave's J below that of those under it [-]; study 2
  double least_inertia = 0.03;  ///< share of the input's power in an octave for its J to count; study 2, here
  double constant_speed = 0.3;  ///< std over mean of the speed: below it a free constant [-]; study 2
  double given_hz = 0.0;        ///< the band where it is known; 0: chosen from the recordings [Hz]
  // Evidence
  double block = 0.5;  ///< of held-out time [s]; study 5
  int draws = 400;     ///< of the bootstrap; study 10.4
  std::uint64_t seed = 1;
  double least_share = 0.2;   ///< of what was left, to be accepted [-]; study 5
  double least_low = 0.1;     ///< the same of its 95 % lower bound [-]; study 5
  double least_better = 0.6;  ///< share of the blocks that improve [-]; study 1.4
  /// Over rivals outside the group, of its own share or, where that is less, of what the rival leaves [-];
  /// study 5, here
  double least_margin = 0.3;
  double least_leading = 0.95;  ///< share of the draws in which it leads them [-]; study 1.4
  double most_left = 0.5;       ///< of the input's rms by a model whose torque a law may read; here
  double most_absorbed =
      0.98;                 ///< of a law's torque by the model that it adds to: beyond it they are one; here
  double same_group = 0.9;  ///< overlap from which laws are one group [-]; study 9
  // Ladder
  int most_rungs = 8;         ///< study 10.5
  double most_encoder = 0.5;  ///< share of what is left that is the encoder's, at which it ends [-]; here
  double last_share = 0.1;    ///< below it the ladder ends [-]; study 10.5
};

}  // namespace gapscope::internal::torque_view
