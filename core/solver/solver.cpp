#include "core/solver/solver.hpp"
#include "core/solver/explicit.hpp"
#include "core/solver/quasi_static.hpp"

#include <algorithm>
#include <cmath>

namespace gault::core {
namespace {

std::unique_ptr<Motion> make_motion(const Scene& scene, Model& model, int threads) {
    if (scene.frame == Frame::total)
        return make_total_motion(model.grid, model.materials, model.points, threads);
    return make_updated_motion(model.grid, model.materials, model.points, threads,
                               scene.solver.stress_update == StressUpdate::usf);
}

} // namespace

double Energies::ratio() const {
    return straining == 0.0 ? 0.0 : kinetic / std::abs(straining);
}

double Energies::error() const {
    const double largest =
        std::max({std::abs(kinetic), std::abs(internal), std::abs(external), std::abs(damping)});
    return largest == 0.0 ? 0.0 : std::abs(kinetic + internal - external - damping) / largest;
}

Solver::Solver(const Scene& scene, Model& model, int threads)
    : settings_(scene.solver), gravity_(scene.gravity), model_(model),
      motion_(make_motion(scene, model, threads)), boundaries_(scene, *motion_, model.behind(scene)),
      internal_(model.grid.layout()), traction_(internal_), velocity_(internal_), value_(internal_),
      fixed_(model.grid.layout()) {
    motion_->forces(internal_);
    // Conditions that contradict each other are refused here.
    boundaries_.constrain(*motion_, time_, 0.0, fixed_, value_);
}

void Solver::load(double dt) {
    boundaries_.load(*motion_, time_, dt, velocity_, traction_);
    loaded_ = true;
}

void Solver::load_first() {
    if (loaded_) return;
    boundaries_.constrain(*motion_, time_, 0.0, fixed_, value_);
    load(0.0);
}

void Solver::impose_velocity() { // nodes that are not on a surface are free
    for (int side = 0; side < 4; ++side)
        for (const std::size_t n : boundaries_.surface(side).nodes())
            for (int k = 0; k < 2; ++k)
                if (fixed_.c[k][n] != 0.0) velocity_.c[k][n] = value_.c[k][n];
}

double Solver::largest_velocity() const {
    double largest = 0.0;
    for (std::size_t n = 0; n < velocity_.c[0].size(); ++n)
        largest = std::max(largest, std::hypot(velocity_.c[0][n], velocity_.c[1][n]));
    return largest;
}

const std::vector<std::string>& Solver::measure_names() {
    static const std::vector<std::string> names = {
        "radius",          "initial_radius",       "area",
        "initial_area",    "normal_force",         "displacement",
        "enclosed_volume", "excess_pore_pressure", "kinetic_energy",
        "internal_energy", "external_work",        "damping_work",
        "energy_error",    "kinetic_ratio",        "largest_velocity"};
    return names;
}

bool Solver::measures_surface(const std::string& name) {
    const auto& names = measure_names();
    return std::find(names.begin(), names.end(), name) < names.begin() + 8;
}

// The loads on the surface, and its share of what holds its nodes.
double Solver::normal_force(int index) {
    load_first();
    const Surface& surface = boundaries_.surface(index);
    const int k = normal_axis(surface.side());
    double total = boundaries_.load_on(index)[k];
    for (std::size_t i = 0; i < surface.nodes().size(); ++i) {
        const std::size_t n = surface.nodes()[i];
        if (const double share = boundaries_.share(index, i, fixed_); share > 0.0)
            total += share * (inertia(k, n) - weight(k, n) - internal_.c[k][n] - traction_.c[k][n]);
    }
    return -outward(surface.side()) * total;
}

// The mean over the points that began in the cells along it, by volume.
double Solver::excess_pore_pressure(const Surface& surface) const {
    const int across = normal_axis(surface.side()), along = 1 - across;
    const auto& grid = model_.grid;
    const int beside = surface.side() % 2 ? grid.axis(across).cells() - 1 : 0;
    double volume = 0.0, total = 0.0;
    for (int m = 0; m < static_cast<int>(model_.materials.size()); ++m) {
        if (!model_.materials[m].water()) continue;
        const Points& points = motion_->points()[m];
        const Column& excess = points.columns().state.back();
        points.each_point([&](std::size_t slot) {
            const PointRecord at = motion_->record(m, slot);
            if (grid.axis(across).cell_of(at.reference[across]) != beside ||
                !surface.has_cell(grid.axis(along).cell_of(at.reference[along])))
                return;
            volume += at.volume;
            total += at.volume * excess[slot];
        });
    }
    return volume > 0.0 ? total / volume : 0.0;
}

std::optional<double> Solver::measure(const std::string& name, int index, Surface* gauge) {
    if (name == "kinetic_energy") return energies().kinetic;
    if (name == "internal_energy") return energies().internal;
    if (name == "external_work") return energies().external;
    if (name == "damping_work") return energies().damping;
    if (name == "energy_error") return energies().error();
    if (name == "kinetic_ratio") return energies().ratio();
    if (name == "largest_velocity") return largest_velocity();
    Surface& surface = boundaries_.surface(index);
    Surface& place = gauge ? *gauge : surface;
    if (name == "initial_radius") return place.initial_radius();
    if (name == "initial_area") return surface.initial_area();
    if (name == "normal_force") return normal_force(index);
    if (name == "excess_pore_pressure") return excess_pore_pressure(surface);
    surface.refresh(*motion_);
    place.refresh(*motion_);
    if (name == "radius") return place.mean_radius();
    if (name == "area") return surface.projected_area();
    if (name == "displacement") return place.mean_displacement();
    if (name == "enclosed_volume") return surface.enclosed_volume();
    return std::nullopt;
}

std::unique_ptr<Solver> make_solver(const Scene& scene, Model& model, int threads) {
    if (scene.solver.kind == SolverKind::quasi_static)
        return std::make_unique<QuasiStaticSolver>(scene, model, threads);
    return std::make_unique<ExplicitSolver>(scene, model, threads);
}

} // namespace gault::core
