// Forces of a trial displacement, and their derivative: what a solver without inertia iterates on.
#pragma once
#include "core/solver/log_strain.hpp"
#include "core/solver/model.hpp"
#include "core/solver/motion.hpp"
#include "core/solver/stiffness.hpp"

#include <memory>
#include <string>
#include <vector>

namespace gault::core {

class Equilibrium {
  public:
    Equilibrium(Model& model, Motion& motion,
                VolumetricStrain volumetric_strain = VolumetricStrain::pointwise);

    struct Answer {
        bool found = false;
        double largest_strain = 0.0; // component of the step; also where nothing was found because of it
        double fraction = 0.5;       // of the step that is worth trying where nothing was found
        std::string reason;          // why not; empty: the strain is too large
        std::shared_ptr<const PointError> failed; // a soil has no result for what was tried
    };
    // New stresses and states of all points for nodes displaced by `du` since `start`; `internal`, the forces
    // on the nodes, N; `stiffness` += -d(internal)/d(du). Stops early where a strain component passes
    // `limit`.
    Answer evaluate(const Motion::State& start, const VectorField& du, const Moment& moment, double limit,
                    VectorField& internal, Stiffness& stiffness);
    int64_t updates() const { return updates_; } // constitutive updates of points so far

  private:
    struct PointWork;
    struct CellWork;
    Answer evaluate(const Motion::State& start, const VectorField& du, const Moment& moment, double limit,
                    int material, const Batch& batch, VectorField& internal, Stiffness& stiffness);
    void make_room();
    bool strain(const Motion::State& start, const VectorField& du, int material, std::size_t slot,
                PointWork& work) const;
    void share_volume(std::vector<PointWork>& work, std::vector<CellWork>& cells, const Batch& batch) const;
    void assemble(const std::vector<PointWork>& work, const Batch& batch, int material,
                  const double* const* tangent, VectorField& internal, Stiffness& stiffness) const;

    Model& model_;
    Motion& motion_;
    VolumetricStrain volumetric_strain_;
    std::vector<Workspace> workspace_; // one a material
    std::vector<Column> tangent_;      // of a batch, 6 x 6
    int64_t updates_ = 0;
};

} // namespace gault::core
