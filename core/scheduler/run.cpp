#include "core/scheduler/run.hpp"
#include "core/base/isa.hpp"
#include "core/base/log.hpp"
#include "core/base/memory.hpp"
#include "core/scheduler/elasticity.hpp"
#include "core/scheduler/progress.hpp"
#include "core/scheduler/simulation.hpp"
#include "core/scheduler/snapshot.hpp"
#include "core/scheduler/verification.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <optional>
#include <thread>

namespace gault::core {
namespace {

std::sig_atomic_t volatile interrupted = 0;

class Interrupts { // SIGINT and SIGTERM ask for an end while this lives
  public:
    Interrupts() {
        interrupted = 0;
        for (const int s : {SIGINT, SIGTERM})
            std::signal(s, [](int) { interrupted = 1; });
    }
    ~Interrupts() {
        for (const int s : {SIGINT, SIGTERM})
            std::signal(s, SIG_DFL);
    }
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// An observer's result is a number, a program's {value, unit, ...}.
std::string derived_text(const nlohmann::json& result) {
    if (result.is_number()) return fmt::format("{:.6g}", result.get<double>());
    const std::string unit = result["unit"], note = result["note"];
    return fmt::format("{:.6g}{}{}{}", result["value"].get<double>(), unit == "1" ? "" : " " + unit,
                       note.empty() ? "" : "; ", note);
}

// What a user should know that is no caution.
std::vector<std::string> notes(Simulation& simulation) {
    std::vector<std::string> all;
    for (const Material& material : simulation.model().materials)
        if (simulation.scene().solver.kind == SolverKind::quasi_static && !material.has_tangent())
            all.push_back(
                fmt::format("material {}: its plugin has no tangent, so it is differentiated numerically, "
                            "with four more updates a point",
                            material.name()));
    return all;
}

// A simulation, and what is written of it.
class Run {
  public:
    Run(const Scene& scene, const RunOptions& options)
        : scene_(scene), options_(options), threads_(threads_that_pay(scene.points(), options.threads)),
          simulation_(scene, threads_), verification_(scene, simulation_.columns()),
          writer_(options.folder, options.replace, simulation_.columns(), provenance(),
                  simulation_.points()) {}

    Outcome go();

  private:
    Provenance provenance() const;
    void step_on(Progress& progress);
    void finish();
    void frames_due(bool last);
    void write_frame();
    void summary(const char* status, const std::string& message);
    nlohmann::json plan();
    void fail(const std::string& message); // what was written stays, with the reason
    std::string advice();
    std::string kinetic_caution() const; // empty: none
    std::string yield_caution() const;   // empty: none
    std::string frame_caution(const std::string& status);
    bool elastic_behind() const;
    void watch_yield();
    void derive();
    void report();
    void report_reference() const;
    void report_derived() const;
    Solver& solver() { return simulation_.solver(); }

    const Scene& scene_;
    const RunOptions& options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    int threads_;
    Simulation simulation_;
    Verification verification_;
    ResultWriter writer_;
    std::optional<Elasticity> elasticity_; // where a boundary stands for elastic soil
    double yielding_ = 0.0;                // m; 0: the soil at that boundary is elastic
    int64_t frame_step_ = -1, frames_ = 0;
    double stepping_ = 0.0; // s
    nlohmann::json reference_, derived_;
};

Provenance Run::provenance() const {
    nlohmann::json plugins = nlohmann::json::array();
    const auto add = [&](const Component* c) {
        plugins.push_back({{"component", c->declaration->name},
                           {"kind", kind_name(c->declaration->kind)},
                           {"version", c->declaration->version},
                           {"file", c->file.string()},
                           {"sha256", sha256_of_file(c->file)}});
    };
    for (const MaterialUse& m : scene_.materials)
        add(m.model.component);
    for (const BoundaryUse& b : scene_.boundaries)
        add(b.model.component);
    add(scene_.program.component);
    for (const auto& o : scene_.observers)
        add(o.model.component);
    return {scene_.yaml,
            {{"program", "gault " + options_.program_version},
             {"command", options_.command_line},
             {"threads", threads_},
             {"instruction_set", isa_name(best_isa())},
             {"scene", std::filesystem::absolute(scene_.file).string()},
             {"scene_sha256", sha256_of_file(scene_.file)},
             {"plugins", plugins}}};
}

void Run::write_frame() {
    if (frame_step_ == solver().steps()) return;
    frame_step_ = solver().steps();
    std::vector<FrameAttribute> attributes{{"time", "s", solver().time()}};
    const Program& program = simulation_.program();
    for (std::size_t k = 0; k < program.columns().size(); ++k)
        attributes.push_back({program.columns()[k].name, program.columns()[k].unit, program.record()[k]});
    writer_.frame(attributes, frame_datasets(solver().motion()));
    ++frames_;
    summary("running", "");
}

void Run::frames_due(bool last) {
    for (const ProfileReference& profile : scene_.profiles)
        verification_.at(profile.measure, simulation_.measured(profile.measure), solver().motion());
    bool due = last;
    for (Crossing& frame : simulation_.frames())
        due |= frame.reached(simulation_.measured(scene_.frames.measure));
    if (due) write_frame();
}

std::string Run::advice() {
    if (scene_.solver.time_step_factor > 1.0)
        return fmt::format(
            "solver.time_step_factor is {:g}: above 1 the step exceeds the stability limit of {:.4g} s",
            scene_.solver.time_step_factor, solver().stability_limit());
    return fmt::format("try a smaller solver.time_step_factor (now {:g}) or a gentler load",
                       scene_.solver.time_step_factor);
}

void Run::fail(const std::string& message) {
    summary("failed", message);
    writer_.finish();
}

// What was chosen, what it was estimated to cost, and what came.
nlohmann::json Run::plan() {
    nlohmann::json all = options_.plan;
    for (const Choice& choice : scene_.chosen)
        all["choices"].push_back({{"key", choice.key}, {"value", choice.value}, {"reason", choice.reason}});
    if (all.contains("estimate"))
        all["came"] = {{"points", simulation_.points()},
                       {"steps", solver().steps()},
                       {"constitutive_updates", solver().updates()},
                       {"seconds", seconds_since(start_)},
                       {"peak_bytes", peak_resident_bytes()}};
    return all;
}

void Run::summary(const char* status, const std::string& message) {
    const double wall = seconds_since(start_);
    const Grid& grid = simulation_.model().grid;
    std::vector<std::string> said = cautions(scene_);
    for (const std::string& caution : {kinetic_caution(), yield_caution(), frame_caution(status)})
        if (!caution.empty()) said.push_back(caution);
    nlohmann::json s = {
        {"status", status},
        {"title", scene_.title},
        {"program_version", options_.program_version},
        {"plan", plan()},
        {"cautions", said},
        {"counts",
         {{"points", simulation_.points()},
          {"cells", static_cast<int64_t>(grid.axis(0).cells()) * grid.axis(1).cells()},
          {"steps", solver().steps()},
          {"constitutive_updates", solver().updates()},
          {"newton_iterations", solver().iterations()},
          {"frames", frames_}}},
        {"time", solver().time()},
        {"energy",
         {{"kinetic_ratio", solver().energies().ratio()},
          {"largest_kinetic_ratio", simulation_.largest_kinetic_ratio(writer_.rows())},
          {"energy_error", solver().energies().error()}}},
        {"wall_seconds", {{"total", wall}, {"stepping", stepping_}, {"other", wall - stepping_}}},
        {"threads", threads_},
        {"derived", derived_},
        {"reference", reference_},
        {"provenance", provenance().text}};
    if (solver().stability_limit() > 0.0) s["stable_step_s"] = solver().stability_limit();
    if (!message.empty()) s["message"] = message;
    writer_.summary(s);
}

// A quasi-static curve of a run that is not quasi-static is the commonest misuse of mass scaling.
std::string Run::kinetic_caution() const {
    const double ratio = simulation_.largest_kinetic_ratio(writer_.rows());
    if (ratio <= 0.05) return "";
    return fmt::format(
        "caution: kinetic energy reached {:.0f} % of the strain energy; this run shows inertia, not "
        "a quasi-static test. Load more slowly{}",
        100.0 * ratio, scene_.solver.mass_scaling > 1.0 ? ", or lower solver.mass_scaling" : "");
}

bool Run::elastic_behind() const {
    return scene_.frame == Frame::total &&
           std::any_of(scene_.boundaries.begin(), scene_.boundaries.end(), [](const BoundaryUse& use) {
               return static_cast<const gault_boundary_api*>(use.model.component->declaration->api)->flags &
                      GAULT_BOUNDARY_ELASTIC_BEHIND;
           });
}

std::string Run::yield_caution() const {
    if (yielding_ == 0.0) return "";
    return fmt::format(
        "caution: the soil yields up to the boundary at {:.4g} m, which stands for elastic soil "
        "beyond; about {:.3g} m would have been enough",
        scene_.geometry.upper[0], yielding_);
}

std::string Run::frame_caution(const std::string& status) {
    std::vector<double> never;
    for (const Crossing& frame : simulation_.frames())
        if (!frame.done()) never.push_back(frame.target());
    if (status != "done" || never.empty()) return "";
    return fmt::format("caution: {} never reached {:g}, where frames were asked for", scene_.frames.measure,
                       fmt::join(never, ", "));
}

// Notices soil that yields up to a boundary that stands for elastic soil, and how far it would have.
void Run::watch_yield() {
    if (!elasticity_) return;
    const double outer = scene_.geometry.upper[0];
    const Axis& axis = simulation_.model().grid.axis(0);
    const Motion& motion = solver().motion();
    if (elasticity_->largest_inelastic_radius(motion) >= outer - axis.length()[axis.cells() - 1])
        yielding_ = std::max(yielding_, elasticity_->yielding_radius(motion, outer));
}

void Run::report_reference() const {
    for (const auto& c : reference_.value("curves", nlohmann::json::array())) {
        const std::string y = c["y"];
        if (c.contains("not_compared"))
            log::warn("{} not compared: {}", y, c["not_compared"].get<std::string>());
        else
            log::info("{}: largest relative error {:.4f} % at {} = {:.4g}", y,
                      100.0 * c["largest_relative_error"].get<double>(), c["x"].get<std::string>(),
                      c["largest_at"].get<double>());
    }
    for (const auto& p : reference_.value("profiles", nlohmann::json::array())) {
        if (p.contains("not_compared"))
            log::warn("profile not compared: {}", p["not_compared"].get<std::string>());
        else
            log::info("{} = {:g}: L2 error of raw sigma_r {:.4f} %, sigma_theta {:.4f} %",
                      p["measure"].get<std::string>(), p["value"].get<double>(),
                      100.0 * p["sigma_r_l2"].get<double>(), 100.0 * p["sigma_theta_l2"].get<double>());
    }
}

// Names are unique among observers and among programs, not among both.
void Run::derive() {
    derived_ = verification_.observe(solver());
    nlohmann::json results = simulation_.program().evaluate(writer_.rows());
    if (results.empty()) return;
    std::string name = scene_.program.component->declaration->name;
    if (derived_.contains(name)) name += "_program";
    derived_[name] = std::move(results);
}

void Run::report_derived() const {
    std::vector<std::string> absent;
    for (const auto& [name, results] : derived_.items())
        for (const auto& [key, value] : results.items())
            if (value.is_object() && value.contains("absent"))
                absent.push_back(key);
            else
                log::info("{} {}: {}", name, key, derived_text(value));
    if (!absent.empty())
        log::info("not derived, for reasons that are in summary.json: {}", fmt::join(absent, ", "));
}

void Run::report() {
    const double updates = static_cast<double>(solver().updates());
    log::info("{} steps, {} points, {:.3g} s ({:.1f} M point-steps/s)", solver().steps(),
              simulation_.points(), seconds_since(start_),
              stepping_ > 0.0 ? updates / stepping_ * 1e-6 : 0.0);
    if (scene_.solver.kind == SolverKind::explicit_dynamics)
        log::info("kinetic energy at most {:.2g} % of the strain energy once the load has set in",
                  100.0 * simulation_.largest_kinetic_ratio(writer_.rows()));
    log::info("energy error {:.2g} %", 100.0 * solver().energies().error());
    for (const std::string& caution : {kinetic_caution(), yield_caution(), frame_caution("done")})
        if (!caution.empty()) log::warn("{}", caution);
    report_reference();
    report_derived();
    log::info("results in {}", writer_.folder().string());
}

void Run::step_on(Progress& progress) {
    if (simulation_.step() == Simulation::Moved::yes) {
        if (simulation_.row_due()) {
            writer_.row(simulation_.row());
            watch_yield();
        }
        frames_due(false);
    }
    if (!progress.due(solver().steps())) return;
    const Program& program = simulation_.program();
    progress.show({solver().steps(), solver().time(), simulation_.next_event(),
                   program.columns().empty()
                       ? ""
                       : fmt::format("{} {:.4g}", program.columns()[0].name, program.record()[0])});
}

void Run::finish() {
    frames_due(true);
    if (!interrupted) {
        reference_ = verification_.finish(writer_.rows());
        derive();
    }
    summary(interrupted ? "interrupted" : "done", "");
    writer_.finish();
}

Outcome Run::go() {
    for (const std::string& caution : cautions(scene_))
        log::warn("{}", caution);
    if (!options_.quiet)
        for (const std::string& note : notes(simulation_))
            log::info("{}", note);
    Interrupts interrupts;
    Progress progress(simulation_.points(), options_.quiet);
    if (elastic_behind())
        elasticity_.emplace(simulation_.model(), solver().motion(), scene_.volumetric_strain);
    try {
        simulation_.start();
        if (simulation_.row_due()) writer_.row(simulation_.row());
        frames_due(false);
        const auto stepping = std::chrono::steady_clock::now();
        while (!simulation_.done() && !interrupted)
            step_on(progress);
        stepping_ = seconds_since(stepping);
        finish();
    } catch (const RunError& error) {
        const bool unstable = dynamic_cast<const InstabilityError*>(&error) != nullptr;
        const std::string message =
            fmt::format("step {}, t = {:.6g} s: {}{}", solver().steps(), solver().time(), error.what(),
                        unstable ? "; " + advice() : "");
        fail(message);
        throw RunError(message);
    } catch (const std::exception& error) { // a program drives two boundaries against each other, no memory
        fail(error.what());
        throw;
    }
    if (interrupted) return Outcome::interrupted;
    if (!options_.quiet) report();
    return Outcome::done;
}

} // namespace

// A side without a boundary that the initial stress pushes against.
bool is_free_under_stress(const Scene& scene, const SurfaceUse& surface) {
    const InitialStress& initial = scene.initial_stress;
    const bool end = surface.side >= low_y;
    if (surface.cells || surface.name == "axis" || (end && scene.symmetry == Symmetry::radial)) return false;
    const bool pushed =
        end ? initial.vertical != 0.0 || (initial.gravity && (surface.side == low_y || initial.depth > 0.0))
            : initial.k0 * initial.vertical != 0.0 || (initial.gravity && initial.k0 > 0.0);
    return pushed &&
           std::none_of(scene.boundaries.begin(), scene.boundaries.end(), [&](const BoundaryUse& use) {
               return std::any_of(use.surfaces.begin(), use.surfaces.end(), [&](int s) {
                   return scene.surfaces[static_cast<std::size_t>(s)].side == surface.side;
               });
           });
}

std::vector<std::string> cautions(const Scene& scene) {
    std::vector<std::string> all;
    if (scene.solver.time_step_factor > 1.0)
        all.push_back(fmt::format("caution: with solver.time_step_factor {:g} the step exceeds the stability "
                                  "limit; the run will likely fail",
                                  scene.solver.time_step_factor));
    if (scene.frame == Frame::updated && scene.basis == Basis::linear)
        all.push_back("caution: with grid.basis linear, forces jump where points cross cells; take "
                      "quadratic, or model.frame total");
    for (const SurfaceUse& surface : scene.surfaces)
        if (is_free_under_stress(scene, surface))
            all.push_back(
                fmt::format("caution: nothing acts on '{}', against which the initial stress pushes; give it "
                            "a boundary",
                            surface.name));
    const bool dynamic = scene.solver.kind == SolverKind::explicit_dynamics;
    if (scene.points_per_cell == 1 && (dynamic || scene.symmetry != Symmetry::radial))
        all.push_back("caution: one point a cell passes no motion whose sign alternates from node to node, "
                      "so forces of that shape are never balanced; take 4 points");
    if (scene.points_per_cell == 1 && scene.basis == Basis::quadratic)
        all.push_back(
            "caution: one point a cell does not integrate quadratic functions: the error falls with the "
            "first power of the cells; take 2 points in radial symmetry, 4 elsewhere");
    if (scene.placement == Placement::uniform && scene.points_per_cell == 4 &&
        scene.basis == Basis::quadratic)
        all.push_back(
            "caution: four uniform points do not integrate quadratic functions, so surface loads and inertia "
            "disagree; take points.placement gauss, or 9 points");
    return all;
}

int threads_that_pay(std::size_t points, int wanted) {
    const int cores = std::max(1u, std::thread::hardware_concurrency());
    const int useful = static_cast<int>(std::max<std::size_t>(1, points / 8192));
    return wanted > 0 ? wanted : std::min(cores, useful);
}

Outcome run_scene(const Scene& scene, const RunOptions& options) {
    return Run(scene, options).go();
}

std::vector<std::string> check_scene(const Scene& scene) {
    Simulation simulation(scene, 1);
    Verification verification(scene, simulation.columns());
    const Model& model = simulation.model();
    std::vector<std::string> lines;
    for (const Choice& choice : scene.chosen)
        lines.push_back(fmt::format("{}: {} ({})", choice.key, choice.value, choice.reason));
    for (std::string& caution : cautions(scene))
        lines.push_back(std::move(caution));
    for (std::string& note : notes(simulation))
        lines.push_back(std::move(note));
    lines.insert(lines.end(), model.description.begin(), model.description.end());
    for (std::size_t m = 0; m < model.materials.size(); ++m)
        lines.push_back(
            fmt::format("material {}: {} points", model.materials[m].name(), model.points[m].count()));
    for (std::string& line : simulation.solver().boundaries().description())
        lines.push_back(std::move(line));
    const double dt = simulation.solver().allowed_step();
    if (const double limit = simulation.solver().stability_limit(); limit > 0.0)
        lines.push_back(fmt::format("stable step {:.4g} s, used {:.4g} s", limit, dt));
    return lines;
}

} // namespace gault::core
