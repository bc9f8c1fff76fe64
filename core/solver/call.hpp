// One call of a soil model on a batch of points: what update.cpp and at_rest.cpp share.
#pragma once
#include "core/solver/material.hpp"

namespace gault::core {

// A gault_points over `n` slots from `first` on, with what it points at. The old states, in columns of the workspace,
// are left to the caller.
struct Call {
    gault_points p{};

    Call(const Material& material, Points& points, std::size_t first, std::size_t n, const BatchView& view,
         Workspace& workspace, const Moment& moment);
};

gault_status update(const Material& material, gault_points& points, gault_error& error);

// The fields that the model asks for.
void fill_inputs(const Material& material, gault_points& p, const BatchView& view, Workspace& workspace,
                 std::size_t n, const GridView& grid);

// Effective stress of undrained soil: tension positive, total + pore pressure.
void take_water_off(const Material& material, const double* excess, std::size_t n, double* const* stress);
// The water resists the change of volume, and bears its share of the total stress.
void put_water_back(const Material& material, const gault_points& p, double* const* tangent);

// The call of the i-th point, to ask it again.
std::shared_ptr<const ElementReplay> replay(const Material& material, const gault_points& p, std::size_t i);

} // namespace gault::core
