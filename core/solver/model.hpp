// Grid, materials and points of a scene, at rest in the initial stress.
#pragma once
#include "core/config/scene.hpp"
#include "core/grid/grid.hpp"
#include "core/points/points.hpp"
#include "core/solver/boundaries.hpp"
#include "core/solver/material.hpp"

#include <array>
#include <functional>
#include <vector>

namespace gault::core {

struct Model {
    Grid grid;
    std::vector<Material> materials;
    std::vector<Points> points;           // one a material
    std::vector<int> material_of_cell;    // row * columns + column
    std::vector<std::string> description; // what every region took hold of, a line each

    // Initial vertical stress (axis y) and its ratio to the others, compression positive, Pa.
    double vertical_stress(const Scene& scene, int column, double y) const;
    // Answers for the soil at a reference position, as long as the points lie where they began.
    std::function<SoilBehind(const std::array<double, 2>&)> behind(const Scene& scene);
};

Model build_model(const Scene& scene);

} // namespace gault::core
