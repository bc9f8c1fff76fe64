// A run of the scene that is cheap: without inertia, on few cells, in radial symmetry where that shows it.
#pragma once
#include "core/plan/plan.hpp"

#include <exception>
#include <vector>

namespace gault::core {

struct Pilot {
    std::size_t points = 0;
    int64_t steps = 0, updates = 0, iterations = 0;
    double end = 0.0;              // of the program, s
    double inelastic_radius = 0.0; // the largest, reference, at which the soil is not elastic at the end, m
    // Of the program's surface, where the program stopped a step: at ends of phases, rows, its end.
    struct Mark {
        double time, force, displacement; // s, N, m
    };
    std::vector<Mark> marks;  // in time; none: it has no surface
    std::string trouble;      // why it did not come to its end; empty: it did
    std::exception_ptr wrong; // the scene is
};

Pilot run_pilot(const Scene& scene, const Reread& reread, double seconds,
                const std::vector<Override>& more = {});

} // namespace gault::core
