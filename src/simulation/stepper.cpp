#include "gapscope/simulation/stepper.h"

#include "simulation/stepper_effects.h"
#include "simulation/stepper_events.h"
#include "simulation/stepper_sample.h"
#include "simulation/stepper_state.h"
#include "simulation/stepper_uneven.h"

namespace gapscope {

template <class T>
DriveStepper<T>::DriveStepper(const PlantModel<T>& model, double dt, double shortest)
    : impl_(std::make_unique<internal::simulation::StepperImpl<T>>(model, dt, shortest)) {}
template <class T>
DriveStepper<T>::~DriveStepper() = default;
template <class T>
DriveStepper<T>::DriveStepper(DriveStepper&&) noexcept = default;
template <class T>
DriveStepper<T>& DriveStepper<T>::operator=(DriveStepper&&) noexcept = default;
template <class T>
DriveStepper<T>::DriveStepper(const DriveStepper& other)
    : impl_(std::make_unique<internal::simulation::StepperImpl<T>>(*other.impl_)) {}
template <class T>
DriveStepper<T>& DriveStepper<T>::operator=(const DriveStepper& other) {
  *impl_ = *other.impl_;
  return *this;
}

template <class T>
void DriveStepper<T>::reset(const DriveState<T>& state) {
  impl_->reset(state);
}
template <class T>
void DriveStepper<T>::step(const T& u) {
  impl_->step(u);
}
template <class T>
void DriveStepper<T>::step(const T& u, double dt) {
  impl_->step(u, dt);
}
template <class T>
void DriveStepper<T>::inject(const T& dx, const T& dw) {
  impl_->inject(dx, dw);
}
template <class T>
const DriveState<T>& DriveStepper<T>::state() const {
  return impl_->z;
}
template <class T>
T DriveStepper<T>::measured() const {
  return impl_->measured();
}
template <class T>
const ContactMode& DriveStepper<T>::mode() const {
  return impl_->mode;
}
template <class T>
bool DriveStepper<T>::has_load() const {
  return impl_->has_load;
}
template <class T>
bool DriveStepper<T>::closed_in_last_step() const {
  return impl_->closed;
}
template <class T>
long DriveStepper<T>::events() const {
  return impl_->events;
}
template <class T>
long DriveStepper<T>::pieces() const {
  return impl_->smooth_pieces;
}
template <class T>
bool DriveStepper<T>::healthy() const {
  return impl_->healthy;
}

Mode mode_of(const DriveStepper<double>& stepper) {
  if (!stepper.has_load()) return Mode::kOneBody;
  if (stepper.closed_in_last_step()) return Mode::kImpact;
  const int contact = stepper.mode().contact;
  return contact > 0 ? Mode::kEngagementPlus : contact < 0 ? Mode::kEngagementMinus : Mode::kGap;
}

template class DriveStepper<double>;
template class DriveStepper<Jet<4>>;
template class DriveStepper<Jet<8>>;
template class DriveStepper<Jet<12>>;

}  // namespace gapscope
