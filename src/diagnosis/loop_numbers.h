#pragma once

#include <functional>
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

/// A number of a loop that is fitted. One that cannot be below zero moves in proportion to itself.
class LoopPlace {
 public:
  LoopPlace(reference::ParameterId id, double scale, double low, double high)
      : id_(id), scale_(scale), low_(low), high_(high) {}
  LoopPlace(double DriveController::*member, const char* key, const char* unit, double low, double high)
      : member_(member), key_(key), unit_(unit), low_(low), high_(high) {}
  /// The delay of the goal.
  LoopPlace(double low, double high) : is_goal_delay_(true), low_(low), high_(high) {}

  /// By so much of its scale, or of itself, within its bounds.
  void move(Loop& loop, double by) const;
  LoopNumber told(const Loop& loop) const;

 private:
  double value(const Loop& loop) const;
  void set(double value, Loop& loop) const;

  reference::ParameterId id_;
  bool is_goal_delay_ = false;
  double DriveController::*member_ = nullptr;  ///< else a number of the model
  const char* key_ = "";
  const char* unit_ = "";
  double scale_ = 0.0;  ///< 0: in proportion to itself
  double low_, high_;
};

/// What the model estimates, and what the controller has that nobody gave.
std::vector<LoopPlace> places_of(const Loop& loop, const LoopFitOptions& options);

/// Something that a loop may lack, and the sizes at which it is begun with.
struct LoopAddition {
  std::string key;
  std::vector<double> starts;
  std::function<void(Loop& loop, double start)> put;
  bool of_law = false;  ///< of the controller itself, not of the drive
};

/// Those that the loop does not have.
std::vector<LoopAddition> additions_to(const Loop& loop, std::span<const MotorTrace> recordings,
                                       const LoopFitOptions& options);

}  // namespace gapscope::internal::diagnosis
