#pragma once

#include <string>

#include "config/configuration.h"
#include "gapscope/reference/fit_summary.h"

namespace gapscope::internal::campaign {

/// The numbers that the fit was told, with how far they are off where the plant has others:
/// "motor_inertia, contact_stiffness (1.25 of the plant's)".
std::string told_to(const FitSummary& fit, const Configuration& configuration);

/// Effects, and the law of the contact, that the simulated plant has and the model has not:
/// "contact_adhesion". Empty where there are none, or where nobody knows the drive.
std::string lacked_by_model(const Configuration& configuration);

/// Of the samples that the estimators read: the same text for the same samples alone.
std::string data_of(const std::vector<Recording>& recordings);

}  // namespace gapscope::internal::campaign
