// A scene of configs/, with changes, driven to the end of its program; the points are then at hand.
#pragma once
#include "core/scheduler/program.hpp"
#include "core/scheduler/run.hpp"
#include "core/scheduler/snapshot.hpp"
#include "core/solver/explicit.hpp"

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

// `file` relative to configs/, without its ending.
inline Scene scene_of(const std::string& file, const std::vector<Override>& overrides) {
    return read_scene(GAULT_SOURCE_DIR "/configs/" + file + ".yaml", overrides, registry());
}

struct HardScene {
    Scene scene;
    Model model;
    ExplicitSolver solver;
    Program program;
    std::vector<std::vector<double>> rows; // time, then the records

    explicit HardScene(const std::string& file, const std::vector<Override>& overrides = {})
        : scene(scene_of(file, overrides)), model(build_model(scene)), solver(scene, model, 1),
          program(scene, solver) {}

    // Steps end at events; `after` is called at the end of each.
    HardScene& run(const std::function<void()>& after = {}) {
        Program::Answer answer = program.advance(0.0, solver.allowed_step());
        keep(answer);
        while (!answer.done) {
            const double dt = std::min(solver.allowed_step(), answer.next - solver.time());
            solver.step(dt);
            answer = program.advance(dt, solver.allowed_step());
            keep(answer);
            if (after) after();
        }
        return *this;
    }
    std::vector<double> column(const std::string& name) const {
        const std::size_t k = name == "time" ? 0 : 1 + program.column(name).value();
        std::vector<double> values;
        for (const auto& row : rows)
            values.push_back(row[k]);
        return values;
    }
    double last(const std::string& name) const { return column(name).back(); }
    PointArrays points() const { return collect(const_cast<HardScene*>(this)->solver.motion()); }

  private:
    void keep(const Program::Answer& answer) {
        if (!answer.emit) return;
        rows.push_back({solver.time()});
        rows.back().insert(rows.back().end(), program.record().begin(), program.record().end());
    }
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
