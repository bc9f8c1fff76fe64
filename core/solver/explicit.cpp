#include "core/solver/explicit.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

constexpr double strain_between_limits = 0.02;

std::unique_ptr<Motion> make_motion(const Scene& scene, Model& model, int threads) {
    if (scene.frame == Frame::total)
        return make_total_motion(model.grid, model.materials, model.points, threads);
    return make_updated_motion(model.grid, model.materials, model.points, threads,
                               scene.solver.stress_update == StressUpdate::usf);
}

} // namespace

double Energies::ratio() const {
    return internal == 0.0 ? 0.0 : kinetic / std::abs(internal);
}

double Energies::error() const {
    const double largest =
        std::max({std::abs(kinetic), std::abs(internal), std::abs(external), std::abs(damping)});
    return largest == 0.0 ? 0.0 : std::abs(kinetic + internal - external - damping) / largest;
}

ExplicitSolver::ExplicitSolver(const Scene& scene, Model& model, int threads)
    : settings_(scene.solver), gravity_(scene.gravity), model_(model),
      motion_(make_motion(scene, model, threads)), boundaries_(scene, *motion_, model.behind(scene)),
      internal_(model.grid.layout()), internal_before_(internal_), traction_(internal_),
      acceleration_(internal_), velocity_(internal_), velocity_before_(internal_), damping_(internal_),
      reaction_(internal_), value_(internal_), fixed_(internal_),
      energies_of_row_(static_cast<std::size_t>(model.grid.layout().ny)) {
    for (int side = 0; side < 4; ++side) {
        initial_area_[side] = boundaries_.surface(side).total_area();
        initial_radius_[side] = boundaries_.surface(side).mean_radius();
    }
    motion_->forces(internal_);
    boundaries_.constrain(*motion_, time_, 0.0, fixed_,
                          value_); // conditions that contradict each other are refused here
}

double ExplicitSolver::allowed_step() {
    if (limit_ == 0.0 || strained_ > strain_between_limits) refresh_limit();
    return settings_.time_step_factor * limit_;
}

void ExplicitSolver::refresh_limit() {
    std::vector<std::array<Column, 2>> moduli(model_.materials.size());
    std::vector<std::array<double, 2>> viscosity(model_.materials.size());
    for (std::size_t m = 0; m < moduli.size(); ++m) {
        if (model_.points[m].count() == 0) continue;
        evaluate_moduli(model_.materials[m], model_.points[m], view_of(model_.grid), moduli[m][0],
                        moduli[m][1]);
        const double p_wave = *std::max_element(moduli[m][0].begin(), moduli[m][0].end());
        const double shear = *std::max_element(moduli[m][1].begin(), moduli[m][1].end());
        viscosity[m] = {settings_.viscosity * (p_wave - 2.0 * shear), settings_.viscosity * shear};
    }
    boundaries_.constrain(*motion_, time_, 0.0, fixed_, value_);
    // Local damping adds up to its share to the forces that resist, a viscous stress acts with half a step's
    // delay: the limit falls by sqrt(1 + alpha) and sqrt(1 + 2 zeta).
    const double slower = (1.0 + settings_.damping) * (1.0 + 2.0 * settings_.viscosity);
    limit_ = stable_step(*motion_, moduli, fixed_, settings_.mass_scaling / slower);
    motion_->set_viscosity(std::move(viscosity));
    strained_ = 0.0;
}

void ExplicitSolver::impose_velocity() { // nodes that are not on a surface are free
    for (int side = 0; side < 4; ++side)
        for (const std::size_t n : boundaries_.surface(side).nodes())
            for (int k = 0; k < 2; ++k)
                if (fixed_.c[k][n] != 0.0) velocity_.c[k][n] = value_.c[k][n];
}

void ExplicitSolver::integrate(double dt, const VectorField& internal) {
    const Column& mass = motion_->mass();
    const double alpha = settings_.damping;
    motion_->each_row([&](int, std::size_t begin, std::size_t end) {
        for (int k = 0; k < 2; ++k)
            for (std::size_t n = begin; n < end; ++n) {
                if (mass[n] <= 0.0) continue;
                const double inertia = mass[n] * settings_.mass_scaling;
                const double force = internal.c[k][n] + traction_.c[k][n] + mass[n] * gravity_[k];
                const double v = velocity_before_.c[k][n];
                if (fixed_.c[k][n] != 0.0) {
                    acceleration_.c[k][n] = (value_.c[k][n] - v) / dt;
                    reaction_.c[k][n] = inertia * acceleration_.c[k][n] - force;
                    damping_.c[k][n] = 0.0;
                } else { // Cundall's local damping opposes the velocity by a share of the force
                    reaction_.c[k][n] = 0.0;
                    damping_.c[k][n] = v > 0.0   ? -alpha * std::abs(force)
                                       : v < 0.0 ? alpha * std::abs(force)
                                                 : 0.0;
                    acceleration_.c[k][n] = (force + damping_.c[k][n]) / inertia;
                }
            }
    });
}

void ExplicitSolver::account(double dt) {
    const Column& mass = motion_->mass();
    const VectorField& straining = motion_->stress_first() ? velocity_before_ : velocity_;
    motion_->each_row([&](int j, std::size_t begin, std::size_t end) {
        Energies row;
        for (int k = 0; k < 2; ++k)
            for (std::size_t n = begin; n < end; ++n) {
                const double mean = 0.5 * (velocity_.c[k][n] + velocity_before_.c[k][n]);
                row.internal -= 0.5 * dt * (internal_before_.c[k][n] + internal_.c[k][n]) * straining.c[k][n];
                row.external += dt * ((traction_.c[k][n] + mass[n] * gravity_[k] + reaction_.c[k][n]) * mean);
                row.damping += dt * damping_.c[k][n] * mean;
            }
        energies_of_row_[static_cast<std::size_t>(j)] = row;
    });
    for (const Energies& row : energies_of_row_) {
        energies_.internal += row.internal;
        energies_.external += row.external;
        energies_.damping += row.damping;
    }
}

void ExplicitSolver::step(double dt) {
    boundaries_.load(*motion_, time_, dt, velocity_, traction_);
    boundaries_.constrain(*motion_, time_ + dt, dt, fixed_, value_);
    std::swap(internal_, internal_before_);
    const Moment moment{time_ + dt, dt};
    std::swap(velocity_, velocity_before_);
    if (motion_->stress_first()) {
        motion_->map_velocity(velocity_);
        impose_velocity();
        motion_->deform(velocity_, moment);
        motion_->forces(internal_);
        integrate(dt, internal_);
        std::swap(velocity_, velocity_before_);
        motion_->each_row([&](int, std::size_t begin, std::size_t end) {
            for (int k = 0; k < 2; ++k)
                for (std::size_t n = begin; n < end; ++n)
                    velocity_.c[k][n] = velocity_before_.c[k][n] + dt * acceleration_.c[k][n];
        });
        impose_velocity();
        motion_->advance(acceleration_, velocity_, dt);
    } else {
        integrate(dt, internal_before_);
        motion_->accelerate(acceleration_, dt, velocity_);
        impose_velocity();
        motion_->deform(velocity_, moment);
        motion_->forces(internal_);
    }
    account(dt);
    strained_ += motion_->largest_strain();
    time_ += dt;
    ++steps_;
}

Energies ExplicitSolver::energies() const {
    Energies e = energies_;
    e.kinetic = settings_.mass_scaling * motion_->kinetic_energy();
    return e;
}

double ExplicitSolver::largest_velocity() const {
    double largest = 0.0;
    for (std::size_t n = 0; n < velocity_.c[0].size(); ++n)
        largest = std::max(largest, std::hypot(velocity_.c[0][n], velocity_.c[1][n]));
    return largest;
}

const std::vector<std::string>& ExplicitSolver::measure_names() {
    static const std::vector<std::string> names = {
        "radius",       "initial_radius",  "area",           "initial_area",    "normal_force",
        "displacement", "enclosed_volume", "kinetic_energy", "internal_energy", "external_work",
        "damping_work", "energy_error",    "kinetic_ratio",  "largest_velocity"};
    return names;
}

bool ExplicitSolver::measures_surface(const std::string& name) {
    const auto& names = measure_names();
    return std::find(names.begin(), names.end(), name) < names.begin() + 7;
}

// What the boundaries push with: loads, and the reactions at the present stress.
double ExplicitSolver::normal_force(int side) const {
    const int k = normal_axis(side);
    const Column& mass = motion_->mass();
    double total = 0.0;
    for (const std::size_t n : boundaries_.surface(side).nodes()) {
        const double force = fixed_.c[k][n] == 0.0
                                 ? traction_.c[k][n]
                                 : mass[n] * (settings_.mass_scaling * acceleration_.c[k][n] - gravity_[k]) -
                                       internal_.c[k][n];
        total -= outward(side) * force;
    }
    return total;
}

std::optional<double> ExplicitSolver::measure(const std::string& name, int side) {
    if (name == "kinetic_energy") return energies().kinetic;
    if (name == "internal_energy") return energies_.internal;
    if (name == "external_work") return energies_.external;
    if (name == "damping_work") return energies_.damping;
    if (name == "energy_error") return energies().error();
    if (name == "kinetic_ratio") return energies().ratio();
    if (name == "largest_velocity") return largest_velocity();
    if (name == "initial_radius") return initial_radius_[side];
    if (name == "initial_area") return initial_area_[side];
    Surface& surface = boundaries_.surface(side);
    if (name == "normal_force") return normal_force(side);
    surface.refresh(*motion_);
    if (name == "radius") return surface.mean_radius();
    if (name == "area") return surface.total_area();
    if (name == "displacement") return surface.mean_displacement();
    if (name == "enclosed_volume") return surface.enclosed_volume();
    return std::nullopt;
}

} // namespace gault::core
