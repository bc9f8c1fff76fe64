#include "core/solver/explicit.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

constexpr double strain_between_limits = 0.02, stiffer = 1.05;
constexpr int64_t steps_between_questions = 8; // soils may take long to find their moduli

double largest(const Column& column) {
    return column.empty() ? 0.0 : *std::max_element(column.begin(), column.end());
}

} // namespace

ExplicitSolver::ExplicitSolver(const Scene& scene, Model& model, int threads)
    : Solver(scene, model, threads), internal_initial_(internal_), internal_before_(internal_),
      traction_before_(traction_), acceleration_(model.grid.layout()), velocity_before_(acceleration_),
      damping_(acceleration_), work_of_row_(static_cast<std::size_t>(model.grid.layout().ny)) {}

double ExplicitSolver::allowed_step() {
    if (limit_is_stale()) refresh_limit(moduli());
    return settings_.time_step_factor * limit_;
}

ExplicitSolver::Moduli ExplicitSolver::moduli() {
    Moduli all(model_.materials.size());
    for (std::size_t m = 0; m < all.size(); ++m)
        if (model_.points[m].count() > 0)
            evaluate_moduli(model_.materials[m], model_.points[m], view_of(model_.grid),
                            motion_->deformation(static_cast<int>(m)), time_, all[m][0], all[m][1]);
    return all;
}

bool ExplicitSolver::limit_is_stale() {
    if (limit_ == 0.0 || strained_ > strain_between_limits || fixed_.count() != fixed_count_) return true;
    for (std::size_t m = 0; m < stiffest_.size(); ++m)
        if (motion_->largest_modulus(static_cast<int>(m)) > stiffer * stiffest_[m]) return true;
    return false;
}

// A viscous stress acts with half a step's delay: the limit falls as if the stiffness were larger by 2 zeta.
// Local damping adds up to its share to the forces that resist: it falls by sqrt(1 + alpha).
void ExplicitSolver::refresh_limit(Moduli moduli) {
    std::vector<std::array<double, 2>> viscosity(moduli.size());
    stiffest_.resize(moduli.size());
    for (std::size_t m = 0; m < moduli.size(); ++m) {
        const double stiffest = largest(moduli[m][0]), shear = largest(moduli[m][1]);
        stiffest_[m] = std::max(stiffest, motion_->largest_modulus(static_cast<int>(m)));
        viscosity[m] = {settings_.viscosity * (stiffest - 2.0 * shear), settings_.viscosity * shear};
        for (double& modulus : moduli[m][0])
            modulus += 2.0 * settings_.viscosity * stiffest;
        for (double& modulus : moduli[m][1])
            modulus += 2.0 * settings_.viscosity * shear;
    }
    boundaries_.constrain(*motion_, time_, 0.0, fixed_, value_);
    fixed_count_ = fixed_.count();
    limit_ = stable_step(*motion_, moduli, fixed_, settings_.mass_scaling / (1.0 + settings_.damping));
    // A dashpot acts on the velocity half a step ago: stable where (2 / limit)^2 dt^2 + 2 rate dt <= 4.
    const double slow = 0.25 * limit_ * boundaries_.dashpot_rate(*motion_) / settings_.mass_scaling;
    limit_ *= std::sqrt(1.0 + slow * slow) - slow;
    motion_->set_viscosity(std::move(viscosity));
    strained_ = 0.0;
}

void ExplicitSolver::integrate(double dt, const VectorField& internal) {
    const double alpha = settings_.damping, scaling = settings_.mass_scaling;
    motion_->each_row([&](int, std::size_t begin, std::size_t end) {
        const double* mass = motion_->mass().data();
        for (int k = 0; k < 2; ++k) {
            const double *inner = internal.c[k].data(), *outer = traction_.c[k].data(),
                         *before = velocity_before_.c[k].data(), *value = value_.c[k].data(),
                         *fixed = fixed_.c[k].data(), gravity = gravity_[k];
            double *acceleration = acceleration_.c[k].data(), *damping = damping_.c[k].data();
            for (std::size_t n = begin; n < end; ++n) {
                const double m = mass[n], v = before[n], force = inner[n] + outer[n] + m * gravity;
                // Cundall's local damping opposes the velocity by a share of the force
                const double against = v == 0.0 ? 0.0 : -std::copysign(alpha * std::abs(force), v);
                const bool free = fixed[n] == 0.0, empty = m <= 0.0;
                const double taken = free ? (force + against) / (m * scaling) : (value[n] - v) / dt;
                damping[n] = free && !empty ? against : 0.0;
                acceleration[n] = empty ? 0.0 : taken;
            }
        }
    });
}

// Work of the step by the trapezoidal rule (Belytschko, Liu, Moran 2000, Section 6.2.3).
void ExplicitSolver::account(double dt) {
    const VectorField& straining = motion_->stress_first() ? velocity_before_ : velocity_;
    motion_->each_row([&](int j, std::size_t begin, std::size_t end) {
        RowWork row;
        const double* mass = motion_->mass().data();
        for (int k = 0; k < 2; ++k) {
            const double *now = velocity_.c[k].data(), *before = velocity_before_.c[k].data(),
                         *strained = straining.c[k].data(), *initial = internal_initial_.c[k].data(),
                         *inner_now = internal_.c[k].data(), *inner_before = internal_before_.c[k].data(),
                         *outer_now = traction_.c[k].data(), *outer_before = traction_before_.c[k].data(),
                         *damping = damping_.c[k].data(), *acceleration = acceleration_.c[k].data(),
                         *fixed = fixed_.c[k].data();
            const double gravity = gravity_[k], scaling = settings_.mass_scaling;
            for (std::size_t n = begin; n < end; ++n) {
                const double weight = mass[n] * gravity, inertia = mass[n] * scaling * acceleration[n];
                const double v = now[n], way = dt * v, mean_way = 0.5 * dt * (v + before[n]);
                const double inner = 0.5 * (inner_before[n] + inner_now[n]);
                const double outer = 0.5 * (outer_before[n] + outer_now[n]) + weight;
                const bool free = fixed[n] == 0.0; // what holds a node does the rest
                row.external += free ? outer * way : inertia * mean_way - inner * way;
                row.power += free ? (inner_now[n] + outer_now[n] + weight) * v : 0.0;
                row.internal -= inner * dt * strained[n];
                row.straining -= (inner - initial[n]) * dt * strained[n];
                row.damping += damping[n] * mean_way;
            }
        }
        work_of_row_[static_cast<std::size_t>(j)] = row;
    });
    to_full_step_ = 0.0;
    for (const RowWork& row : work_of_row_) {
        energies_.internal += row.internal;
        energies_.straining += row.straining;
        energies_.external += row.external;
        energies_.damping += row.damping;
        to_full_step_ += 0.5 * dt * row.power;
    }
}

bool ExplicitSolver::step(double dt) {
    load_first();
    motion_->ask_for_moduli(steps_ % steps_between_questions == 0);
    boundaries_.constrain(*motion_, time_ + dt, dt, fixed_, value_);
    if (fixed_.held() != held_) { // what is released now was not loaded when the last step ended
        held_ = fixed_.held();
        load(dt_before_);
    }
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
    time_ += dt;
    std::swap(traction_, traction_before_);
    load(dt);
    account(dt);
    dt_before_ = dt;
    strained_ += motion_->largest_strain();
    ++steps_;
    return true;
}

Energies ExplicitSolver::energies() const {
    Energies e = energies_;
    e.kinetic = std::max(0.0, settings_.mass_scaling * motion_->kinetic_energy() + to_full_step_);
    return e;
}

} // namespace gault::core
