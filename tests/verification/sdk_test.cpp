// What the C++ wrappers promise to both sides of the contract.
#include "program_fixture.hpp"

#include <gault/material.hpp>
#include <gault/program.hpp>

#include <gtest/gtest.h>

namespace {

struct Hold {
    static constexpr const char* name = "hold";
    static constexpr const char* doc = "Waits.";
    double time;
    static constexpr std::array parameters{
        gault::parameter<&Hold::time>("time", "", "s", "How long.").above(0)};
};
struct Stretch {
    static constexpr const char* name = "stretch";
    static constexpr const char* doc = "Pulls.";
    double strain;
    std::optional<double> rate;
    static constexpr std::array parameters{
        gault::parameter<&Stretch::strain>("strain", "", "1", "How far."),
        gault::parameter<&Stretch::rate>("rate", "", "1/s", "How fast.").above(0)};
};

// Fails where strain xx is above `limit`, asks for less where strain yy is, throws where strain zz is.
struct Fragile {
    static constexpr const char* name = "fragile";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "For tests.";

    enum class Mode { soft, hard };
    static constexpr const char* modes[] = {"soft", "hard", nullptr};

    double limit, half, fraction;
    int count;
    bool loud;
    Mode mode;
    std::string label;
    std::vector<double> numbers;
    gault::Table table;
    gault::Records<Hold, Stretch> phases;

    static constexpr std::array parameters{
        gault::parameter<&Fragile::limit>("limit", "l", "1", "Largest strain.").above(0).at_most(1),
        gault::parameter<&Fragile::count>("count", "", "1", "A number.").fallback(3),
        gault::parameter<&Fragile::loud>("loud", "", "1", "A flag.").fallback(1),
        gault::parameter<&Fragile::mode>("mode", "", "1", "A choice.").choices(modes).fallback(1),
        gault::parameter<&Fragile::label>("label", "", "", "A text.").optional(),
        gault::parameter<&Fragile::numbers>("numbers", "", "Pa", "A list.").optional(),
        gault::table<&Fragile::table>("table", "s", "Pa", "A table.").optional(),
        gault::parameter<&Fragile::phases>("phases", "", "1", "Records.").optional(),
        gault::parameter<&Fragile::fraction>("fraction", "", "1", "Of a step.").fallback(0.5)};
    static constexpr std::array states{gault::symmetric_state("back_stress", "Pa", "Kept."),
                                       gault::scalar_state("steps", "1", "Counted.", 0.0, 0.0)};
    static constexpr int steps = gault::state_index(states, "steps");

    void prepare() {
        if (limit == 0.5) throw gault::Invalid("limit", "is unlucky");
        if (count == 13) throw std::runtime_error("out of luck");
        half = 0.5 * limit;
    }
    void update(gault::Point& p) const {
        p.fail(p.strain[0] > limit, "torn");
        p.retry(p.strain[1] > limit, fraction);
        p.retry(p.strain[1] > 2.0 * limit, 0.25);
        if (any(p.strain[2] > limit)) throw std::runtime_error("burst");
        p.set_state(steps, p.state_old(steps) + 1.0);
        p.modulus = p.shear_modulus = 1.0;
    }
};
constexpr gault_module module = gault::detail::module<gault::Material<Fragile>>("m", "1.0.0", "a", "MIT");
static_assert(module.components[0]->kind == GAULT_MATERIAL && module.magic == GAULT_MAGIC);
static_assert(Fragile::steps == 6);

using plugin_test::Batch;
using plugin_test::Component;
using plugin_test::Points;
using plugin_test::Record;
using plugin_test::Settings;

Component fragile(Settings settings = {}) {
    settings.try_emplace("limit", 0.1);
    return {module, GAULT_MATERIAL, "fragile", settings};
}

TEST(Wrapper, DeclaresBoundsDefaultsAndWhatIsRequired) {
    const gault_parameter& limit = *module.components[0]->parameters[0];
    EXPECT_EQ(limit.type, uint32_t{GAULT_REAL});
    EXPECT_EQ(limit.flags, uint32_t{GAULT_REQUIRED | GAULT_MIN_OPEN});
    EXPECT_EQ(limit.min, 0.0);
    EXPECT_EQ(limit.max, 1.0);
    const gault_parameter& count = *module.components[0]->parameters[1];
    EXPECT_EQ(count.type, uint32_t{GAULT_INTEGER});
    EXPECT_EQ(count.flags, 0u);
    EXPECT_EQ(count.fallback, 3.0);
    EXPECT_EQ(count.min, std::numeric_limits<int>::min());
    EXPECT_EQ(count.max, std::numeric_limits<int>::max());
    EXPECT_STREQ(module.components[0]->parameters[7]->kinds[1]->name, "stretch");
    EXPECT_EQ(module.components[0]->parameters[9], nullptr);
}

TEST(Wrapper, BindsEveryTypeOfParameterToItsMember) {
    const Component c = fragile({{"label", "clay"},
                                 {"table", Points{{0.0, 1.0}, {2.0, 5.0}}},
                                 {"phases", std::vector<Record>{{"stretch", {{"strain", 0.1}, {"rate", 2.0}}},
                                                                {"hold", {{"time", 3.0}}},
                                                                {"stretch", {{"strain", 0.2}}}}}});
    const auto& model = *static_cast<const Fragile*>(c.self());
    EXPECT_EQ(model.half, 0.05);
    EXPECT_EQ(model.count, 3);
    EXPECT_TRUE(model.loud);
    EXPECT_EQ(model.mode, Fragile::Mode::hard);
    EXPECT_EQ(model.label, "clay");
    EXPECT_TRUE(model.numbers.empty());
    EXPECT_EQ(model.table.linear(1.0), 3.0);
    ASSERT_EQ(model.phases.size(), 3u);
    EXPECT_EQ(std::get<Stretch>(model.phases[0]).rate, 2.0);
    EXPECT_EQ(std::get<Hold>(model.phases[1]).time, 3.0);
    EXPECT_EQ(std::get<Stretch>(model.phases[2]).rate, std::nullopt);
}

TEST(Wrapper, NamesTheInvalidParameter) {
    try {
        fragile({{"limit", 0.5}});
        FAIL() << "accepted";
    } catch (const plugin_test::Invalid& e) {
        EXPECT_EQ(e.parameter, "limit");
        EXPECT_STREQ(e.what(), "is unlucky");
    }
}

TEST(Wrapper, LetsNoExceptionLeave) {
    try {
        fragile({{"count", 13}});
        FAIL() << "accepted";
    } catch (const plugin_test::Invalid& e) {
        EXPECT_STREQ(e.what(), "out of luck");
    }
    const Component c = fragile();
    Batch b(c, 3);
    b.strain[2][1] = 1.0;
    EXPECT_EQ(b.update(), GAULT_FAILED);
    EXPECT_STREQ(b.error.text, "burst");
}

TEST(Wrapper, ReportsTheFirstFailingPoint) {
    const Component c = fragile();
    Batch b(c, 21);
    b.strain[0][20] = b.strain[0][13] = 1.0;
    EXPECT_EQ(b.update(), GAULT_FAILED);
    EXPECT_EQ(b.error.point, 13);
    EXPECT_STREQ(b.error.text, "torn");
}

TEST(Wrapper, IgnoresWhatHappensBeyondTheLastPoint) {
    const Component c = fragile();
    Batch b(c, 3);
    b.strain[0][3] = b.strain[1][4] = 1.0;
    EXPECT_EQ(b.update(), GAULT_OK);
}

TEST(Wrapper, AsksForTheSmallestOfTheStepsThatPointsWant) {
    const Component c = fragile();
    Batch b(c, 20);
    b.strain[1][2] = 0.15;
    EXPECT_EQ(b.update(), GAULT_RETRY);
    EXPECT_EQ(b.suggested(), 0.5);
    b.strain[1][11] = 0.3;
    EXPECT_EQ(b.update(), GAULT_RETRY);
    EXPECT_EQ(b.suggested(), 0.25);
}

// Records the square of the time; derives its mean slope, or says that there is none.
struct Parabola {
    static constexpr const char* name = "parabola";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "For tests.";
    static constexpr std::array controls{gault::signal("speed", "m/s", "Needed."),
                                         gault::optional(gault::signal("drive", "1", "Not needed.", 1.0))};
    static constexpr std::array records{gault::signal("square", "s^2", "Of the time.")};
    void advance(gault::Step& step) const {
        step.record(0) = step.time() * step.time();
        step.emit();
    }
    void evaluate(const gault::History& history, gault::Report& report) const {
        const int64_t last = history.rows() - 1;
        if (last < 1) return report.absent("slope", "too few rows: " + std::to_string(last + 1), "Euclid");
        if (history.time(last) > 100.0) throw std::runtime_error("too late");
        report.result("slope", "s", (history.record(0, last) - history.record(0, 0)) / history.time(last),
                      "Newton", "a mean");
    }
};
constexpr gault_module programs = gault::detail::module<gault::Program<Parabola>>("p", "1.0.0", "a", "MIT");

TEST(Wrapper, LetsAProgramDeriveResultsFromItsHistory) {
    const Component c(programs, GAULT_PROGRAM, "parabola", {});
    plugin_test::ProgramRun run(c);
    EXPECT_EQ(run.evaluate().at("slope").reason, "too few rows: 0");
    for (const double time : {0.0, 1.0, 3.0}) {
        run.time = time;
        ASSERT_EQ(run.advance(1.0), GAULT_OK);
    }
    const auto results = run.evaluate();
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results.at("slope").value, 3.0);
    EXPECT_EQ(results.at("slope").unit, "s");
    EXPECT_EQ(results.at("slope").source, "Newton");
    EXPECT_EQ(results.at("slope").note, "a mean");
    run.times.back() = 300.0;
    EXPECT_THROW(run.evaluate(), std::runtime_error);
    EXPECT_STREQ(run.error.text, "too late");
}

TEST(Wrapper, SaysWhichControlsNeedNoListener) {
    const auto& signals = *static_cast<const gault_program_api*>(programs.components[0]->api)->signals;
    EXPECT_EQ(signals.controls[0].flags, 0u);
    EXPECT_EQ(signals.controls[1].flags, +GAULT_SIGNAL_OPTIONAL);
    EXPECT_EQ(signals.controls[1].initial, 1.0);
}

TEST(Wrapper, AsksForHalfAStepWhereTheFractionIsNone) {
    for (const double fraction : {0.0, 1.0, 7.0, std::nan("")}) {
        const Component c = fragile({{"fraction", fraction}});
        Batch b(c, 3);
        b.strain[1][1] = 0.15;
        EXPECT_EQ(b.update(), GAULT_RETRY) << fraction;
        EXPECT_EQ(b.suggested(), 0.5) << fraction;
    }
}

TEST(Wrapper, KeepsStatesAndStressThatAModelLeavesAlone) {
    const Component c = fragile();
    Batch b(c, 9);
    for (int k = 0; k < 6; ++k)
        b.state_old[k][8] = k, b.stress_old[k][8] = -k;
    ASSERT_EQ(b.update(), GAULT_OK);
    for (int k = 0; k < 6; ++k) {
        EXPECT_EQ(b.state[k][8], k);
        EXPECT_EQ(b.stress[k][8], -k);
    }
    EXPECT_EQ(b.state[6][8], 1.0);
}

TEST(Table, IsMonotonicBetweenRisingPoints) {
    const gault::Table table{{0.0, 1.0, 3.0}, {0.0, 1.0, 2.0}};
    double before = -1.0;
    for (int i = 0; i <= 300; ++i) {
        const double now = table.smooth(0.01 * i);
        EXPECT_GE(now, before);
        before = now;
    }
    EXPECT_EQ(before, 2.0);
}

} // namespace
