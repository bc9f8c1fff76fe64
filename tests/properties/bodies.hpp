// Random grids, and bodies on them.
#pragma once
#include "tests/properties/random.hpp"
#include "tests/unit/solver/small_scene.hpp"

#include <memory>

namespace properties {

using namespace gault::core;
using namespace gault::core::test;

constexpr double lame = 40e6, shear = 30e6, rounding = 1e-15;

inline Symmetry random_symmetry() {
    return coin() ? Symmetry::axisymmetric : Symmetry::plane_strain;
}

inline Shape random_shape(Symmetry symmetry) {
    Shape shape;
    shape.symmetry = symmetry;
    shape.frame = coin() ? Frame::total : Frame::updated;
    shape.basis = coin() ? Basis::linear : Basis::quadratic;
    shape.lower = {symmetry == Symmetry::axisymmetric ? uniform(0.0, 1.0) : uniform(-1.0, 1.0),
                   uniform(-1.0, 1.0)};
    for (int k = 0; k < 2; ++k) {
        shape.upper[k] = shape.lower[k] + uniform(0.5, 2.0);
        shape.axes[k] = {whole(2, 6), uniform(0.7, 1.4)};
    }
    const int side = whole(2, 4);
    shape.per_cell = side * side;
    shape.placement = coin() ? Placement::gauss : Placement::uniform;
    return shape;
}

// A body under a random stress, without loads. Stress update first, so that a step moves no walls in the updated frame.
struct RandomBody {
    std::array<double, 6> stress;
    TestMaterial soil{lame, shear};
    SmallScene scene;
    std::unique_ptr<Body> body;

    explicit RandomBody(const Shape& shape, double size) : scene(shape) {
        for (int k = 0; k < 6; ++k)
            stress[k] = k < 4 ? size * uniform(-1.0, 1.0) : 0.0;
        soil.start = [this](gault_points& p, gault_error&) {
            for (int64_t i = 0; i < p.count; ++i)
                for (int k = 0; k < 6; ++k)
                    p.stress[k][i] = stress[k];
            return gault_status(GAULT_OK);
        };
        scene.add(soil, 1600.0);
        scene.scene.solver.stress_update = StressUpdate::usf;
        body = std::make_unique<Body>(scene.scene);
    }
    bool total() const { return scene.scene.frame == Frame::total; }
    double smallest_cell() const {
        double h = HUGE_VAL;
        for (int k = 0; k < 2; ++k)
            for (const double length : body->model.grid.axis(k).length())
                h = length > 0.0 ? std::min(h, length) : h;
        return h;
    }
};

} // namespace properties
