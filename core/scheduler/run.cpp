#include "core/scheduler/run.hpp"
#include "core/base/isa.hpp"
#include "core/base/log.hpp"
#include "core/scheduler/program.hpp"
#include "core/scheduler/progress.hpp"
#include "core/scheduler/snapshot.hpp"
#include "core/scheduler/verification.hpp"
#include "core/solver/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

namespace gault::core {
namespace {

constexpr double start_share = 0.05;

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

// An observer's result is a number, a program's {value, unit, ...} or {absent, ...}.
std::string derived_text(const nlohmann::json& result) {
    if (result.is_number()) return fmt::format("{:.6g}", result.get<double>());
    if (result.contains("absent")) return fmt::format("not derived: {}", result["absent"].get<std::string>());
    const std::string unit = result["unit"], note = result["note"];
    return fmt::format("{:.6g}{}{}{}", result["value"].get<double>(), unit == "1" ? "" : " " + unit,
                       note.empty() ? "" : "; ", note);
}

// The state of a run, and what happens at the end of each step.
class Run {
  public:
    Run(const Scene& scene, const RunOptions& options)
        : scene_(scene), options_(options), model_(build_model(scene)),
          threads_(threads_that_pay(point_count(), options.threads)),
          solver_(make_solver(scene, model_, threads_)), program_(scene, *solver_),
          verification_(scene, columns()),
          writer_(options.folder, options.replace, columns(), provenance(), point_count()),
          frames_wanted_(scene.frames.values.begin(), scene.frames.values.end()) {}

    Outcome go();

  private:
    std::size_t point_count() const {
        std::size_t n = 0;
        for (const Points& p : model_.points)
            n += p.count();
        return n;
    }
    std::vector<ColumnInfo> columns() const;
    Provenance provenance() const;
    double step_length(double next);
    double share_to_frame(double before) const;
    Program::Answer take_step(const Program::Answer& answer);
    void row();
    void frames_due(bool last);
    double measured(const std::string& name, double since = 0.0) const;
    void write_frame();
    void summary(const char* status, const std::string& message);
    void fail(const std::string& message); // what was written stays, with the reason
    std::string advice() const;
    double largest_kinetic_ratio() const;
    std::string kinetic_caution() const; // empty: none
    void derive();
    void report() const;
    void report_reference() const;

    const Scene& scene_;
    const RunOptions& options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Model model_;
    int threads_;
    std::unique_ptr<Solver> solver_;
    Program program_;
    Verification verification_;
    ResultWriter writer_;
    std::vector<Crossing> frames_wanted_;
    double frame_rate_ = 0.0; // of the measure that frames wait for
    int64_t frame_step_ = -1, frames_ = 0;
    double stepping_ = 0.0; // s
    nlohmann::json reference_, derived_;
};

std::vector<ColumnInfo> Run::columns() const {
    std::vector<ColumnInfo> all{{"time", "s", "Time"}};
    all.insert(all.end(), program_.columns().begin(), program_.columns().end());
    all.push_back({"step", "1", "Steps so far"});
    all.push_back({"kinetic_ratio", "1", "Kinetic energy over strain energy"});
    all.push_back({"energy_error", "1", "Imbalance of energy over its largest part"});
    all.push_back({"largest_velocity", "m/s", "Of the grid nodes"});
    for (std::size_t k = 0; k < all.size(); ++k)
        for (std::size_t other = 0; other < k; ++other)
            if (all[k].name == all[other].name)
                throw InputError(
                    scene_.program.parameters.where,
                    fmt::format("program '{}' records '{}', a column that the history has already",
                                scene_.program.component->declaration->name, all[k].name));
    return all;
}

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

// Ends exactly at the next event, without a last crumb of a step; where steps are long, at the next frame
// too.
double Run::step_length(double next) {
    const double allowed = solver_->allowed_step();
    double left = next - solver_->time();
    if (solver_->repeatable() && frame_rate_ != 0.0)
        for (const Crossing& frame : frames_wanted_) {
            const double ahead = (frame.target() - measured(scene_.frames.measure)) / frame_rate_;
            if (!frame.done() && ahead > 1e-6 * allowed) left = std::min(left, ahead);
        }
    if (left <= 0.0 || left > 2.0 * allowed) return allowed;
    return left > allowed ? 0.5 * left : left;
}

// The share of the last step after which a frame was due, 1 if none was passed.
double Run::share_to_frame(double before) const {
    double share = 1.0;
    for (const Crossing& frame : frames_wanted_) {
        const double now = measured(scene_.frames.measure), target = frame.target();
        if (frame.done() || (before - target) * (now - target) >= 0.0) continue;
        if (std::abs(now - target) > 1e-7 * std::abs(target))
            share = std::min(share, (target - before) / (now - before));
    }
    return share > 1e-6 ? share : 1.0;
}

void Run::row() {
    const Energies energies = solver_->energies();
    std::vector<double> values{solver_->time()};
    values.insert(values.end(), program_.record().begin(), program_.record().end());
    for (const double v : {static_cast<double>(solver_->steps()), energies.ratio(), energies.error(),
                           solver_->largest_velocity()})
        values.push_back(v);
    writer_.row(values);
}

// The record of the program's last call; `since` shifts the time to that of the call before.
double Run::measured(const std::string& name, double since) const {
    if (name == "time") return solver_->time() + since;
    return program_.record()[program_.column(name).value()];
}

void Run::write_frame() {
    if (frame_step_ == solver_->steps()) return;
    frame_step_ = solver_->steps();
    std::vector<FrameAttribute> attributes{{"time", "s", solver_->time()}};
    for (std::size_t k = 0; k < program_.columns().size(); ++k)
        attributes.push_back({program_.columns()[k].name, program_.columns()[k].unit, program_.record()[k]});
    writer_.frame(attributes, frame_datasets(solver_->motion()));
    ++frames_;
    summary("running", "");
}

void Run::frames_due(bool last) {
    for (const ProfileReference& profile : scene_.profiles)
        verification_.at(profile.measure, measured(profile.measure), solver_->motion());
    bool due = last;
    for (Crossing& frame : frames_wanted_)
        due |= frame.reached(measured(scene_.frames.measure));
    if (due) write_frame();
}

std::string Run::advice() const {
    if (scene_.solver.time_step_factor > 1.0)
        return fmt::format(
            "solver.time_step_factor is {:g}: above 1 the step exceeds the stability limit of {:.4g} s",
            scene_.solver.time_step_factor, solver_->stability_limit());
    return fmt::format("try a smaller solver.time_step_factor (now {:g}) or a gentler load",
                       scene_.solver.time_step_factor);
}

void Run::fail(const std::string& message) {
    summary("failed", message);
    writer_.finish();
}

void Run::summary(const char* status, const std::string& message) {
    const double wall = seconds_since(start_);
    std::vector<std::string> said = cautions(scene_);
    if (const std::string caution = kinetic_caution(); !caution.empty()) said.push_back(caution);
    nlohmann::json s = {
        {"status", status},
        {"title", scene_.title},
        {"program_version", options_.program_version},
        {"plan", scene_.chosen},
        {"cautions", said},
        {"counts",
         {{"points", point_count()},
          {"cells", static_cast<int64_t>(model_.grid.axis(0).cells()) * model_.grid.axis(1).cells()},
          {"steps", solver_->steps()},
          {"constitutive_updates", solver_->updates()},
          {"newton_iterations", solver_->iterations()},
          {"frames", frames_}}},
        {"time", solver_->time()},
        {"energy",
         {{"kinetic_ratio", solver_->energies().ratio()},
          {"largest_kinetic_ratio", largest_kinetic_ratio()},
          {"energy_error", solver_->energies().error()}}},
        {"wall_seconds", {{"total", wall}, {"stepping", stepping_}, {"other", wall - stepping_}}},
        {"threads", threads_},
        {"derived", derived_},
        {"reference", reference_},
        {"provenance", provenance().text}};
    if (solver_->stability_limit() > 0.0) s["stable_step_s"] = solver_->stability_limit();
    if (!message.empty()) s["message"] = message;
    writer_.summary(s);
}

// Of the rows after the first start_share of the time: where a load sets in, no run is quasi-static.
double Run::largest_kinetic_ratio() const {
    const std::size_t column = program_.columns().size() + 2; // see columns()
    double largest = 0.0;
    for (const auto& row : writer_.rows())
        if (row[0] >= start_share * solver_->time()) largest = std::max(largest, row[column]);
    return largest;
}

// A quasi-static curve of a run that is not quasi-static is the commonest misuse of mass scaling.
std::string Run::kinetic_caution() const {
    if (largest_kinetic_ratio() <= 0.05) return "";
    return fmt::format(
        "caution: kinetic energy reached {:.0f} % of the strain energy; this run shows inertia, not "
        "a quasi-static test. Load more slowly{}",
        100.0 * largest_kinetic_ratio(),
        scene_.solver.mass_scaling > 1.0 ? ", or lower solver.mass_scaling" : "");
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
    derived_ = verification_.observe(*solver_);
    nlohmann::json results = program_.evaluate(writer_.rows());
    if (results.empty()) return;
    std::string name = scene_.program.component->declaration->name;
    if (derived_.contains(name)) name += "_program";
    derived_[name] = std::move(results);
}

void Run::report() const {
    log::info("{} steps, {} points, {:.3g} s ({:.1f} M point-steps/s)", solver_->steps(), point_count(),
              seconds_since(start_),
              stepping_ > 0.0 ? static_cast<double>(solver_->steps()) * static_cast<double>(point_count()) /
                                    stepping_ * 1e-6
                              : 0.0);
    log::info("kinetic energy at most {:.2g} % of the strain energy after the first {:g} % of the time; "
              "energy error {:.2g} %",
              100.0 * largest_kinetic_ratio(), 100.0 * start_share, 100.0 * solver_->energies().error());
    if (const std::string caution = kinetic_caution(); !caution.empty()) log::warn("{}", caution);
    report_reference();
    for (const auto& [name, results] : derived_.items())
        for (const auto& [key, value] : results.items())
            log::info("{} {}: {}", name, key, derived_text(value));
    log::info("results in {}", writer_.folder().string());
}

// One step, or none where it has to be repeated with another length.
Program::Answer Run::take_step(const Program::Answer& answer) {
    const double dt = step_length(answer.next);
    if (!solver_->step(dt)) return program_.repeat(solver_->allowed_step());
    const bool watch = solver_->repeatable() && !frames_wanted_.empty();
    const double before = watch ? measured(scene_.frames.measure, -dt) : 0.0;
    Program::Answer next = program_.advance(dt, solver_->allowed_step());
    if (!next.repeat && watch) {
        frame_rate_ = (measured(scene_.frames.measure) - before) / dt;
        next.fraction = share_to_frame(before);
        next.repeat = next.fraction < 1.0;
        if (next.repeat) program_.withdraw();
    }
    if (next.repeat) {
        solver_->undo(next.fraction);
        return program_.repeat(solver_->allowed_step());
    }
    if (next.emit) row();
    frames_due(false);
    return next;
}

Outcome Run::go() {
    for (const std::string& caution : cautions(scene_))
        log::warn("{}", caution);
    Interrupts interrupts;
    Progress progress(point_count(), options_.quiet);
    try {
        Program::Answer answer = program_.advance(0.0, solver_->allowed_step());
        if (answer.emit) row();
        frames_due(false);
        const auto stepping = std::chrono::steady_clock::now();
        while (!answer.done && !interrupted) {
            answer = take_step(answer);
            if (progress.due(solver_->steps())) {
                const auto& shown = program_.columns();
                progress.show(
                    {solver_->steps(), solver_->time(), answer.next,
                     shown.empty() ? "" : fmt::format("{} {:.4g}", shown[0].name, program_.record()[0])});
            }
        }
        stepping_ = seconds_since(stepping);
        frames_due(true);
        if (!interrupted) {
            reference_ = verification_.finish(writer_.rows());
            derive();
        }
        summary(interrupted ? "interrupted" : "done", "");
        writer_.finish();
    } catch (const RunError& error) {
        const bool unstable = dynamic_cast<const InstabilityError*>(&error) != nullptr;
        const std::string message =
            fmt::format("step {}, t = {:.6g} s: {}{}", solver_->steps(), solver_->time(), error.what(),
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

std::vector<std::string> cautions(const Scene& scene) {
    std::vector<std::string> all;
    if (scene.solver.time_step_factor > 1.0)
        all.push_back(fmt::format("caution: with solver.time_step_factor {:g} the step exceeds the stability "
                                  "limit; the run will likely fail",
                                  scene.solver.time_step_factor));
    if (scene.frame == Frame::updated && scene.basis == Basis::linear)
        all.push_back("caution: with grid.basis linear, forces jump where points cross cells; take "
                      "quadratic, or model.frame total");
    if (scene.points_per_cell == 1)
        all.push_back("caution: one point a cell passes no motion whose sign alternates from node to node, "
                      "so forces of that shape are never balanced; take 4 points");
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
    Model model = build_model(scene);
    const std::unique_ptr<Solver> solver = make_solver(scene, model, 1);
    Program program(scene, *solver);
    std::vector<ColumnInfo> columns{{"time", "s", ""}};
    columns.insert(columns.end(), program.columns().begin(), program.columns().end());
    Verification verification(scene, columns);
    std::vector<std::string> lines = scene.chosen;
    for (std::string& caution : cautions(scene))
        lines.push_back(std::move(caution));
    lines.insert(lines.end(), model.description.begin(), model.description.end());
    for (std::size_t m = 0; m < model.materials.size(); ++m)
        lines.push_back(
            fmt::format("material {}: {} points", model.materials[m].name(), model.points[m].count()));
    for (std::string& line : solver->boundaries().description())
        lines.push_back(std::move(line));
    const double dt = solver->allowed_step();
    lines.push_back(fmt::format("stable step {:.4g} s, used {:.4g} s", solver->stability_limit(), dt));
    return lines;
}

} // namespace gault::core
