#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "torque_view/laws.h"
#include "torque_view/regressors.h"

namespace gapscope::internal::torque_view {

/// A law in a model, at its shape, with its coefficients.
struct Term {
  const Law* law = nullptr;
  Shape shape;
  Eigen::VectorXd theta;
};
/// u = Σ θ g; the first two are the nominal ones, inertia and viscous damping.
using Model = std::vector<Term>;

Model nominal_model();
/// The contact of a locked output with play, of any form between these positions [rad].
Term contact_term(double low, double high);
const Term* find_term(const Model& model, std::string_view law);     ///< nullptr if there is none
double first_coefficient(const Model& model, std::string_view law);  ///< its first; 0 if it has none

/// Recordings of one purpose in one band, their rows one below the other.
struct Rows {
  /// Shared by copies, which only have their own torques.
  std::shared_ptr<const std::vector<BandRecord>> shared = std::make_shared<std::vector<BandRecord>>();
  std::vector<Eigen::Index> first;  ///< row of each record, and the end
  Eigen::VectorXd u;
  bool free_constant = false;  ///< one per recording: all columns without their mean
  std::vector<double> level;   ///< of the inputs, which the constants take; 0 without them [unit of u]
  std::vector<std::vector<double>> tau, tau_load;  ///< of the model, at the samples
  double inertia = 0.0, viscous = 0.0;
  Eigen::MatrixXd at_samples;  ///< scratch

  const std::vector<BandRecord>& records() const { return *shared; }
  Eigen::Index size() const { return u.size(); }
  double input_square() const;  ///< of the input with its level
  Samples samples(std::size_t record) const;
};

/// Whether a recording has one speed, so that damping, constant and Coulomb friction are one number.
bool is_constant_speed(const BandRecord& record, const TorqueViewOptions& options);

Rows stacked(std::span<const StampedTrace> traces, double hz, bool free_constant,
             const TorqueViewOptions& options);
Scales scales_of(const Rows& rows, const ShaftTurns& turns, bool held_output);

/// A law's columns at the rows.
void fill_columns(Rows& rows, const Law& law, const Shape& shape, Eigen::Ref<Eigen::MatrixXd> columns);
/// What fill_columns() does with what stands in at_samples.
void filter_columns(Rows& rows, const Law& law, std::size_t record, Eigen::Ref<Eigen::MatrixXd> columns);
/// Each recording's mean is taken out where it has a constant of its own.
void centre(const Rows& rows, Eigen::Ref<Eigen::MatrixXd> columns);
Eigen::MatrixXd model_columns(Rows& rows, const Model& model);
/// The spring of a model; nullptr: it has none.
const Term* spring_of(const Model& model);
/// starting_swing() at the rows, two columns a recording that are nothing at the others' rows.
Eigen::MatrixXd swing_columns(Rows& rows, const Shape& spring);

/// Both side by side, where a model has a spring.
Eigen::MatrixXd model_and_swing(Rows& rows, const Model& model);

/// The torque that laws of the command and of the load read: Σ θ g of all terms that read none.
void set_torque(Rows& rows, const Model& model);

/// All coefficients by least squares; where a term reads the model's torque, the best of a few rounds.
Model fitted(Rows& rows, Model model);

/// u − Σ θ g, and without what swings when a recording begins. @param new_phase  a recording keeps a line's
/// amplitude but not where it counts from
Eigen::VectorXd residual(Rows& rows, const Model& model, bool new_phase);

}  // namespace gapscope::internal::torque_view
