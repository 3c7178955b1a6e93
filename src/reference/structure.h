#pragma once

#include "reference/outcome.h"

namespace gapscope::internal::reference {

/// Refits the free run from the optimum with each law that the drive may have in place of its own: a
/// Hunt-Crossley and a hardening contact, a load that needs more to break away than to slide. A few exact
/// derivatives each. Nothing where no gap is estimated or the values are not those of a free run.
void try_rival_laws(const FitProblem& problem, FitOutcome& outcome);

/// Names the numbers whose bound keeps them from a better fit. Any bound that somebody has chosen may; zero
/// is the drive's own and does only where beyond it, by the slope of the cost, or from a start within the
/// bounds the fit is better by more than chance.
void find_pressed(const FitProblem& problem, FitOutcome& outcome);

/// Tells the laws that explain as much, and has the interval of the gap hold what they make of it.
void tell_structure(const FitProblem& problem, const FitOutcome& outcome, FitSummary& summary);

}  // namespace gapscope::internal::reference
