#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/diagnosis/loop_fit.h"
#include "gapscope/plant/plant_model.h"
#include "reference/model_fit.h"

namespace gapscope::internal::diagnosis {

/// A drive and the controller about it.
struct Loop {
  ReferenceModel model;
  DriveController controller;
};

PlantModel<double> plant_of(const ReferenceModel& model);

/// The model with a lower bound of each number of the drive that has none.
ReferenceModel bounded(ReferenceModel model);

/// A number of a firmware's law that it may not have.
struct LawNumber {
  double DriveController::*member;
  const char *key, *unit;
  double absent;     ///< its value where the law has none
  double low, high;  ///< [unit]

  bool is_in(const DriveController& c) const {
    return std::isnan(absent) ? !std::isnan(c.*member) : c.*member != absent;
  }
};

/// A number of a loop that is fitted. One that cannot be below zero moves in proportion to itself.
class LoopPlace {
 public:
  LoopPlace(reference::ParameterId id, double scale, double low, double high)
      : id_(id), scale_(scale), low_(low), high_(high) {}
  explicit LoopPlace(const LawNumber& number) : law_(&number), low_(number.low), high_(number.high) {}

  /// By so much of its scale, or of itself, within its bounds.
  void move(Loop& loop, double by) const;
  /// The move that shows what the motion owes to it. The goal is taken up at an update: its delay shows by
  /// whole turns of the firmware alone.
  /// @param turn  of the firmware [s]
  double trial(const Loop& loop, double turn) const;
  /// What is open of it by that, in units of a move: half a turn.
  double unseen(const Loop& loop, double turn) const;
  /// @param spread  half of its interval, in units of a move
  LoopNumber told(const Loop& loop, double spread) const;

 private:
  double value(const Loop& loop) const;
  void set(double value, Loop& loop) const;
  double moved(double value, double by) const;

  reference::ParameterId id_;
  const LawNumber* law_ = nullptr;  ///< else a number of the model
  double scale_ = 0.0;              ///< 0: in proportion to itself
  double low_, high_;
};

/// What the model estimates, and what the controller has that nobody declared.
std::vector<LoopPlace> places_of(const Loop& loop, const DriveController& declared,
                                 const LoopFitOptions& options);

/// Delays of goal and output that are too small to be worth adding are not nothing: what stands for them in
/// the drive's numbers would be no more the drive's. They begin at half a turn of the firmware.
/// @param dt  of the rows [s]
void free_timing(Loop& loop, const DriveController& declared, double dt);

/// Something that a loop has.
struct LoopPart {
  std::string key;
  std::function<void(Loop& loop)> take_out;
  bool of_law = false;   ///< of the controller itself, not of the drive
  bool is_late = false;  ///< makes the loop act later, as others do
};

/// Something that a loop may lack, and the sizes at which it is begun with.
struct LoopAddition {
  std::vector<double> starts;
  std::function<void(Loop& loop, double start)> put;
  std::vector<LoopPart> parts;
};

/// Those that the loop does not have.
std::vector<LoopAddition> additions_to(const Loop& loop, std::span<const MotorTrace> recordings);

/// The loop with the torque constant with which its controller holds what hangs on the drive where it stands,
/// and a drive as quick as the motion: what no law of the goal has spoiled. Nothing without such rests, or
/// where the constant is known.
std::optional<Loop> held_at_rest(const Loop& loop, std::span<const MotorTrace> recordings);

}  // namespace gapscope::internal::diagnosis
