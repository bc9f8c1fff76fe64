// Measures the code that `run` runs: point-steps a second, the share of each phase, memory.
#pragma once
#include "core/config/scene.hpp"

namespace gault::core {

struct BenchReport {
    std::size_t points;
    int64_t steps;      // timed ones
    double seconds;     // of the timed steps
    double point_steps; // a second
    // Share of the points whose first state changed over the timed steps: for a plastic soil, those that
    // returned to the yield surface.
    double changing;
    struct Phase {
        const char* name;
        double share; // of the first thread's time
    };
    std::vector<Phase> phases;
    double curve_error;     // largest relative error of the scene's first reference curve, NaN without one
    double bytes_per_point; // of the points' columns
};

// Runs the scene to the end of its program without writing results; times the steps of the last `share` of
// the program's time, or all of them where the program does not tell its end.
BenchReport bench_scene(const Scene& scene, int threads, double share);

// Peak resident memory, bytes, of a process of its own that builds the scene and makes a few steps.
double peak_memory(const Scene& scene);

} // namespace gault::core
