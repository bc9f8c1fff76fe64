#include "core/scheduler/check.hpp"
#include "core/scheduler/program.hpp"
#include "core/scheduler/run.hpp"
#include "core/scheduler/snapshot.hpp"
#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0;

std::string message(const std::function<void()>& f) {
    try {
        f();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

std::string content(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<std::string> lines(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);)
        all.push_back(line);
    return all;
}

class Running : public testing::Test {
  protected:
    TestMaterial soil{lame, shear};
    TestBoundary wall;
    TestProgram program;
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("gault-run-" + std::to_string(getpid()));
    ~Running() override { std::filesystem::remove_all(folder); }

    // A column whose top a program can move; the program ends at `end` and emits a row a step.
    SmallScene column(double end, Frame frame = Frame::total) {
        Shape shape;
        shape.frame = frame;
        SmallScene s(shape);
        s.add(soil, density);
        s.roll({0, 1, 2});
        wall.controls = {{"speed", "m/s", "", 0.0}};
        if (!wall.constrain)
            wall.constrain = [](gault_nodes& nodes) {
                for (int64_t i = 0; i < nodes.count; ++i) {
                    nodes.fixed[1][i] = 1.0;
                    nodes.velocity[1][i] = -nodes.control[0];
                }
            };
        s.add(wall, {3});
        if (program.measures.empty())
            program.measures = {{"normal_force", "N", "", 0.0}, {"displacement", "m", "", 0.0}};
        program.controls = {{"speed", "m/s", "", 0.0}};
        program.records = {{"force", "N", "", 0.0}, {"travel", "m", "", 0.0}};
        if (!program.advance)
            program.advance = [end](gault_step& step, gault_error&) {
                step.control[0] = 0.1;
                step.record[0] = step.measure[0];
                step.record[1] = step.measure[1];
                step.emit = 1;
                step.next = end;
                step.done = step.time >= end;
                return gault_status(GAULT_OK);
            };
        s.add(program, 3);
        return s;
    }
    Outcome run(const SmallScene& s, int threads = 1) {
        RunOptions options;
        options.folder = folder;
        options.quiet = true;
        options.threads = threads;
        options.program_version = "test";
        return run_scene(s.scene, options);
    }
    nlohmann::json summary() const { return nlohmann::json::parse(content(folder / "summary.json")); }
};

TEST_F(Running, EndsExactlyWhereTheProgramSays) {
    EXPECT_EQ(run(column(1e-3)), Outcome::done);
    const auto rows = lines(folder / "history.csv");
    EXPECT_EQ(rows.front().substr(0, 24), "time_s,force_N,travel_m,");
    EXPECT_EQ(std::stod(rows.back()), 1e-3);
    EXPECT_EQ(summary()["status"], "done");
    EXPECT_EQ(summary()["time"], 1e-3);
    EXPECT_EQ(summary()["counts"]["steps"], rows.size() - 2);
    EXPECT_EQ(summary()["counts"]["points"], 12 * 16);
}

TEST_F(Running, StepsEndExactlyAtEveryEventAndNoneIsACrumb) {
    std::vector<double> times, steps;
    program.advance = [&](gault_step& step, gault_error&) {
        times.push_back(step.time);
        if (step.index > 0) steps.push_back(step.dt);
        step.next = step.time < 1e-3 ? 1e-3 : 1.7e-3;
        step.done = step.time >= 1.7e-3;
        EXPECT_EQ(step.final, 1u);
        return gault_status(GAULT_OK);
    };
    run(column(0.0));
    EXPECT_EQ(std::count(times.begin(), times.end(), 1e-3), 1);
    EXPECT_EQ(times.back(), 1.7e-3);
    const double longest = *std::max_element(steps.begin(), steps.end());
    for (const double dt : steps)
        EXPECT_GE(dt, 0.49 * longest);
}

TEST_F(Running, TheProgramRemembersAndIsAskedOnceBeforeTheFirstStep) {
    std::vector<double> calls;
    program.memories = {{"calls", "1", "", 3.0}};
    program.advance = [&](gault_step& step, gault_error&) {
        if (calls.empty()) {
            EXPECT_EQ(step.index, 0);
            EXPECT_EQ(step.dt, 0.0);
            EXPECT_GT(step.next_dt, 0.0);
        }
        calls.push_back(step.memory[0]);
        step.memory[0] += 1.0;
        step.done = step.index == 4;
        return gault_status(GAULT_OK);
    };
    run(column(0.0));
    EXPECT_EQ(calls, (std::vector<double>{3, 4, 5, 6, 7}));
}

TEST_F(Running, WhatTheProgramCommandsMovesTheWall) {
    run(column(1e-3));
    const auto rows = lines(folder / "history.csv");
    double time, force, travel;
    char comma;
    std::stringstream(rows.back()) >> time >> comma >> force >> comma >> travel;
    EXPECT_NEAR(travel, 0.1 * 1e-3, 1e-15);
    EXPECT_GT(force, 0.0);
}

TEST_F(Running, WritesTheFramesThatAreDueAndTheLastState) {
    SmallScene s = column(1e-3);
    s.scene.solver.time_step_factor = 0.05;
    s.scene.frames = {"travel", {0.0, 2e-5, 5e-5}};
    run(s);
    EXPECT_EQ(summary()["counts"]["frames"], 4); // the last state is none of them
}

TEST_F(Running, GoesOnWhenTheSceneFileIsGone) {
    const std::filesystem::path file = folder.string() + ".yaml";
    std::ofstream(file) << "a scene";
    SmallScene s = column(1e-3);
    s.scene.file = file;
    s.scene.solver.time_step_factor = 0.05;
    s.scene.frames = {"travel", {5e-5}};
    program.advance = [&, advance = program.advance](gault_step& step, gault_error& e) {
        std::filesystem::remove(file);
        return advance(step, e);
    };
    EXPECT_EQ(run(s), Outcome::done);
    EXPECT_EQ(summary()["counts"]["frames"], 2);
}

TEST_F(Running, SaysStepTimeAndPointWhenTheRunFails) {
    double limit = 0.0;
    soil.update = [&](gault_points& p, gault_error& e) {
        if (p.dt == 0.0 || std::abs(p.stress_old[1][0]) < 100.0) return soil.elastic(p);
        limit = p.time - p.dt;
        e.point = 0;
        std::strcpy(e.text, "had enough");
        return gault_status(GAULT_FAILED);
    };
    SmallScene s = column(1.0);
    const std::string text = message([&] { run(s); });
    const auto history = lines(folder / "history.csv");
    const std::string steps = std::to_string(history.size() - 2);
    EXPECT_TRUE(text.starts_with("step " + steps + ", t = ")) << text;
    EXPECT_NE(text.find("s: point "), std::string::npos) << text;
    EXPECT_NE(text.find("had enough"), std::string::npos) << text;
    EXPECT_EQ(summary()["status"], "failed");
    EXPECT_EQ(summary()["message"], text);
    EXPECT_NEAR(summary()["time"].get<double>(), limit, 1e-15);
    EXPECT_TRUE(std::filesystem::exists(folder / "results.h5"));
}

TEST_F(Running, TwoThreadsGiveTheSameBits) {
    program.advance = [&](gault_step& step, gault_error&) {
        step.control[0] = 0.5;
        for (std::size_t k = 0; k < program.records.size(); ++k)
            step.record[k] = step.measure[k];
        step.emit = 1;
        step.done = step.index == 60;
        return gault_status(GAULT_OK);
    };
    std::vector<std::string> names;
    for (const std::string& name : ExplicitSolver::measure_names()) {
        program.measures.push_back({name.c_str(), "1", "", 0.0});
        names.push_back("measured_" + name);
    }
    for (const Frame frame : {Frame::total, Frame::updated})
        for (const StressUpdate order : {StressUpdate::usl, StressUpdate::usf}) {
            if (frame == Frame::total && order == StressUpdate::usf) continue;
            std::vector<std::string> histories;
            for (const int threads : {1, 2, 3}) {
                SmallScene s = column(0.0, frame);
                program.records = program.measures;
                for (std::size_t k = 0; k < names.size(); ++k)
                    program.records[k].name = names[k].c_str();
                s.add(program, 3);
                s.scene.axes = {{{70, 1.01}, {7, 1.0}}}; // several batches a row
                s.scene.gravity = {0.0, -10.0};
                s.scene.solver.stress_update = order;
                s.scene.solver.viscosity = 0.1;
                run(s, threads);
                histories.push_back(content(folder / "history.csv"));
                std::filesystem::remove_all(folder);
            }
            EXPECT_EQ(lines(folder / "history.csv").size(), 0u);
            EXPECT_EQ(histories[0], histories[1]);
            EXPECT_EQ(histories[0], histories[2]);
            EXPECT_GT(std::count(histories[0].begin(), histories[0].end(), '\n'), 60);
        }
}

TEST_F(Running, AnInterruptionLeavesCompleteResults) {
    program.advance = [&](gault_step& step, gault_error&) {
        step.emit = 1;
        if (step.index == 5) std::raise(SIGINT);
        return gault_status(GAULT_OK);
    };
    EXPECT_EQ(run(column(0.0)), Outcome::interrupted);
    EXPECT_EQ(summary()["status"], "interrupted");
    EXPECT_EQ(lines(folder / "history.csv").size(), 7u);
}

TEST_F(Running, DoesNotReplaceResultsUnasked) {
    run(column(1e-3));
    const std::string before = content(folder / "history.csv");
    EXPECT_THROW(run(column(1e-3)), InputError);
    EXPECT_EQ(content(folder / "history.csv"), before);
}

TEST_F(Running, BoundariesThatContradictAreRefusedBeforeAnythingIsWritten) {
    SmallScene s = column(1e-3);
    TestBoundary other;
    other.constrain = [](gault_nodes& nodes) {
        for (int64_t i = 0; i < nodes.count; ++i)
            nodes.fixed[0][i] = nodes.velocity[0][i] = 1.0;
    };
    s.add(other, {3}); // the rollers on the left and on the right hold the corners
    EXPECT_THROW(run(s), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(Running, BoundariesThatAProgramDrivesApartLeaveAFailedRun) {
    SmallScene s = column(1e-3);
    s.roll({3}); // agrees as long as the wall stands still
    EXPECT_THROW(run(s), InputError);
    EXPECT_EQ(summary()["status"], "failed");
}

// ---- program ------------------------------------------------------------------------------------------

TEST_F(Running, AMeasureThatTheHostDoesNotOfferIsAnError) {
    program.measures = {{"radios", "m", "", 0.0}, {"radius", "m", "", 0.0}};
    const std::string text = message([&] { run(column(1e-3)); });
    EXPECT_NE(text.find("scene.yaml:7:3: 'test_program' asks for the measure 'radios'"), std::string::npos)
        << text;
    EXPECT_NE(text.find("did you mean 'radius'?"), std::string::npos) << text;
}

TEST_F(Running, AMeasureOfASurfaceNeedsASurface) {
    SmallScene s = column(1e-3);
    s.add(program);
    const std::string text = message([&] { run(s); });
    EXPECT_NE(text.find("measures 'normal_force' of a surface: say which one with `on:`"), std::string::npos)
        << text;
}

TEST_F(Running, AControlThatNobodyListensToIsAnError) {
    SmallScene s = column(1e-3);
    s.add(program, 0); // the roller on the left listens to nothing
    const std::string text = message([&] { run(s); });
    EXPECT_NE(text.find("commands 'speed', but no boundary on 'left' listens to it; none there listens"),
              std::string::npos)
        << text;
}

TEST_F(Running, AControlIsCommandedInTheUnitThatItsListenerExpects) {
    SmallScene s = column(1e-3);
    program.controls = {{"speed", "mm/s", "", 0.0}};
    s.add(program, 3);
    const std::string text = message([&] { run(s); });
    EXPECT_NE(text.find("commands 'speed' in mm/s, the boundary on 'top' expects m/s"), std::string::npos)
        << text;
}

TEST_F(Running, AProgramOnAPartCommandsWhatIsOnThePartAlone) {
    SmallScene s = column(1e-3);
    s.scene.program_surface = s.part(high_y, 0, 2);
    EXPECT_EQ(message([&] { run(s); }),
              "scene.yaml:7:3: program 'test_program' commands 'speed', but no "
              "boundary on 'part 4' listens to it; none there listens to a program");
    s.scene.boundaries.back().surfaces = {4};
    EXPECT_EQ(run(s), Outcome::done);
    EXPECT_EQ(message([&] {
                  s.scene.program_surface = high_y;
                  run(s);
              }),
              "scene.yaml:7:3: program 'test_program' commands 'speed', but no boundary on 'top' listens to "
              "it; none there listens to a program");
}

TEST_F(Running, AGaugeMeasuresItsPlaceInsteadOfTheMean) {
    std::vector<std::array<double, 3>> seen;
    program.measures = {
        {"displacement", "m", "", 0.0}, {"radius", "m", "", 0.0}, {"initial_radius", "m", "", 0.0}};
    program.advance = [&](gault_step& step, gault_error&) {
        seen.push_back({step.measure[0], step.measure[1], step.measure[2]});
        step.control[0] = 0.1;
        step.next = 1e-3;
        step.done = step.time >= 1e-3;
        return gault_status(GAULT_OK);
    };
    wall.constrain = [](gault_nodes& nodes) { // pushes the right end of the top only
        for (int64_t i = 0; i < nodes.count; ++i) {
            nodes.fixed[1][i] = 1.0;
            nodes.velocity[1][i] = -nodes.control[0] * nodes.position[0][i];
        }
    };
    SmallScene s = column(1e-3);
    s.scene.program_gauge = 0.75;
    run(s);
    EXPECT_NEAR(seen.back()[0], 0.75 * 0.1 * 1e-3, 1e-9);
    EXPECT_NEAR(seen.back()[1], 0.75, 1e-5);
    EXPECT_DOUBLE_EQ(seen.back()[2], 0.75);
}

TEST_F(Running, ARecordThatTheHistoryHasAlreadyIsAnError) {
    SmallScene s = column(1e-3);
    program.records[1].name = "kinetic_ratio";
    s.add(program, 3);
    EXPECT_EQ(message([&] { run(s); }), "scene.yaml:7:3: program 'test_program' records 'kinetic_ratio', a "
                                        "column that the history has already");
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(Running, AProgramThatFailsOrWantsToRepeatAStepEndsTheRun) {
    for (const gault_status status : {GAULT_FAILED, GAULT_RETRY}) {
        program.advance = [&](gault_step&, gault_error& e) {
            std::strcpy(e.text, "no more");
            return gault_status(status);
        };
        const std::string text = message([&] { run(column(1e-3)); });
        EXPECT_NE(text.find("program 'test_program': no more"), std::string::npos) << text;
        EXPECT_EQ(text.find("asked to repeat a step") != std::string::npos, status == GAULT_RETRY);
        std::filesystem::remove_all(folder);
    }
}

// ---- looking at it ------------------------------------------------------------------------------------

TEST_F(Running, CheckingSaysWhatTheSceneTookHoldOf) {
    const auto said = check_scene(column(1e-3).scene);
    const auto has = [&](const std::string& line) {
        return std::any_of(said.begin(), said.end(), [&](const std::string& s) { return s.starts_with(line); });
    };
    EXPECT_TRUE(has("material soil: 192 points, "));
    EXPECT_TRUE(has("test_boundary on top: 6 nodes"));
    EXPECT_TRUE(said.back().starts_with("stable step ")) << said.back();
}

TEST_F(Running, StatesHaveOneShapeAndNamesOfTheirOwn) {
    TestMaterial rock(lame, shear);
    const auto refusal = [&](gault_state one, gault_state other) {
        soil.states = {one};
        rock.states = {other};
        SmallScene s = column(1e-3);
        s.add(rock, density, "rock");
        return message([&] { check_scene(s.scene); });
    };
    const gault_state age{"age", "s", "", GAULT_SCALAR, 0, 0.0, 0.0, 1.0};
    gault_state fabric = age, stress = age;
    fabric.shape = GAULT_SYMMETRIC;
    stress.name = "stress";
    EXPECT_EQ(refusal(age, age), "");
    EXPECT_EQ(refusal(age, fabric), "scene.yaml:7:3: material 'rock' has the state 'age' with 6 components, "
                                    "material 'soil' with 1");
    EXPECT_EQ(
        refusal(age, stress),
        "scene.yaml:7:3: material 'rock' has the state 'stress', a dataset that every frame has already");
}

TEST_F(Running, CollectedPointsAreInTheOrderOfTheirIdentity) {
    for (const Frame frame : {Frame::total, Frame::updated}) {
        soil.states = {{"amount", "1", "", GAULT_SCALAR, 0, 0.25, 0.0, 1.0}};
        SmallScene s = column(0.0, frame);
        Model model = build_model(s.scene);
        ExplicitSolver solver(s.scene, model, 1);
        const PointArrays before = collect(solver.motion());
        for (std::size_t i = 1; i < before.volume.size(); ++i) // cell by cell, row by row
            EXPECT_TRUE(before.reference[1][i] > before.reference[1][i - 1] - 1.0 / 3 &&
                        before.volume[i] > 0.0);
        for (int n = 0; n < 10; ++n)
            solver.step(solver.allowed_step());
        const PointArrays after = collect(solver.motion());
        EXPECT_EQ(after.reference, before.reference);
        EXPECT_EQ(before.position, before.reference);
        EXPECT_EQ(collect_state(solver.motion(), "amount"), std::vector<double>(192, 0.25));
        EXPECT_TRUE(collect_state(solver.motion(), "nothing").empty());
    }
}

TEST(Threads, PayOnlyWherePointsAreMany) {
    EXPECT_EQ(threads_that_pay(100, 0), 1);
    EXPECT_EQ(threads_that_pay(100, 7), 7);
    EXPECT_GE(threads_that_pay(1000000, 0), 1);
}

} // namespace
} // namespace gault::core::test
