// How long the steps of a quasi-static run may be for the soil's own integration of stress.
#pragma once
#include "core/solver/material.hpp"

namespace gault::core {

struct StepLength {
    double strain_step; // the largest strain component of a step
    double error;       // relative, of the pressure that opens a cavity by 1 or 5 % in such steps
};

// Opens a cavity by 1 and 5 % in the soil, volume kept, under this mean stress (Pa, compression positive), with what one point
// after another answers to as many steps as its radius sees (Palmer 1972), and shortens the steps until four times as
// many make no difference. The default where the soil gives no answer or depends on the rate.
StepLength longest_step(const Material& material, double pressure, double accuracy);

} // namespace gault::core
