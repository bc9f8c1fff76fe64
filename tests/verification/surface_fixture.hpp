// Nodes and facets of a surface for tests of boundary conditions.
#pragma once
#include "plugin_fixture.hpp"

namespace plugin_test {

using Vector = std::array<double, 3>;

// Set points: what the boundary declares until a test changes them.
inline std::vector<double> initial_controls(const gault_boundary_api& api) {
    std::vector<double> controls;
    for (uint32_t i = 0; i < api.control_count; ++i)
        controls.push_back(api.controls[i].initial);
    return controls;
}

class Nodes {
  public:
    Nodes(const Component& boundary, const std::vector<Vector>& normals)
        : control(initial_controls(boundary.api<gault_boundary_api>())), boundary_(boundary) {
        const auto count = static_cast<int64_t>(normals.size());
        nodes_.size = sizeof nodes_;
        nodes_.count = count;
        nodes_.padded = (count + 7) / 8 * 8;
        nodes_.dt = 1.0;
        nodes_.control = control.data();
        for (int axis = 0; axis < 3; ++axis) {
            nodes_.position[axis] = zero_.emplace_back(count).data();
            nodes_.displacement[axis] = zero_.emplace_back(count).data();
            nodes_.fixed[axis] = fixed.emplace_back(count).data();
            nodes_.velocity[axis] = velocity.emplace_back(count, unset).data();
            Column& normal = normals_.emplace_back(count);
            for (std::size_t i = 0; i < normals.size(); ++i)
                normal[static_cast<int64_t>(i)] = normals[i][axis];
            nodes_.normal[axis] = normal.data();
        }
    }
    Nodes(const Nodes&) = delete;

    gault_status constrain() {
        for (Column& column : fixed)
            for (int64_t i = 0; i < nodes_.padded; ++i)
                column[i] = 0.0;
        return boundary_.api<gault_boundary_api>().constrain(boundary_.self(), &nodes_, &error);
    }

    static constexpr double unset = 1e30;
    std::vector<double> control;
    Columns fixed, velocity;
    gault_error error{-1, 0, -1, ""};

  private:
    const Component& boundary_;
    Columns zero_, normals_;
    gault_nodes nodes_{};
};

// Facets with a normal along x.
class Facets {
  public:
    Facets(const Component& boundary, int64_t count)
        : control(initial_controls(boundary.api<gault_boundary_api>())), pressure(count),
          boundary_(boundary) {
        facets_.size = sizeof facets_;
        facets_.count = count;
        facets_.padded = (count + 7) / 8 * 8;
        facets_.control = control.data();
        facets_.pressure = pressure.data();
        for (int axis = 0; axis < 3; ++axis) {
            facets_.position[axis] = facets_.displacement[axis] = inputs_.emplace_back(count).data();
            facets_.velocity[axis] = inputs_.emplace_back(count).data();
            facets_.normal[axis] = inputs_.emplace_back(count, axis == 0 ? 1.0 : 0.0).data();
            facets_.initial_traction[axis] = inputs_.emplace_back(count).data();
            facets_.traction[axis] = traction.emplace_back(count).data();
        }
        facets_.impedance[0] = facets_.impedance[1] = facets_.shear_modulus =
            inputs_.emplace_back(count).data();
    }
    Facets(const Facets&) = delete;

    gault_status load(double time) {
        facets_.time = time;
        for (int64_t i = 0; i < facets_.padded; ++i)
            pressure[i] = 0.0;
        return boundary_.api<gault_boundary_api>().load(boundary_.self(), &facets_, &error);
    }

    std::vector<double> control;
    Column pressure;
    Columns traction;
    gault_error error{-1, 0, -1, ""};

  private:
    const Component& boundary_;
    Columns inputs_;
    gault_facets facets_{};
};

} // namespace plugin_test
