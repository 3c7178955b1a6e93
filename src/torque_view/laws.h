#pragma once

#include <Eigen/Dense>
#include <span>
#include <string_view>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/plant/effect.h"
#include "torque_view/effect_values.h"

namespace gapscope::internal::torque_view {

/// What a law reads at the samples of one recording.
struct Samples {
  std::span<const double> t, x, w, a;
  std::span<const double> tau;       ///< torque of the model so far: the right side of u = τ
  std::span<const double> tau_load;  ///< the same without its friction
  double inertia = 0.0, viscous = 0.0;
};

/// What the grids of the laws' shapes are measured in; of the fit recordings.
struct Scales {
  double start = 0.0, duration = 1.0;  ///< [s]
  double speed_std = 1.0, speed_rms = 1.0, top_speed = 1.0;
  double travel = 1.0, torque_rms = 1.0;
  double hz = 1.0;        ///< top of the band
  ShaftTurns turns = {};  ///< along 2π; none of a slide
  bool held_output = false;
  bool one_speed = false;          ///< a recording has one
  double line = kNaN;              ///< cycles per 2π of the strongest line in the model; NaN: none
  double ripple = kNaN;            ///< the same of its ripple
  std::vector<double> lines = {};  ///< where a line is looked for beside its grid [cycles per 2π]
};

/// The shapes that a law is tried at, in rising order; one NaN where it has none.
using Shapes = std::vector<double> (*)(const Scales&);
/// The law's torques per unit of its coefficients (samples × columns).
using Fill = void (*)(const Samples&, const Shape& shape, Eigen::Ref<Eigen::MatrixXd> g);

enum class Kind {
  kMotion,    ///< of the motion alone
  kFriction,  ///< that, against the motion: no part of the torque that gears carry
  kOnTorque,  ///< of the model's torque: command side, or friction that grows with the load
};

enum class Sign { kAny, kPositive, kNegative, kShareOfInertia };

/// One row of the table: u = J a + d w + Σ θ g(x, w, a, τ, t; shape).
struct Law {
  const char* name;
  const char* effect;   ///< of the catalogue; "": it has none
  const char* simpler;  ///< the law that it adds to; nullptr: it stands alone
  int columns;
  Kind kind;
  bool follows_states;  ///< nearly linear in the smoothed states: through G_o instead of G
  bool line;            ///< sine and cosine of an angle: an amplitude and a phase
  Sign sign;            ///< of the first coefficient; a candidate that violates it is absent
  Shapes shapes;
  Fill fill;
  EffectValues values;     ///< of the effect; nullptr: it has none, or one that needs another structure
  int shape_at;            ///< place of the shape among the effect's parameters; -1: it is none of them
  int harmonic = 0;        ///< of the line that it adds to: more of the same effect; 0: it is none
  int parameters() const;  ///< coefficients and shape
};

/// Whether two rows are of the same torque: a spring stands in two, by itself and with friction that it
/// brings along.
bool is_same_torque(const Law& a, const Law& b);

std::span<const Law> laws();
const Law& law(std::string_view name);  ///< @throws std::logic_error if there is none

/// What the motor feels of a load that swings on its spring when a recording begins, per unit of its place
/// and of its speed there (samples × 2). A recording has its own amount of it, which is no number of the
/// drive.
void starting_swing(const Samples& s, const Shape& spring, Eigen::Ref<Eigen::MatrixXd> g);

/// Two cycles over the travel to what passes the band at the rms speed, Δk = π/2 over the travel.
std::vector<double> line_grid(const Scales& scales);

}  // namespace gapscope::internal::torque_view
