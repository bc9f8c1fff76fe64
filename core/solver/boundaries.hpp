// Asks the boundary conditions what they want, and imposes it: prescribed components and nodal forces.
#pragma once
#include "core/config/scene.hpp"
#include "core/registry/instance.hpp"
#include "core/solver/stable_step.hpp"
#include "core/solver/stiffness.hpp"
#include "core/solver/surface.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

// What lies behind a surface, for absorbing and far-field conditions.
struct SoilBehind {
    double impedance_p, impedance_s; // rho c_p, rho c_s; Pa s/m
    double shear_modulus;            // Pa
    std::array<double, 3> stress;    // initial xx yy xy, tension positive, Pa
};

class Boundaries {
  public:
    // `behind` answers for the soil at a reference position.
    Boundaries(const Scene& scene, const Motion& motion,
               const std::function<SoilBehind(const std::array<double, 2>&)>& behind);

    // Prescribed components at `time`; `value` has a meaning where they are, if dt is not 0. Throws InputError
    // when two conditions contradict each other.
    void constrain(const Motion& motion, double time, double dt, FixedField& fixed, VectorField& value);
    // Nodal forces from surface loads at the present positions; only nodes of the sides are written.
    // `stiffness`, if any, += -d(force)/d(displacement).
    void load(const Motion& motion, double time, double dt, const VectorField& velocity, VectorField& force,
              Stiffness* stiffness = nullptr);
    // The fastest rate, 1/s, at which the dashpots of the soil that boundaries stand for take the velocity of a
    // node: the sum of its row over its mass, so no less than the largest eigenvalue.
    double dashpot_rate(const Motion& motion);
    // Surfaces are counted as in Scene::surfaces: the four sides first.
    Surface& surface(int index) { return surfaces_[index]; }
    const Surface& surface(int index) const { return surfaces_[index]; }

    // Of the last load: the force on a surface, N, whichever name of it a condition used.
    const std::array<double, 2>& load_on(int surface) const { return load_on_[surface]; }
    using Loads = std::vector<std::array<double, 2>>; // of every surface
    const Loads& loads() const { return load_on_; }
    void restore(const Loads& loads) { load_on_ = loads; }
    // The part of what holds node k of a surface along its normal that acts on this surface, 0 to 1. A force
    // that holds a node acts on the surfaces of its side that hold it, spread over them as the node's function
    // is. So the parts that tile a side add up to the side, a part under pressure alone takes nothing of what
    // holds its neighbour, and a uniform pressure on two held parts is shared exactly.
    double share(int surface, std::size_t k, const FixedField& fixed) const;

    // Where the listeners of a control named `name` on a surface (any if nullopt) keep it; `unit` gets the
    // unit of a listener.
    std::vector<double*> listeners(const std::string& name, std::optional<int> surface, std::string& unit);
    std::vector<std::string> control_names(std::optional<int> surface) const;

    std::vector<std::string> description() const; // what each part and boundary took hold of, a line each

  private:
    struct Held { // one boundary on one surface
        std::vector<std::array<int, 2>> ij;
        std::vector<std::size_t> node;
        std::array<Column, 3> reference, position, normal, displacement, fixed, velocity;
    };
    struct Loaded {
        std::array<Column, 3> position, normal, displacement, velocity, traction, initial_traction;
        std::array<Column, 2> impedance;
        Column shear_modulus, pressure;
        std::array<Column, 9> slope; // made when first asked for
    };
    struct Condition {
        Instance instance;
        std::vector<int> surfaces;
        std::vector<double> control;
        std::vector<Held> held;     // one a surface; empty without `constrain`
        std::vector<Loaded> loaded; // one a surface; empty without `load`
        Location where;
        std::vector<std::string> names; // of the surfaces
        const gault_boundary_api& api() const { return instance.api<gault_boundary_api>(); }
        bool is_on(std::optional<int> surface) const; // on any, if nullopt
    };
    void hold(Condition& condition, const Motion& motion);
    void prepare_load(Condition& condition,
                      const std::function<SoilBehind(const std::array<double, 2>&)>& behind);
    void impose(const Condition& condition, int surface, const Held& held, bool moves, FixedField& fixed,
                VectorField& value) const;
    [[noreturn]] void refuse(const Condition& condition, gault_status status, const gault_error& error) const;

    void add_load(int surface, int cell, const std::array<double, 2>& force);

    std::vector<Surface> surfaces_;
    std::vector<std::vector<int>> beside_; // surfaces on the same side, by surface; itself among them
    Loads load_on_;
    std::vector<std::string> parts_; // what each is
    std::vector<Condition> conditions_;
};

} // namespace gault::core
