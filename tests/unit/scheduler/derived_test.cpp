// Results that follow from a run: what programs derive from their history, and what observers are shown.
#include "core/scheduler/program.hpp"
#include "core/scheduler/run.hpp"
#include "tests/unit/solver/small_scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace gault::core::test {
namespace {

constexpr double lame = 40e6, shear = 30e6, density = 1600.0;

class Derived : public testing::Test {
  protected:
    TestMaterial soil{lame, shear}, rock{lame, shear};
    TestBoundary wall;
    TestProgram program;
    TestObserver observer;
    bool quiet = true;
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("gault-derived-" + std::to_string(getpid()));
    ~Derived() override { std::filesystem::remove_all(folder); }

    // A block in which nothing happens for four steps, each of which is a row: ten times its number.
    SmallScene block() {
        SmallScene s{Shape{}};
        s.add(soil, density);
        s.roll({0, 1, 2});
        wall.load = [](gault_facets&) {};
        s.add(wall, {3});
        program.records = {{"tens", "1", "", 0.0}};
        program.advance = [](gault_step& step, gault_error&) {
            step.record[0] = 10.0 * static_cast<double>(step.index);
            step.emit = 1;
            step.next = HUGE_VAL;
            step.done = step.index == 4;
            return gault_status(GAULT_OK);
        };
        s.add(program, 3);
        return s;
    }
    nlohmann::json summary(const SmallScene& s) {
        std::filesystem::remove_all(folder);
        RunOptions options;
        options.folder = folder;
        options.quiet = quiet;
        options.threads = 1;
        run_scene(s.scene, options);
        std::ifstream file(folder / "summary.json");
        return nlohmann::json::parse(file);
    }
    std::string failure(const SmallScene& s) {
        try {
            summary(s);
        } catch (const RunError& error) {
            return error.what();
        }
        return "done";
    }
};

TEST_F(Derived, AProgramSeesTheWholeHistoryAndItsResultsAreInTheSummary) {
    std::vector<double> times, tens;
    program.evaluate = [&](const gault_history& h, gault_report& r, gault_error&) {
        EXPECT_EQ(h.columns, 2u);
        times.assign(h.column[0], h.column[0] + h.rows);
        tens.assign(h.column[1], h.column[1] + h.rows);
        const std::string name = "stiffness"; // gone when the summary is written
        r.result(r.host, name.c_str(), "Pa", 5e6, "Hooke (1678)", "of the unloading");
        r.absent(r.host, "strength", "it never yielded\n", "Tresca (1864)");
        r.result(r.host, "ratio", "1", std::nan(""), nullptr, nullptr);
        return gault_status(GAULT_OK);
    };
    const nlohmann::json derived = summary(block())["derived"]["test_program"];
    EXPECT_EQ(tens, (std::vector<double>{0, 10, 20, 30, 40}));
    ASSERT_EQ(times.size(), 5u);
    EXPECT_EQ(times[0], 0.0);
    EXPECT_LT(times[3], times[4]);
    EXPECT_EQ(
        derived,
        (nlohmann::json{
            {"stiffness",
             {{"value", 5e6}, {"unit", "Pa"}, {"source", "Hooke (1678)"}, {"note", "of the unloading"}}},
            {"strength", {{"absent", "it never yielded"}, {"source", "Tresca (1864)"}}},
            {"ratio", {{"absent", "not a finite number"}, {"source", ""}}}}));
}

TEST_F(Derived, ALineOfTheReportSaysWhatEveryResultIs) {
    program.evaluate = [](const gault_history&, gault_report& r, gault_error&) {
        r.result(r.host, "stiffness", "Pa", 5e6, "", "of the unloading");
        r.result(r.host, "ratio", "1", 0.25, "", "");
        r.absent(r.host, "strength", "it never yielded", "");
        return gault_status(GAULT_OK);
    };
    observer.results = {{"error", "1", "", 0.0}};
    observer.evaluate = [](gault_sample& sample, gault_error&) {
        sample.result[0] = 0.125;
        return gault_status(GAULT_OK);
    };
    SmallScene s = block();
    s.scene.observers.push_back({3, observer.use()});
    std::ostringstream said;
    const auto before = spdlog::default_logger();
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_st>(said)));
    spdlog::set_pattern("%v");
    quiet = false;
    summary(s);
    spdlog::set_default_logger(before);
    for (const char* line : {"\ntest_program stiffness: 5e+06 Pa; of the unloading\n",
                             "\ntest_program ratio: 0.25\n", "\ntest_observer error: 0.125\n",
                             "\nnot derived, for reasons that are in summary.json: strength\n"})
        EXPECT_NE(said.str().find(line), std::string::npos) << line << said.str();
}

TEST_F(Derived, AProgramIsAskedOnceAndOnlyWhenItsProtocolIsComplete) {
    int asked = 0;
    program.evaluate = [&](const gault_history&, gault_report&, gault_error&) {
        ++asked;
        return gault_status(GAULT_OK);
    };
    SmallScene s = block();
    EXPECT_FALSE(summary(s)["derived"].contains("test_program")); // it reported nothing
    EXPECT_EQ(asked, 1);
    program.advance = [](gault_step&, gault_error& error) {
        std::strcpy(error.text, "no more");
        return gault_status(GAULT_FAILED);
    };
    EXPECT_NE(failure(s), "done");
    EXPECT_EQ(asked, 1);
}

TEST_F(Derived, AProgramThatReportsNonsenseFailsTheRun) {
    const auto report = [&](const char* first, const char* second) {
        program.evaluate = [=](const gault_history&, gault_report& r, gault_error&) {
            r.result(r.host, first, "1", 1.0, "", "");
            r.absent(r.host, second, "", "");
            return gault_status(GAULT_OK);
        };
        return failure(block());
    };
    EXPECT_TRUE(report("a", "a").ends_with("program 'test_program': results: result 'a' is reported twice"));
    EXPECT_TRUE(report("a", nullptr).ends_with("program 'test_program': results: a result has no name"));
    EXPECT_TRUE(report("A", "b").ends_with("results: a result has the name 'A'; allowed: a-z, then a-z, 0-9 "
                                           "and _"));
    EXPECT_EQ(report("a", "b"), "done");
}

TEST_F(Derived, AProgramThatCannotEvaluateSaysWhy) {
    program.evaluate = [](const gault_history&, gault_report&, gault_error& error) {
        std::strcpy(error.text, "the fit\ndiverged");
        return gault_status(GAULT_FAILED);
    };
    EXPECT_TRUE(failure(block()).ends_with("program 'test_program': results: the fit diverged"));
}

// The points reach from 0 to 1 m.
TEST_F(Derived, AProfileThatCannotBeComparedSaysWhyAndTheRunIsDone) {
    const auto compared = [&](double from, double to) {
        const std::filesystem::path file = folder.string() + ".csv";
        std::ofstream out(file);
        out << "reference_radius_m,sigma_r_Pa,sigma_theta_Pa\n";
        for (int i = 0; i < 5; ++i)
            out << from + 0.25 * i * (to - from) << ",1,1\n";
        out.close();
        SmallScene s = block();
        s.scene.profiles = {{"tens", {{20.0, file}}}};
        const nlohmann::json profile = summary(s)["reference"]["profiles"][0];
        std::filesystem::remove(file);
        return profile;
    };
    EXPECT_TRUE(compared(0.01, 1.0).contains("sigma_r_l2"));
    const nlohmann::json narrow = compared(0.4, 0.6);
    EXPECT_FALSE(narrow.contains("sigma_r_l2"));
    EXPECT_FALSE(narrow["not_compared"].get<std::string>().empty());
    EXPECT_THROW(compared(0.6, 0.4), InputError) << "radii that fall, before the run begins";
}

TEST_F(Derived, AnObserverSeesNoStateWhereTheMaterialLacksIt) {
    soil.states = {{"age", "s", "", GAULT_SCALAR, 0, 7.0, 0.0, 10.0}};
    std::vector<double> field;
    std::vector<int32_t> material;
    std::vector<std::string> names;
    bool unknown_is_null = false;
    observer.fields = {"age", "colour"};
    observer.evaluate = [&](gault_sample& sample, gault_error&) {
        field.assign(sample.field[0], sample.field[0] + sample.count);
        unknown_is_null = sample.field[1] == nullptr;
        material.assign(sample.material, sample.material + sample.count);
        for (const char* const* name = sample.material_name; *name; ++name)
            names.push_back(*name);
        return gault_status(GAULT_OK);
    };
    SmallScene s = block();
    s.add(rock, density, "rock");
    s.scene.regions.push_back({"left", 1, {{0, 0}, {2, 3}}, {}});
    s.scene.observers.push_back({3, observer.use()});
    summary(s);
    EXPECT_TRUE(unknown_is_null);
    EXPECT_EQ(names, (std::vector<std::string>{"soil", "rock"}));
    ASSERT_EQ(field.size(), 12u * 16);
    int rocks = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
        EXPECT_EQ(std::isnan(field[i]), material[i] == 1);
        EXPECT_TRUE(material[i] == 1 || field[i] == 7.0);
        rocks += material[i];
    }
    EXPECT_GT(rocks, 0);
    EXPECT_LT(rocks, 12 * 16);
}

TEST_F(Derived, AnOptionalControlNeedsNoListenerAndReachesTheOnesThatAreThere) {
    for (const bool listens : {false, true}) {
        double heard = -1.0;
        SmallScene s = block();
        TestBoundary other;
        if (listens) other.controls = {{"drive", "1", "", 0.0}};
        other.load = [&](gault_facets& facets) { heard = listens ? facets.control[0] : -2.0; };
        s.add(other, {3});
        program.controls = {{"drive", "1", "", 1.0, GAULT_SIGNAL_OPTIONAL, 0}};
        s.add(program, 3);
        summary(s);
        EXPECT_EQ(heard, listens ? 1.0 : -2.0);
    }
}

TEST_F(Derived, AnOptionalControlHasTheUnitOfItsListener) {
    SmallScene s = block();
    TestBoundary other;
    other.controls = {{"drive", "Pa", "", 0.0}};
    other.load = [](gault_facets&) {};
    s.add(other, {3});
    program.controls = {{"drive", "1", "", 1.0, GAULT_SIGNAL_OPTIONAL, 0}};
    s.add(program, 3);
    EXPECT_THROW(summary(s), InputError);
}

} // namespace
} // namespace gault::core::test
