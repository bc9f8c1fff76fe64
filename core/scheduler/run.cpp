#include "core/scheduler/run.hpp"
#include "core/base/isa.hpp"
#include "core/base/log.hpp"
#include "core/base/memory.hpp"
#include "core/scheduler/cautions.hpp"
#include "core/scheduler/progress.hpp"
#include "core/scheduler/report.hpp"
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

// A simulation, and what is written of it.
class Run {
  public:
    Run(const Scene& scene, const RunOptions& options)
        : scene_(scene), options_(options), threads_(threads_that_pay(scene.points(), options.threads)),
          simulation_(scene, threads_), verification_(scene, simulation_.columns()),
          provenance_(provenance()),
          writer_(options.folder, options.replace, simulation_.columns(), provenance_, simulation_.points()),
          of_the_scene_(cautions(scene)), cautions_(simulation_) {}

    Outcome go();

  private:
    Provenance provenance() const;
    double share_done();
    void step_on(Progress& progress);
    void finish();
    void frames_due(bool last);
    void write_frame();
    void summary(const char* status, const std::string& message);
    nlohmann::json plan();
    void fail(const std::string& message);         // what was written stays, with the reason
    std::string keep_point(const RunError& error); // what the message says of it
    std::string advice();
    void derive();
    void report();
    Solver& solver() { return simulation_.solver(); }

    const Scene& scene_;
    const RunOptions& options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    int threads_;
    Simulation simulation_;
    Verification verification_;
    const Provenance provenance_; // of the files as they were at the start
    ResultWriter writer_;
    const std::vector<std::string> of_the_scene_; // cautions
    RunCautions cautions_;
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
    verification_.look([&](const std::string& measure) { return simulation_.measured(measure); },
                       solver().motion());
    bool due = last;
    for (Crossing& frame : simulation_.frames())
        due |= frame.reached(simulation_.measured(scene_.frames.measure));
    if (due) write_frame();
}

std::string Run::advice() {
    if (solver().repeatable())
        return fmt::format("try a smaller solver.strain_step (now {:g}) or a gentler load",
                           scene_.solver.strain_step);
    if (scene_.solver.time_step_factor > 1.0)
        return fmt::format(
            "solver.time_step_factor is {:g}: above 1 the step exceeds the stability limit of {:.4g} s",
            scene_.solver.time_step_factor, solver().stability_limit());
    return fmt::format("try a smaller solver.time_step_factor (now {:g}) or a gentler load",
                       scene_.solver.time_step_factor);
}

// The call that gave no result, so that `gault element` can make it again.
std::string Run::keep_point(const RunError& error) try {
    const auto* point = dynamic_cast<const PointError*>(&error);
    if (!point || !point->call()) return "";
    writer_.failed_point(replay_yaml(
        fmt::format("{}: step {}, t = {:.6g} s", scene_.title, solver().steps() + 1, point->call()->time),
        scene_.materials[static_cast<std::size_t>(point->material())], *point->call()));
    return fmt::format("; its inputs: `gault element {}`", (writer_.folder() / "failed_point.yaml").string());
} catch (const std::exception&) { // must not take the place of the reason
    return "";
}

void Run::fail(const std::string& message) try {
    summary("failed", message);
    writer_.finish();
} catch (const std::exception& error) { // must not take the place of the reason
    log::warn("the summary was not written: {}", error.what());
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
    std::vector<std::string> said = of_the_scene_;
    for (std::string& caution : cautions_.now(writer_.rows(), status == std::string("done")))
        said.push_back(std::move(caution));
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
        {"peak_memory_bytes", peak_resident_bytes()},
        {"derived", derived_},
        {"reference", reference_},
        {"provenance", provenance_.text}};
    if (solver().stability_limit() > 0.0) s["stable_step_s"] = solver().stability_limit();
    if (!message.empty()) s["message"] = message;
    writer_.summary(s);
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

void Run::report() {
    const double updates = static_cast<double>(solver().updates());
    log::info("{} steps, {} points, {:.3g} s ({:.1f} M point-steps/s)", solver().steps(),
              simulation_.points(), seconds_since(start_),
              stepping_ > 0.0 ? updates / stepping_ * 1e-6 : 0.0);
    if (scene_.solver.kind == SolverKind::explicit_dynamics)
        log::info("kinetic energy at most {:.2g} % of the strain energy once the load has set in",
                  100.0 * simulation_.largest_kinetic_ratio(writer_.rows()));
    log::info("energy error {:.2g} %", 100.0 * solver().energies().error());
    for (const std::string& caution : cautions_.now(writer_.rows(), true))
        log::warn("{}", caution);
    report_reference(reference_);
    report_derived(derived_);
    log::info("results in {}", writer_.folder().string());
}

// By the steps that the run was estimated to take: a program tells its next event, not its end.
double Run::share_done() {
    const auto steps = options_.plan.value("/estimate/steps"_json_pointer, nlohmann::json());
    return steps.is_number() ? static_cast<double>(solver().steps()) / steps.get<double>() : std::nan("");
}

void Run::step_on(Progress& progress) {
    if (simulation_.step() == Simulation::Moved::yes) {
        if (simulation_.row_due()) {
            writer_.row(simulation_.row());
            cautions_.look();
        }
        frames_due(false);
    }
    if (!progress.due(solver().steps())) return;
    const Program& program = simulation_.program();
    progress.show({solver().steps(), solver().time(), share_done(),
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
    for (const std::string& caution : of_the_scene_)
        log::warn("{}", caution);
    if (!options_.quiet)
        for (const std::string& note : notes(simulation_))
            log::info("{}", note);
    Interrupts interrupts;
    Progress progress(simulation_.points(), options_.quiet);
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
        const std::string kept = keep_point(error);
        const bool unstable = dynamic_cast<const InstabilityError*>(&error) != nullptr;
        const std::string message =
            fmt::format("step {}, t = {:.6g} s: {}{}{}", solver().steps(), solver().time(), error.what(),
                        unstable ? "; " + advice() : "", kept);
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

int threads_that_pay(std::size_t points, int wanted) {
    const int cores = std::max(1u, std::thread::hardware_concurrency());
    const int useful = static_cast<int>(std::max<std::size_t>(1, points / 8192));
    return wanted > 0 ? wanted : std::min(cores, useful);
}

Outcome run_scene(const Scene& scene, const RunOptions& options) {
    return Run(scene, options).go();
}

} // namespace gault::core
