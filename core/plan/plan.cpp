#include "core/plan/plan.hpp"
#include "core/base/memory.hpp"
#include "core/plan/pilot.hpp"
#include "core/plan/step_length.hpp"
#include "core/scheduler/poisson_ratio.hpp"
#include "core/scheduler/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace gault::core {
namespace {

constexpr double room = 1.25;           // radius of the domain over that of the soil that yields
constexpr double least_radii = 10.0;    // of the domain, in radii of the cavity
constexpr double incompressible = 0.45; // Poisson's ratio beyond which cells lock
constexpr double sizing_seconds = 20.0, stepping_seconds = 3.0; // patience with a pilot
constexpr int more_cells = 200;                                 // that edges of regions may cost

uint32_t flags_of(const BoundaryUse& use) {
    return static_cast<const gault_boundary_api*>(use.model.component->declaration->api)->flags;
}

bool left_open(const Scene& scene, const std::string& key) {
    return std::any_of(scene.chosen.begin(), scene.chosen.end(),
                       [&](const Choice& choice) { return choice.key == key; });
}

// Why a surface moves along the axis, or differently at different heights; empty: it does not.
std::string uneven(const Scene& scene, int side) {
    const bool end = side >= low_y;
    bool held = false;
    for (const BoundaryUse& use : scene.boundaries)
        for (const int surface : use.surfaces) {
            if (scene.surfaces[static_cast<std::size_t>(surface)].side != side) continue;
            const uint32_t wanted = end ? GAULT_BOUNDARY_HOLDS_NORMAL : GAULT_BOUNDARY_UNIFORM;
            if (!(flags_of(use) & wanted))
                return fmt::format("{} on '{}' may {}", use.model.component->declaration->name,
                                   scene.surfaces[static_cast<std::size_t>(surface)].name,
                                   end ? "do more than hold it along the axis" : "vary along the height");
            held = true;
        }
    if (end && !held)
        return fmt::format("'{}' may move along the axis",
                           scene.surfaces[static_cast<std::size_t>(side)].name);
    return "";
}

class Chooser {
  public:
    Chooser(const Scene& scene, const Reread& reread) : scene_(scene), reread_(reread) {}

    std::vector<Choice> all() {
        symmetry();
        frame();
        outer_radius();
        solver();
        volumetric_strain();
        basis();
        points();
        grading();
        cells();
        strain_step();
        return std::move(choices_);
    }

  private:
    void choose(const std::string& key, const std::string& value, const std::string& reason) {
        choices_.push_back({key, value, reason});
    }
    bool open(const char* key) const { return left_open(scene_, key); }

    void symmetry() {
        if (!open("model.symmetry")) return check_radial();
        if (scene_.geometry.kind == "block")
            return choose("model.symmetry", "plane_strain", "the geometry is a block");
        std::string obstacle = not_radial(scene_);
        if (obstacle.empty()) obstacle = two_directions();
        symmetry_ = obstacle.empty() ? Symmetry::radial : Symmetry::axisymmetric;
        if (obstacle.empty())
            choose("model.symmetry", "radial", "nothing varies along the axis, and nothing moves along it");
        else
            choose("model.symmetry", "axisymmetric", "the least that shows it: " + obstacle);
    }

    // What is set by hand and belongs to two directions; empty: nothing.
    std::string two_directions() const {
        if (!open("points.per_cell") && scene_.points_per_cell > 6)
            return fmt::format("points.per_cell {} is for two directions", scene_.points_per_cell);
        if (!open("grid.cells") && scene_.axes[1].cells > 1)
            return fmt::format("grid.cells has {} rows", scene_.axes[1].cells);
        return "";
    }

    // In radial symmetry nothing moves along the axis: what acts on its ends may only say so.
    void check_radial() const {
        if (scene_.symmetry != Symmetry::radial) return;
        for (const BoundaryUse& use : scene_.boundaries)
            for (const int surface : use.surfaces)
                if (surface >= low_y && !(flags_of(use) & GAULT_BOUNDARY_HOLDS_NORMAL))
                    throw InputError(
                        use.model.parameters.where,
                        fmt::format("model.symmetry is radial, where nothing moves along the axis: "
                                    "{} cannot act on '{}'; take axisymmetric",
                                    use.model.component->declaration->name,
                                    scene_.surfaces[static_cast<std::size_t>(surface)].name));
        if (scene_.gravity[1] != 0.0)
            throw InputError(scene_.geometry.where,
                             "model.symmetry is radial, which cannot show gravity along "
                             "the axis; take axisymmetric");
    }

    void frame() {
        if (open("model.frame"))
            choose("model.frame", "total",
                   "material stays in place: weights once, the wall always on the grid, any strain");
    }

    // Soil without bound is what an open outer radius says.
    void refuse_other_than_elastic() const {
        for (const BoundaryUse& use : scene_.boundaries)
            for (const int surface : use.surfaces)
                if (scene_.surfaces[static_cast<std::size_t>(surface)].side == high_x &&
                    !(flags_of(use) & GAULT_BOUNDARY_ELASTIC_BEHIND))
                    throw InputError(
                        use.model.parameters.where,
                        fmt::format("the outer radius is auto, so the soil goes on beyond it: {} cannot "
                                    "act on 'outer'; leave it out, or write a radius",
                                    use.model.component->declaration->name));
    }

    // As far as the soil yields in a wide domain, and some more: beyond, an elastic boundary is exact.
    void outer_radius() {
        if (!open("geometry.annulus.outer_radius")) return;
        const double inner = scene_.geometry.lower[0];
        refuse_other_than_elastic();
        const Pilot pilot = run_pilot(scene_, reread_, sizing_seconds);
        if (pilot.wrong) std::rethrow_exception(pilot.wrong);
        if (!pilot.trouble.empty())
            throw RunError(
                fmt::format("the outer radius cannot be chosen: {}. If the program is right, write a "
                            "radius, and a boundary on outer that stands for the soil beyond",
                            pilot.trouble));
        const std::string metres =
            fmt::format("{:.4g}", std::max(room * pilot.inelastic_radius, least_radii * inner));
        outer_ = std::stod(metres);
        choose("geometry.annulus.outer_radius", metres + " m",
               pilot.inelastic_radius > 0.0
                   ? fmt::format("the soil is elastic beyond {:.3g} m, as a pilot run shows",
                                 pilot.inelastic_radius)
                   : "the soil stays elastic, as a pilot run shows");
        for (std::size_t i = 0; i < scene_.boundaries.size(); ++i)
            if (scene_.boundaries[i].chosen)
                choose(fmt::format("boundaries.{}", i),
                       fmt::format("{{on: outer, type: {}}}",
                                   scene_.boundaries[i].model.component->declaration->name),
                       "it stands for the soil beyond");
    }

    void solver() {
        if (!open("model.solver")) return;
        if (!scene_.solver.dynamic_key.empty()) {
            solver_ = SolverKind::explicit_dynamics;
            return choose("model.solver", "explicit", scene_.solver.dynamic_key + " is set");
        }
        solver_ = SolverKind::quasi_static;
        choose("model.solver", "quasi_static", "the load is taken as slow: no inertia, long steps");
    }

    void volumetric_strain() {
        const char* key = "model.volumetric_strain";
        if (!open(key)) return;
        if (solver_ == SolverKind::explicit_dynamics)
            return choose(key, "pointwise", "the explicit solver has no other");
        if (symmetry_ == Symmetry::radial)
            return choose(key, "pointwise", "in radial symmetry one point a cell does not lock");
        if (frame_ == Frame::updated)
            return choose(key, "pointwise", "the points of a cell change as they move");
        const double nu = largest_poisson_ratio(scene_);
        if (nu > incompressible)
            choose(key, "cell_mean", fmt::format("with Poisson's ratio {:.4g} cells would lock", nu));
        else
            choose(key, "pointwise", "the soil is compressible: the strain of every point is its own");
    }

    bool radial_without_inertia() const {
        return symmetry_ == Symmetry::radial && solver_ == SolverKind::quasi_static;
    }

    void basis() {
        if (!open("grid.basis")) return;
        const bool one = open("points.per_cell") || scene_.points_per_cell == 1;
        const bool stays =
            frame_ == Frame::total; // in place: forces of linear cells jump where points cross them
        basis_ = radial_without_inertia() && one && stays ? Basis::linear : Basis::quadratic;
        if (basis_ == Basis::linear)
            choose("grid.basis", "linear", "with one point a cell: stresses of second order, no locking");
        else
            choose("grid.basis", "quadratic", "smooth strains, and stresses that converge with them");
    }

    void points() {
        if (!open("points.per_cell")) return;
        if (basis_ == Basis::linear && radial_without_inertia())
            choose("points.per_cell", "1", "where the strains of a linear cell are exact to second order");
        else if (symmetry_ == Symmetry::radial)
            choose("points.per_cell", "2", "Gauss points: where the stress is most accurate");
        else
            choose("points.per_cell", "4", "2 x 2 Gauss points: where the stress is most accurate");
    }

    void grading() {
        for (const char* axis : {"r", "x", "y"}) {
            const std::string key = std::string("grid.grading.") + axis;
            if (!left_open(scene_, key)) continue;
            const bool ring = *axis == 'r' && scene_.geometry.kind == "annulus";
            choose(key, ring ? "geometric" : "1",
                   ring ? "strains concentrate at the inner radius" : "equal cells");
        }
    }

    // The error of strains that fall as 1/r^2 is that of the square of ln(r2/r1) of a cell.
    void cells() {
        if (!open("grid.cells")) return;
        const double size = std::sqrt(scene_.accuracy);
        const auto& [low, high] = std::pair(scene_.geometry.lower, scene_.geometry.upper);
        const bool annulus = scene_.geometry.kind == "annulus";
        const double outer = outer_ > 0.0 ? outer_ : high[0];
        const double length = std::max(outer - low[0], high[1] - low[1]);
        const auto count = [](double n) { return std::clamp(static_cast<int>(std::ceil(n)), 1, 2000); };
        const int least =
            count(annulus ? std::log(outer / low[0]) / size : (outer - low[0]) / (size * length));
        const bool even = not_radial(scene_).empty();
        const int along =
            symmetry_ == Symmetry::radial || (annulus && even)
                ? 1
                : std::min(400, count((high[1] - low[1]) / (annulus ? 4.0 * size * low[0] : size * length)));
        const bool row = along == 1 && left_open(scene_, scene_.geometry.kind == "block" ? "grid.grading.x"
                                                                                         : "grid.grading.r");
        const int across = row ? fitting(least, low[0], outer, annulus) : least;
        choose(
            "grid.cells", fmt::format("[{}, {}]", across, along),
            fmt::format("{} for an accuracy of {:g} %{}",
                        annulus ? "each cell wider by the same share" : "the largest extent in equal cells",
                        100.0 * scene_.accuracy,
                        across > least ? fmt::format(", and {} more for the edges of regions", across - least)
                                       : ""));
    }

    // By how much of their region's extent edges of regions lie beside the knots of so many cells.
    double misfit(int cells, double low, double high, bool geometric) const {
        double worst = 0.0;
        for (const Region& region : scene_.regions) {
            const auto& [from, to] = region.extent[0];
            for (const double edge : {from, to}) {
                if (edge <= low || edge >= high) continue;
                const double place = cells * (geometric ? std::log(edge / low) / std::log(high / low)
                                                        : (edge - low) / (high - low));
                const double share = std::round(place) / cells;
                const double knot =
                    geometric ? low * std::pow(high / low, share) : low + share * (high - low);
                worst = std::max(worst, std::abs(knot - edge) / (std::min(to, high) - std::max(from, low)));
            }
        }
        return worst;
    }

    // So many cells, or the few more with which edges of regions are knots, to the accuracy, or five times as near.
    int fitting(int cells, double low, double high, bool geometric) const {
        int best = cells;
        const double before = misfit(cells, low, high, geometric);
        double least = before;
        for (int n = cells + 1; least > scene_.accuracy && n <= cells + more_cells; ++n)
            if (const double here = misfit(n, low, high, geometric); here < least) best = n, least = here;
        return least <= std::max(scene_.accuracy, 0.2 * before) ? best : cells;
    }

    void strain_step() {
        if (!open("solver.strain_step") || solver_ != SolverKind::quasi_static) return;
        const StepLength length = longest_step(scene_, reread_, stepping_seconds);
        choose("solver.strain_step", fmt::format("{:.3g}", length.strain_step), length.reason);
    }

    const Scene& scene_;
    const Reread& reread_;
    std::vector<Choice> choices_;
    Symmetry symmetry_ = scene_.symmetry;
    Frame frame_ = scene_.frame;
    SolverKind solver_ = scene_.solver.kind;
    Basis basis_ = scene_.basis;
    double outer_ = 0.0; // m; 0: not chosen
};

struct Trial {            // the first steps of the scene itself
    double step = 0.0;    // s, of the scene's time
    double seconds = 0.0; // of the machine's: a step, or an iteration where a step iterates
    double started = 0.0; // seconds to build the model
};

Trial first_steps(const Scene& scene, int threads) {
    using Clock = std::chrono::steady_clock;
    const auto since = [](Clock::time_point from) {
        return std::chrono::duration<double>(Clock::now() - from).count();
    };
    const auto start = Clock::now();
    Simulation simulation(scene, threads);
    simulation.start();
    Solver& solver = simulation.solver();
    Trial trial;
    trial.step = solver.allowed_step();
    trial.started = since(start);
    const auto stepping = Clock::now();
    int tries = 0;
    while (tries < 50 && !simulation.done() && since(stepping) < 0.1) {
        simulation.step();
        ++tries;
    }
    trial.seconds =
        since(stepping) /
        static_cast<double>(std::max<int64_t>(1, solver.repeatable() ? solver.iterations() : solver.steps()));
    return trial;
}

} // namespace

std::string not_radial(const Scene& scene) {
    if (scene.geometry.kind == "block") return "a block has no axis";
    if (scene.surfaces.size() > 4)
        return fmt::format("the part '{}' ends along the height", scene.surfaces[4].name);
    if (scene.gravity[1] != 0.0) return "gravity acts along the axis";
    if (scene.program_gauge) return "the program's gauge is at a height";
    for (const Region& region : scene.regions)
        if (region.cells.first[1] > 0 || region.cells.last[1] < scene.axes[1].cells)
            return fmt::format("the region '{}' ends along the height", region.name);
    for (int side = 0; side < 4; ++side)
        if (const std::string reason = uneven(scene, side); !reason.empty()) return reason;
    return "";
}

std::vector<Choice> choose_least(const Scene& scene, const Reread& reread) {
    return Chooser(scene, reread).all();
}

std::vector<Override> overrides_of(const std::vector<Choice>& choices) {
    std::vector<Override> overrides;
    for (const Choice& choice : choices)
        overrides.push_back({choice.key, choice.value});
    return overrides;
}

Estimate estimate_cost(const Scene& scene, const Reread& reread, int threads, double patience) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Estimate estimate;
    estimate.points = scene.points();
    const Pilot pilot = run_pilot(scene, reread, patience);
    try {
        const Trial trial = first_steps(scene, threads);
        const double n = static_cast<double>(estimate.points);
        if (scene.solver.kind == SolverKind::quasi_static) {
            estimate.steps = static_cast<double>(pilot.steps);
            estimate.updates = static_cast<double>(pilot.updates) * n / static_cast<double>(pilot.points);
            estimate.seconds = trial.started + static_cast<double>(pilot.iterations) * trial.seconds;
        } else {
            estimate.steps = pilot.end / trial.step;
            estimate.updates = estimate.steps * n;
            estimate.seconds = trial.started + estimate.steps * trial.seconds;
        }
        estimate.unknown = pilot.trouble;
    } catch (const RunError& error) { // the run will say so itself
        estimate.unknown = fmt::format("its first steps failed ({})", error.what());
    }
    if (!estimate.unknown.empty()) estimate.steps = estimate.updates = estimate.seconds = nan;
    estimate.bytes = peak_resident_bytes();
    return estimate;
}

nlohmann::json to_json(const std::vector<Choice>& choices, const Estimate& estimate) {
    nlohmann::json j;
    j["choices"] = nlohmann::json::array();
    for (const Choice& choice : choices)
        j["choices"].push_back({{"key", choice.key}, {"value", choice.value}, {"reason", choice.reason}});
    j["estimate"] = {{"points", estimate.points},
                     {"steps", estimate.steps},
                     {"constitutive_updates", estimate.updates},
                     {"seconds", estimate.seconds},
                     {"peak_bytes", estimate.bytes}};
    if (!estimate.unknown.empty()) j["estimate"]["unknown"] = estimate.unknown;
    return j;
}

} // namespace gault::core
