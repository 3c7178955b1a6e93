#pragma once

#include <cmath>
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

/// Those that there are.
struct LawNumbers {
  static constexpr LawNumber gain = {
      &DriveController::gain, "controller.position.gain", "unit of u/rad", kNaN, 1e-9, 1e9};
  static constexpr LawNumber delay = {
      &DriveController::delay, "controller.position.delay", "s", 0.0, 1e-5, 0.3};
  static constexpr LawNumber goal_delay = {
      &DriveController::goal_delay, "controller.goal_delay_s", "s", 0.0, 1e-4, 0.5};
  static constexpr LawNumber goal_filter = {
      &DriveController::goal_filter, "controller.goal_filter_s", "s", 0.0, 1e-4, 5.0};
  static constexpr LawNumber profile_speed = {
      &DriveController::profile_speed, "controller.profile.speed", "rad/s", kInfinity, 1e-3, 1e4};
  static constexpr LawNumber profile_acceleration = {&DriveController::profile_acceleration,
                                                     "controller.profile.acceleration",
                                                     "rad/s^2",
                                                     kInfinity,
                                                     1e-2,
                                                     1e6};
  static constexpr LawNumber saturation = {
      &DriveController::saturation, "controller.position.saturation", "unit of u", kInfinity, 1e-6, 1e9};
  static constexpr LawNumber falls_at = {
      &DriveController::falls_at, "controller.position.falls_at", "rad", kInfinity, 1e-4, 100.0};
  static constexpr LawNumber off_damping = {
      &DriveController::off_damping, "controller.off_damping", "N m s/rad", kNaN, 1e-9, 1e9};
  static constexpr LawNumber falls_sharpness = {
      &DriveController::falls_sharpness, "controller.position.falls_sharpness", "", 2.0, 0.5, 20.0};
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

/// The loop with a firmware of another rate, goal and output on average as late as they are where the delays
/// have room for it.
/// @param rate  above 0, as that of the loop [Hz]
Loop at_rate(double rate, Loop loop);

}  // namespace gapscope::internal::diagnosis
