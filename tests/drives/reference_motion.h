#pragma once

#include <cstdint>
#include <vector>

namespace gapscope::independent_plant {

enum class Course {
  kConstantSpeed,  ///< one way, without end
  kSCurve,         ///< forth and back, the acceleration a sine
  kTriangle,       ///< forth and back at one speed
  kTrapezoid,      ///< forth and back, speeding up and slowing down over a quarter of the time each
  kSines,          ///< a sum of sines of incommensurate frequencies, random phases
  kPickAndPlace,   ///< S-curves between random places
  kLevels,         ///< as the trapezoid, each forth and back at the next of some speeds
};

struct ReferenceMotion {
  Course course = Course::kSCurve;
  double travel = 6.0;   ///< peak to peak, constant speed has none [rad]
  double speed = 5.0;    ///< peak; constant speed: its sign is the direction [rad/s]
  double dwell_s = 0.1;  ///< between two moves
  int lines = 4;         ///< of the sines
  int levels = 1;        ///< of speed, down to half of the peak, of kLevels
};

/// What a controller is to follow, at rest at zero before it begins.
struct Target {
  double x = 0.0;  ///< [rad]
  double w = 0.0;  ///< [rad/s]
};

/// A reference motion through time.
class Reference {
 public:
  /// @param seed  of phases and places
  Reference(const ReferenceMotion& motion, double duration, std::uint64_t seed);
  Target at(double t) const;

 private:
  struct Move {
    double start = 0.0, duration = 0.0, from = 0.0, to = 0.0;
  };
  struct Line {
    double amplitude = 0.0, omega = 0.0, phase = 0.0;
  };
  void add_moves(double duration, std::uint64_t seed);
  void add_lines(std::uint64_t seed);
  Target sum_of_lines(double t) const;

  ReferenceMotion motion_;
  std::vector<Move> moves_;
  std::vector<Line> lines_;
};

}  // namespace gapscope::independent_plant
