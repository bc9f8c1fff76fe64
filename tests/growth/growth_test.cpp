// A plugin that was built with SDK 1.0 runs in this host, and so does one that was built with an SDK ahead of it.
#include "core/output/compare.hpp"
#include "core/registry/registry.hpp"
#include "core/scheduler/run.hpp"
#include "tests/contract/scratch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <regex>

using namespace gault::core;
namespace fs = std::filesystem;

namespace {

const fs::path here = GROWTH_DIR, source = GAULT_SOURCE_DIR "/tests/growth";

struct Built {
    std::string sdk, language; // folder of the plugin, and what its components' names begin with
};
void PrintTo(const Built& built, std::ostream* stream) {
    *stream << built.sdk << " " << built.language;
}

// The scene with the components of one plugin, run to its end.
class SceneRun {
  public:
    SceneRun(const Built& built, const std::vector<Override>& overrides) : registry_({here / built.sdk}) {
        const std::string text =
            std::regex_replace(contents(source / "scene.yaml"), std::regex("in_c_"), built.language + "_");
        RunOptions options;
        options.folder = folder_.path / "results";
        options.quiet = true;
        options.threads = 2;
        run_scene(read_scene(folder_.write("scene.yaml", text), overrides, registry_), options);
        history_ = contents(options.folder / "history.csv");
        table_ = read_csv(options.folder / "history.csv");
        const auto derived = nlohmann::json::parse(contents(options.folder / "summary.json"))["derived"];
        seen = derived[built.language + "_witness"];
        results = derived[built.language + "_protocol"];
    }
    const std::string& history() const { return history_; }
    double last(const std::string& column) const { return table_.column(column).back(); }

    nlohmann::json seen, results; // of the observer, of the program

  private:
    Scratch folder_;
    Registry registry_;
    std::string history_;
    CsvTable table_;
};

class PluginOfAnotherSdk : public testing::TestWithParam<Built> {
  protected:
    SceneRun run(const std::vector<Override>& overrides = {}) const {
        return SceneRun(GetParam(), overrides);
    }
};

// In the end: 50 kPa at rest, 300 kPa commanded, less what the spring of 0.1/m of 4 MPa takes; and each layer of 1 m
// as short as its law says, of which the upper one's is checked.
void expect_closed_form(double travel, double pressure) {
    EXPECT_NEAR(pressure, 350e3 - 0.1 * 4e6 * travel, 1e-9 * pressure);
    const double added = pressure - 50e3, lower = std::exp(-added / 24e6), upper = 2.0 - travel - lower;
    EXPECT_NEAR(-added, (4e6 * (upper * upper - 1.0) + 6e6 * std::log(upper)) / upper, 1e-6 * added);
}

} // namespace

INSTANTIATE_TEST_SUITE_P(, PluginOfAnotherSdk,
                         testing::Values(Built{"sdk_1_0", "in_c"}, Built{"sdk_1_0", "in_cpp"},
                                         Built{"later", "in_c"}, Built{"later", "in_cpp"}),
                         [](const auto& built) { return built.param.sdk + "_" + built.param.language; });

TEST_P(PluginOfAnotherSdk, IsToldAndAnswersWhatItIsDueWithoutInertiaAndWithIt) {
    for (const std::vector<Override>& way : {std::vector<Override>{},
                                             {{"model.solver", "explicit"},
                                              {"solver.time_step_factor", "0.5"},
                                              {"materials.upper.viscosity", "1 kPa*s"}}}) {
        const SceneRun r = run(way);
        expect_closed_form(r.last("travel_m"), r.last("true_pressure_Pa"));
        EXPECT_LT(r.seen["stress_error"], 1e-6);
        EXPECT_NEAR(r.seen["height"], 2.0 - r.last("travel_m"), 1e-9);
        EXPECT_NEAR(r.seen["initial_density"], 1800.0, 1e-9);
        EXPECT_EQ(r.seen["cell_length"], 0.5);
        EXPECT_EQ(r.seen["upper_share"], 0.5);
        EXPECT_EQ(r.seen["end"], 3.0);
        EXPECT_EQ(r.seen["size"], 0.5);
        EXPECT_FALSE(r.seen.contains("never"));
        EXPECT_DOUBLE_EQ(r.results["stiffness"]["value"],
                         (r.last("true_pressure_Pa") - 50e3) / r.last("travel_m"));
        EXPECT_EQ(r.results["stiffness"]["note"], "of the first loading");
        EXPECT_EQ(r.results["unloading_stiffness"]["absent"], "it was never unloaded");
    }
}

TEST_P(PluginOfAnotherSdk, HasTheStepsRepeatedThatItAsksToBe) {
    EXPECT_NEAR(run({{"program.until", "20 mm"}}).last("travel_m"), 0.02, 2e-6 * 0.02);
    // The lower soil, of constrained modulus 24 MPa, bears 287 kPa more in the end.
    constexpr double limit = 2e-4, least_steps = 287e3 / 24e6 / limit;
    EXPECT_LT(run().last("step"), least_steps);
    EXPECT_GE(run({{"materials.lower.largest_increment", "0.02 %"}}).last("step"), least_steps);
}

TEST_P(PluginOfAnotherSdk, IsRefusedAtTheLineOfTheParameterThatItBlames) {
    try {
        run({{"materials.lower.stiffness", "2000 GPa"}});
        ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
        EXPECT_TRUE(std::string(e.what()).ends_with("stiffness: is that of no soil")) << e.what();
    }
}

TEST(PluginOfALaterSdk, AnswersToTheBitAsThatOf1_0) {
    for (const char* language : {"in_c", "in_cpp"})
        EXPECT_EQ(SceneRun({"later", language}, {}).history(), SceneRun({"sdk_1_0", language}, {}).history());
}

TEST(PluginOfALaterSdk, ThatNeedsItsMinorIsRefusedInOneSentence) {
    const fs::path file = here / "needs_later/needs_later.so";
    try {
        Registry({file.parent_path()});
        ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
        EXPECT_EQ(e.what(), fmt::format("{}: needs ABI 1.{}; this host offers 1.{}", file.string(),
                                        GAULT_ABI_MINOR + 1, GAULT_ABI_MINOR));
    }
}

TEST(PluginOf1_0, AnswersForItsExtensions) {
    const Registry registry({here / "sdk_1_0"});
    const auto extension = registry.find(GAULT_MATERIAL, "in_c_elastic").declaration->extension;
    struct Pulse {
        double (*rate)(const void*);
    };
    EXPECT_EQ(static_cast<const Pulse*>(extension("pulse/1"))->rate(nullptr), 72.0);
    EXPECT_EQ(extension("pulse/2"), nullptr);
}

// ---- that the record of the layout is whole, and that the plugin in C uses all of it ---------------------

namespace {

std::vector<std::string> all(const std::string& text, const char* pattern) {
    std::vector<std::string> found;
    const std::regex regex(pattern);
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
        found.push_back(match->str(match->size() - 1));
    return found;
}

const std::string layout = contents(source / "layout.inc");

} // namespace

TEST(Layout, RecordsEveryStructAndEveryNumberOfTheContract) {
    const std::string header = contents(GAULT_SOURCE_DIR "/sdk/include/gault/gault.h");
    EXPECT_EQ(all(header, "typedef struct (\\w+) \\{[^\n]*\\[grows\\]"), all(layout, "GROWS\\((\\w+)"));
    EXPECT_EQ(all(header, "typedef struct (\\w+) \\{ /\\* \\[frozen\\]"), all(layout, "FROZEN\\((\\w+)"));
    EXPECT_EQ(all(header, "\\b(GAULT_\\w+) = "), all(layout, "VALUE\\((GAULT_\\w+), \\d+\\)"));
    EXPECT_EQ(all(header, "typedef uint32_t (\\w+);"), all(layout, "WIDTH\\((\\w+)"));
}

TEST(PluginOf1_0, UsesEveryFieldAndEveryNumberOf1_0) {
    std::string text;
    for (const fs::directory_entry& file : fs::directory_iterator(source / "plugin"))
        if (file.path().extension() != ".cpp") text += contents(file.path());
    const auto is_used = [&](const std::string& word) {
        return std::regex_search(text, std::regex("\\b" + word + "\\b"));
    };
    for (const std::string& field : all(layout, "FIELD\\(\\w+, (\\w+), \\d+, \\d+\\)\\n"))
        EXPECT_TRUE(is_used(field) || field == "reserved") << field;
    for (const std::string& name : all(layout, "VALUE\\((\\w+), \\d+\\)\\n"))
        EXPECT_TRUE(is_used(name)) << name;
}
