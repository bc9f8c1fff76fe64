// A third party's plugin: found on every path, described, refused at the line of the scene that is wrong.
#include "tests/app/child.hpp"

#include <fstream>

namespace gault::test {
namespace {

class ThirdParty : public App {
  protected:
    const fs::path plugins = build / "tests/app/plugins";

    // A column of soil under a pressure, line 12 its material.
    void write_scene(const std::string& material, const std::string& more = "") const {
        std::ofstream(work / "scene.yaml")
            << "gault: 1\n"
               "title: A column\n"
               "geometry:\n"
               "  block: {width: 1 m, height: 1 m}\n"
               "model: {symmetry: plane_strain}\n"
               "grid: {cells: [2, 2]}\n"
               "boundaries:\n"
               "  - {on: [left, right, bottom], type: roller}\n"
               "  - {on: top, type: pressure}\n"
               "program: {type: ramp, on: top, pressure: [[0 s, 0 kPa], [10 ms, 1 kPa]]}\n"
               "materials:\n"
            << "  soil: {model: test_soil, density: 1800 kg/m^3, " << material << "}\n"
            << more;
    }

    void expect_run(const Words& more = {}, const Environment& environment = {}) const {
        Words words{"run", "scene.yaml", "-o", "results", "--force"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = gault(words, environment);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto plugins_used = summary(results)["provenance"]["plugins"];
        for (const auto& used : plugins_used)
            if (used["component"] == "test_soil") {
                EXPECT_EQ(used["version"], "3.2.1");
                EXPECT_EQ(used["sha256"].get<std::string>().size(), 64u);
                return;
            }
        FAIL() << "the provenance does not name the plugin";
    }

    const std::string good = "young_modulus: 10 MPa, poisson_ratio: 0.3";
};

TEST_F(ThirdParty, PluginThatIsNowhereIsNotFound) {
    write_scene(good);
    const std::string message = refusal(gault({"run", "scene.yaml"}));
    EXPECT_TRUE(message.starts_with("scene.yaml:12:17: no material is named 'test_soil'")) << message;
}

TEST_F(ThirdParty, PluginIsFoundByOption) {
    write_scene(good);
    expect_run({"--plugin-path", plugins.string()});
    expect_run({"--plugin-path", (plugins / "test_soils.so").string()});
}

TEST_F(ThirdParty, PluginIsFoundByEnvironment) {
    write_scene(good);
    expect_run({}, {{"GAULT_PLUGIN_PATH", plugins.string()}});
    expect_run({}, {{"GAULT_PLUGIN_PATH", (plugins / "test_soils.so").string() + ":" + work.string()}});
}

TEST_F(ThirdParty, PluginIsFoundBesideTheScene) {
    fs::copy(plugins, work / "my plugins", fs::copy_options::recursive);
    write_scene(good, "plugins: [my plugins]\n");
    expect_run();
    fs::create_directory(work / "elsewhere");
    const Outcome outcome = Child(work / "elsewhere", {"check", "../scene.yaml"}).wait();
    EXPECT_EQ(outcome.status, 0) << "relative to the scene, not to the working directory: " << outcome.err;
}

TEST_F(ThirdParty, PathThatLeadsNowhereIsSaidSo) {
    write_scene(good);
    EXPECT_TRUE(has(refusal(gault({"run", "scene.yaml", "--plugin-path", "nowhere"})), "nowhere: "));
    EXPECT_TRUE(has(refusal(gault({"list"}, {{"GAULT_PLUGIN_PATH", "nowhere"}})), "nowhere: "));
}

TEST_F(ThirdParty, FileThatIsNoPluginIsSaidSo) {
    std::ofstream(work / "text.so") << "not a library";
    const std::string message = refusal(gault({"list", "--plugin-path", "text.so"}));
    EXPECT_TRUE(has(message, "text.so: ")) << message;
}

TEST_F(ThirdParty, InvalidParameterIsShownWhereItStands) {
    write_scene(good + ", strength: 20 MPa");
    const std::string message = refusal(gault({"run", "scene.yaml", "--plugin-path", plugins.string()}));
    EXPECT_TRUE(message.starts_with("scene.yaml:12:103: ")) << message;
    EXPECT_TRUE(has(message, "strength")) << message;
    EXPECT_TRUE(has(message, "is above young_modulus")) << message;
    EXPECT_FALSE(fs::exists(work / "out"));
}

TEST_F(ThirdParty, MistypedParameterGetsTheNearestName) {
    write_scene(good + ", strenght: 20 MPa");
    const std::string message = refusal(gault({"check", "scene.yaml", "--plugin-path", plugins.string()}));
    EXPECT_TRUE(message.starts_with("scene.yaml:12:93: ")) << message;
    EXPECT_TRUE(has(message, "did you mean 'strength'?")) << message;
}

TEST_F(ThirdParty, PluginIsDescribedLikeAnyOther) {
    const std::string text = gault({"describe", "test_soil", "--plugin-path", plugins.string()}).out;
    for (const char* part :
         {"material test_soil 3.2.1", "A third party", "said_share", "breaks_after", "Young's modulus."})
        EXPECT_TRUE(has(text, part)) << part << "\n" << text;
}

} // namespace
} // namespace gault::test
