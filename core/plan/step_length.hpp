// How long the steps of a quasi-static run may be: stress follows a path, and a soil integrates it along a chord a step.
#pragma once
#include "core/plan/plan.hpp"

namespace gault::core {

struct StepLength {
    double strain_step; // the largest strain component of a step
    std::string reason;
};

// From two pilot runs of the scene, with usual and with shorter steps: force and displacement of the program's surface at
// ends of phases, as far as their times are the same, and at its end.
StepLength longest_step(const Scene& scene, const Reread& reread, double patience);

} // namespace gault::core
