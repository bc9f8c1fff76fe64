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

    // Prescribed components at `time`. Throws InputError when two conditions contradict each other.
    void constrain(const Motion& motion, double time, double dt, FixedField& fixed, VectorField& value);
    // Nodal forces from surface loads at the present positions.
    // `stiffness`, if any, += -d(force)/d(displacement).
    void load(const Motion& motion, double time, double dt, const VectorField& velocity, VectorField& force,
              Stiffness* stiffness = nullptr);
    // Of the last load: the force on a side, N.
    const std::array<double, 2>& load_on(int side) const { return load_on_[side]; }
    using Loads = std::array<std::array<double, 2>, 4>; // of every side
    const Loads& loads() const { return load_on_; }
    void restore(const Loads& loads) { load_on_ = loads; }

    Surface& surface(int side) { return surfaces_[side]; }
    const Surface& surface(int side) const { return surfaces_[side]; }

    // A control named `name` on `side` (any side if nullopt): sets every listener, returns how many there
    // are; `unit` gets the unit of a listener.
    std::vector<double*> listeners(const std::string& name, std::optional<int> side, std::string& unit);
    std::vector<std::string> control_names(std::optional<int> side) const;

    std::vector<std::string> description() const; // what each boundary took hold of, a line each

  private:
    struct Held { // one boundary on one side
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
        std::vector<int> sides;
        std::vector<double> control;
        std::vector<Held> held;     // one a side; empty without `constrain`
        std::vector<Loaded> loaded; // one a side; empty without `load`
        Location where;
        std::vector<std::string> names; // of the sides
        const gault_boundary_api& api() const { return instance.api<gault_boundary_api>(); }
    };
    void hold(Condition& condition, const Motion& motion);
    void prepare_load(Condition& condition,
                      const std::function<SoilBehind(const std::array<double, 2>&)>& behind);
    void impose(const Condition& condition, int side, const Held& held, FixedField& fixed,
                VectorField& value) const;
    [[noreturn]] void refuse(const Condition& condition, gault_status status, const gault_error& error) const;

    std::vector<Surface> surfaces_;
    Loads load_on_{};
    std::vector<Condition> conditions_;
};

} // namespace gault::core
