// A scene of configs/, with changes, driven to the end of its program; the points are then at hand.
#pragma once
#include "core/plan/plan.hpp"
#include "core/scheduler/run.hpp"
#include "core/scheduler/simulation.hpp"
#include "core/scheduler/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace gault::core::test {

inline const Registry& registry() {
    static const Registry all({GAULT_BINARY_DIR "/lib/gault/plugins"});
    return all;
}

// `file` relative to configs/, without its ending. What the scene leaves open is chosen as the program does.
inline Scene scene_of(const std::string& file, const std::vector<Override>& overrides) {
    const Reread read = [&](const std::vector<Override>& more) {
        std::vector<Override> all = overrides;
        all.insert(all.end(), more.begin(), more.end());
        return read_scene(GAULT_SOURCE_DIR "/configs/" + file + ".yaml", all, registry());
    };
    return read(overrides_of(choose_least(read({}), read)));
}

struct HardScene {
    Scene scene;
    Simulation simulation;
    Solver& solver;
    std::vector<std::vector<double>> rows; // of the history

    explicit HardScene(const std::string& file, const std::vector<Override>& overrides = {})
        : scene(scene_of(file, overrides)), simulation(scene, 1), solver(simulation.solver()) {}

    // `after` is called at the end of each step.
    HardScene& run(const std::function<void()>& after = {}) {
        simulation.start();
        rows.push_back(simulation.row());
        while (!simulation.done()) {
            if (simulation.step() == Simulation::Moved::no) continue;
            if (simulation.row_due()) rows.push_back(simulation.row());
            if (after) after();
        }
        return *this;
    }
    std::vector<double> column(const std::string& name) const {
        std::size_t k = 0;
        while (simulation.columns().at(k).name != name)
            ++k;
        std::vector<double> values;
        for (const auto& row : rows)
            values.push_back(row[k]);
        return values;
    }
    double last(const std::string& name) const { return column(name).back(); }
    // The pressure of the first row whose cavity strain is `strain`, to 1e-7.
    double pressure_at(double strain) const {
        const auto e = column("cavity_strain"), p = column("true_pressure");
        for (std::size_t i = 0; i < e.size(); ++i)
            if (std::abs(e[i] - strain) <= 1e-7 * std::max(1.0, strain)) return p[i];
        return std::nan("");
    }
    PointArrays points() const { return collect(solver.motion()); }
};

// Relative L2 norm over the raw points, weighted with their present volume; `exact` takes the point's number.
template <class Exact>
double l2_error(const PointArrays& p, int component, Exact exact) {
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < p.volume.size(); ++i) {
        const double e = exact(i);
        error += p.volume[i] * (p.stress[component][i] - e) * (p.stress[component][i] - e);
        size += p.volume[i] * e * e;
    }
    return std::sqrt(error / size);
}

inline std::string cells(int n, int m = 1) {
    return "[" + std::to_string(n) + ", " + std::to_string(m) + "]";
}

struct Lame { // plane strain; compression positive, p0 outside, p inside
    double a, b, p, p0, young_modulus, poisson_ratio;
    double constant() const { return (p0 * b * b - p * a * a) / (b * b - a * a); }
    double slope() const { return (p - p0) * a * a * b * b / (b * b - a * a); }
    double radial(double r) const { return constant() + slope() / (r * r); }
    double hoop(double r) const { return constant() - slope() / (r * r); }
    double displacement(double r) const { // outward, from the stress-free state
        return (slope() / r - (1.0 - 2.0 * poisson_ratio) * r * constant()) * (1.0 + poisson_ratio) /
               young_modulus;
    }
};

} // namespace gault::core::test
