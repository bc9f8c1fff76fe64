#include "core/config/reader.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include <unistd.h>

namespace gault::core {
namespace {

namespace fs = std::filesystem;

const Registry& registry() {
    static const Registry components({GAULT_BINARY_DIR "/tests/plugins/test_components.so"});
    return components;
}

const std::string folder = GAULT_SOURCE_DIR "/tests/bad_scenes/good/";

Scene read(const std::string& name, const std::vector<Override>& overrides = {}) {
    return read_scene(folder + name + ".yaml", overrides, registry());
}

std::string refusal(const std::string& name, const std::vector<Override>& overrides) {
    try {
        read(name, overrides);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

const gault_value& value(const ComponentUse& use, const std::string& name) {
    for (std::size_t i = 0; use.component->declaration->parameters[i] != nullptr; ++i)
        if (use.component->declaration->parameters[i]->name == name) return use.parameters.values[i];
    throw std::out_of_range(name);
}

std::vector<std::string> names(const std::vector<SurfaceUse>& surfaces) {
    std::vector<std::string> all;
    for (const SurfaceUse& surface : surfaces)
        all.push_back(surface.name);
    return all;
}

TEST(Scene, HoldsItsGeometryInMetres) {
    const Scene ring = read("annulus");
    EXPECT_EQ(ring.geometry.kind, "annulus");
    EXPECT_EQ(ring.geometry.lower, (std::array{0.02, -0.05}));
    EXPECT_DOUBLE_EQ(ring.geometry.upper[0], 0.2);
    EXPECT_DOUBLE_EQ(ring.geometry.upper[1], 0.15);
    EXPECT_EQ(names(ring.surfaces), (std::vector<std::string>{"inner", "outer", "bottom", "top"}));
    EXPECT_EQ(ring.symmetry, Symmetry::axisymmetric);

    const Scene block = read("block");
    EXPECT_EQ(block.geometry.lower, (std::array{-1.0, 0.0}));
    EXPECT_EQ(block.geometry.upper, (std::array{1.0, 1.0}));
    EXPECT_EQ(names(block.surfaces), (std::vector<std::string>{"left", "right", "bottom", "top"}));
    EXPECT_EQ(block.symmetry, Symmetry::plane_strain);

    const Scene cylinder = read("cylinder");
    EXPECT_EQ(cylinder.geometry.lower, (std::array{0.0, 0.0}));
    EXPECT_EQ(cylinder.surfaces[0].name, "axis");
}

TEST(Scene, CountsThePartsAfterTheSides) {
    const Scene scene = read("parts");
    EXPECT_EQ(names(scene.surfaces), (std::vector<std::string>{"inner", "outer", "bottom", "top", "membrane",
                                                               "casing", "collar", "rim", "band"}));
    for (int side = 0; side < 4; ++side) {
        EXPECT_EQ(scene.surfaces[static_cast<std::size_t>(side)].side, side);
        EXPECT_FALSE(scene.surfaces[static_cast<std::size_t>(side)].cells);
    }
    const auto part = [&](int index) { return scene.surfaces[static_cast<std::size_t>(index)]; };
    EXPECT_EQ(part(4).side, 0);
    EXPECT_EQ(part(4).cells, (std::array{0, 2}));
    EXPECT_EQ(part(5).cells, (std::array{2, 3}));
    EXPECT_EQ(part(6).side, 3);
    EXPECT_EQ(part(6).cells, (std::array{0, 2}));
    EXPECT_EQ(part(7).cells, (std::array{2, 3}));
    EXPECT_EQ(part(8).side, 1);
    EXPECT_EQ(part(8).cells, (std::array{1, 2}));
    EXPECT_EQ(scene.boundaries[0].surfaces, (std::vector<int>{1, 7}));
    EXPECT_EQ(scene.boundaries[2].surfaces, (std::vector<int>{5, 4}));
    EXPECT_EQ(scene.program_surface, 4);
    EXPECT_NEAR(scene.program_gauge.value(), 0.2, 1e-15);
    EXPECT_EQ(scene.observers[0].surface, 8);
    EXPECT_FALSE(read("annulus").program_gauge);
}

TEST(Scene, NamesTheKnotsNearestToAnEndOfAPart) {
    EXPECT_NE(refusal("parts", {{"geometry.parts.casing.y.0", "0.3 m"}}).find("nearest: 0.2 m and 0.6 m"),
              std::string::npos);
    EXPECT_EQ(refusal("parts", {{"grid.grading.y", "1.9"}}).substr(folder.size(), 15), "parts.yaml:7:40");
}

TEST(Scene, HasAsManyPartsAsThereAreBits) {
    std::vector<Override> changes;
    while (changes.size() < 44)
        changes.push_back(
            {"geometry.parts.p" + std::to_string(changes.size()) + "x", "{of: inner, y: [0, 200 mm]}"});
    EXPECT_NE(refusal("parts", changes).find("geometry.parts has 49 parts; allowed: 48"), std::string::npos);
    changes.pop_back();
    EXPECT_EQ(refusal("parts", changes), "accepted");
}

Scene read_radial(std::vector<Override> changes) {
    changes.insert(changes.begin(), {{"model.symmetry", "radial"}, {"points.per_cell", "auto"}});
    return read("plain", changes);
}

TEST(Scene, OfRadialSymmetryIsAMetreHigh) {
    const Scene scene = read_radial({{"geometry.annulus.bottom", "3 m"}});
    EXPECT_EQ(scene.symmetry, Symmetry::radial);
    EXPECT_EQ(scene.geometry.lower, (std::array{0.02, 0.0}));
    EXPECT_EQ(scene.geometry.upper, (std::array{0.2, 1.0}));
}

TEST(Scene, TakesOneNumberOfCellsForOneRow) {
    for (const char* cells : {"24", "[24, 1]"}) {
        const Scene scene = read_radial({{"grid.cells", cells}});
        EXPECT_EQ(scene.axes[0].cells, 24) << cells;
        EXPECT_EQ(scene.axes[1].cells, 1) << cells;
    }
    EXPECT_EQ(refusal("plain", {{"model.symmetry", "radial"}, {"grid.cells", "[12, 2]"}}),
              "--set grid.cells: grid.cells: radial symmetry has one row of cells; found '2'");
    EXPECT_EQ(read("plain", {{"grid.cells", "12"}}).axes[1].cells, 1) << "one number is one row";
}

TEST(Scene, OfRadialSymmetryCountsPointsAlongTheRadius) {
    EXPECT_EQ(read_radial({}).points_per_cell, 4);
    for (const char* count : {"1", "2", "3", "4", "5", "6"})
        EXPECT_EQ(read_radial({{"points.per_cell", count}}).points_per_cell, std::stoi(count));
    for (const char* count : {"0", "7", "9"})
        EXPECT_EQ(refusal("plain", {{"model.symmetry", "radial"}, {"points.per_cell", count}}),
                  "--set points.per_cell: points.per_cell is '" + std::string(count) +
                      "'; allowed along the radius: 1, 2, 3, 4, 5, 6");
}

TEST(Scene, OfRadialSymmetryHasAnAxis) {
    EXPECT_EQ(refusal("block", {{"model.symmetry", "radial"}}),
              "--set model.symmetry: model.symmetry: a block has no axis; use the geometry annulus or "
              "cylinder, or plane_strain");
}

TEST(Scene, GeometricGradingMultipliesRadiiByTheSameFactor) {
    const Scene ring = read("annulus");
    EXPECT_EQ(ring.axes[0].cells, 12);
    EXPECT_NEAR(std::pow(ring.axes[0].ratio, 12), 10.0, 1e-12);
    EXPECT_EQ(ring.axes[1].ratio, 1.1);
}

TEST(Scene, HoldsParametersOfEveryType) {
    const Scene scene = read("annulus");
    ASSERT_EQ(scene.materials.front().name, "sand");
    const ComponentUse& sand = scene.materials.front().model;
    EXPECT_EQ(scene.materials.front().density, 1650.0);
    EXPECT_EQ(value(sand, "stiffness").real, 100e6);
    EXPECT_EQ(value(sand, "stiffness").count, 1);
    EXPECT_DOUBLE_EQ(value(sand, "angle").real, 48.0 * std::acos(-1.0) / 180.0);
    EXPECT_EQ(value(sand, "count").integer, 4);
    EXPECT_EQ(value(sand, "count").real, 4.0);
    EXPECT_EQ(value(sand, "drained").integer, 0);
    EXPECT_STREQ(value(sand, "shape").text, "round");
    EXPECT_EQ(value(sand, "shape").integer, 0);
    EXPECT_STREQ(value(sand, "label").text, "a: \"quoted\" text");
    ASSERT_EQ(value(sand, "properties").count, 2);
    EXPECT_EQ(value(sand, "properties").y[1], 2e3);
    ASSERT_EQ(value(sand, "curve").count, 3);
    EXPECT_EQ(value(sand, "curve").x[1], 0.01);
    EXPECT_EQ(value(sand, "curve").y[1], 2e3);
}

TEST(Scene, FillsInDeclaredDefaults) {
    const Scene scene = read("cylinder");
    const ComponentUse& clay = scene.materials.front().model;
    EXPECT_EQ(value(clay, "ratio").real, 0.25);
    EXPECT_EQ(value(clay, "count").integer, 3);
    EXPECT_EQ(value(clay, "drained").integer, 1);
    EXPECT_STREQ(value(clay, "shape").text, "square");
    EXPECT_EQ(value(clay, "limit").count, 0) << "optional, so absent";
    EXPECT_EQ(value(clay, "label").count, 0);
    EXPECT_STREQ(value(clay, "label").text, "");
    EXPECT_EQ(value(clay, "curve").count, 0);
}

TEST(Scene, ReadsRecordsInTheirOrder) {
    const Scene scene = read("annulus");
    const gault_value& phases = value(scene.program, "phases");
    ASSERT_EQ(phases.count, 5);
    EXPECT_EQ(phases.items[0].kind, 0);
    EXPECT_EQ(phases.items[0].values[0].real, 1e-3);
    EXPECT_EQ(phases.items[0].values[1].real, 10.0);
    EXPECT_EQ(phases.items[1].kind, 1) << "reach: 10 %, the short form";
    EXPECT_EQ(phases.items[1].values[0].real, 0.1);
    EXPECT_EQ(phases.items[2].kind, 2) << "rest, a bare word";
    EXPECT_EQ(phases.items[3].kind, 3);
    EXPECT_EQ(phases.items[3].values[0].integer, 2);
    ASSERT_EQ(phases.items[3].values[1].count, 2);
    EXPECT_EQ(phases.items[3].values[1].items[0].values[0].real, 0.05);
    EXPECT_EQ(phases.items[4].kind, 4) << "group: {reach: 8 %}, the short form of records";
    EXPECT_EQ(phases.items[4].values[0].items[0].values[0].real, 0.08);
}

TEST(Scene, ValuesSurviveAMove) {
    Scene scene = read("annulus");
    const Scene moved = std::move(scene);
    EXPECT_STREQ(value(moved.materials.front().model, "shape").text, "round");
    EXPECT_EQ(value(moved.program, "phases").items[4].values[0].items[0].values[0].real, 0.08);
}

TEST(Scene, RemembersWhereEachParameterWasWritten) {
    const Scene ring = read("annulus");
    const Parameters& sand = ring.materials.front().model.parameters;
    EXPECT_EQ(sand.locations[0].line, 13);
    EXPECT_EQ(sand.locations[0].column, 16);
    EXPECT_EQ(sand.locations[0].file, folder + "annulus.yaml");
    const Scene cylinder = read("cylinder");
    const Parameters& clay = cylinder.materials.front().model.parameters;
    EXPECT_EQ(clay.locations[1].text(), clay.where.text()) << "a default stands where its component does";
}

TEST(Scene, RegionsMakeMaterialsOfTheirOwn) {
    const Scene scene = read("annulus");
    ASSERT_EQ(scene.materials.size(), 4u);
    EXPECT_EQ(scene.base_material, 0);
    ASSERT_EQ(scene.regions.size(), 3u);
    const MaterialUse& disturbed = scene.materials[2];
    EXPECT_EQ(disturbed.name, "disturbed");
    EXPECT_EQ(scene.regions[0].material, 2);
    EXPECT_EQ(value(disturbed.model, "stiffness").real, 50e6);
    EXPECT_EQ(value(disturbed.model, "ratio").real, 0.3) << "as the soil's";
    EXPECT_EQ(disturbed.density, 1650.0);
    EXPECT_EQ(scene.regions[1].material, 1);
    EXPECT_EQ(scene.regions[1].cells.first, (std::array{0, 0})) << "the whole width";
    EXPECT_EQ(scene.regions[1].cells.last, (std::array{12, 1}));
    EXPECT_EQ(scene.materials[3].density, 1700.0);
    EXPECT_EQ(value(scene.materials[3].model, "stiffness").real, 5e6) << "as the material named";
}

TEST(Scene, RegionsHoldTheCellsWhoseCentresTheyHold) {
    // Eight equal cells from -1 m to 1 m: centres at -0.875 m, -0.625 m, ...
    const auto cells = [](const std::string& extent) {
        const std::vector<Override> changes{{"grid.grading.x", "1"}, {"regions.1.x", extent}};
        const CellRange range = read("block", changes).regions[1].cells;
        return std::array{range.first[0], range.last[0]};
    };
    EXPECT_EQ(cells("[-0.12 m, 1 m]"), (std::array{4, 8}));
    EXPECT_EQ(cells("[-0.13 m, 1 m]"), (std::array{3, 8}));
    EXPECT_EQ(cells("[-0.13 m, 10 m]"), (std::array{3, 8})) << "what lies outside counts for nothing";
}

TEST(Scene, NeedsNoSoilWhereRegionsCoverEveryCell) {
    EXPECT_EQ(read("block").base_material, 0);
}

TEST(Scene, GravityPointsDownAndStressFollowsIt) {
    const Scene scene = read("annulus");
    EXPECT_EQ(scene.gravity, (std::array{0.0, -9.81}));
    EXPECT_TRUE(scene.initial_stress.gravity);
    EXPECT_EQ(scene.initial_stress.k0, 0.5);
    EXPECT_EQ(scene.initial_stress.depth, 2.0);
    EXPECT_EQ(scene.initial_stress.vertical, 10e3);
}

TEST(Scene, StressWithoutGravityIsTheSameEverywhere) {
    const InitialStress isotropic = read("plain").initial_stress;
    EXPECT_FALSE(isotropic.gravity);
    EXPECT_EQ(isotropic.vertical, 90e3);
    EXPECT_EQ(isotropic.k0, 1.0);
    const InitialStress vertical = read("block").initial_stress;
    EXPECT_FALSE(vertical.gravity);
    EXPECT_EQ(vertical.vertical, 100e3);
    EXPECT_EQ(vertical.k0, 0.5);
    EXPECT_EQ(read("cylinder").initial_stress.vertical, 0.0);
}

TEST(Scene, NamesSurfacesByTheirIndex) {
    const Scene scene = read("annulus");
    ASSERT_EQ(scene.boundaries.size(), 3u);
    EXPECT_EQ(scene.boundaries[0].surfaces, std::vector<int>{1});
    EXPECT_EQ(scene.boundaries[1].surfaces, (std::vector<int>{3, 2}));
    EXPECT_EQ(scene.program_surface, 0);
    EXPECT_EQ(read("block").program_surface, std::nullopt);
}

TEST(Scene, HoldsSolverOutputAndReference) {
    const Scene scene = read("annulus");
    EXPECT_EQ(scene.solver.time_step_factor, 0.5);
    EXPECT_EQ(scene.solver.damping, 0.05);
    EXPECT_EQ(scene.solver.stress_update, StressUpdate::usf);
    EXPECT_EQ(scene.frames.measure, "wall_strain");
    EXPECT_EQ(scene.frames.values, (std::vector{0.025, 0.1}));
    ASSERT_EQ(scene.curves.size(), 1u);
    EXPECT_EQ(scene.curves[0].y, "wall_pressure");
    EXPECT_EQ(scene.curves[0].file, fs::path(folder) / "curve.csv");
    EXPECT_EQ(scene.curves[0].from, 0.005);
    EXPECT_EQ(scene.curves[0].noise, (std::array{0.04, 0.1}));
    ASSERT_EQ(scene.profiles.size(), 1u);
    ASSERT_EQ(scene.profiles[0].at.size(), 2u);
    EXPECT_EQ(scene.profiles[0].at[1].value, 0.1);
    ASSERT_EQ(scene.observers.size(), 1u);
    EXPECT_EQ(scene.observers[0].surface, 0);
}

TEST(Scene, ReadsFramesInTheUnitOfARecordThatDependsOnParameters) {
    const Scene scene = read("block");
    EXPECT_EQ(scene.frames.measure, "late_pressure");
    EXPECT_EQ(scene.frames.values, std::vector{10e3});
}

TEST(Scene, TakesTheLeastThatIsEnoughAndSaysWhy) {
    const Scene scene = read("cylinder");
    EXPECT_EQ(scene.frame, Frame::total);
    EXPECT_EQ(scene.basis, Basis::quadratic);
    EXPECT_EQ(scene.points_per_cell, 16);
    EXPECT_EQ(scene.placement, Placement::gauss);
    EXPECT_EQ(scene.frames.measure, "");
    EXPECT_EQ(scene.title, "cylinder");
    std::vector<std::string> said;
    for (const Choice& choice : scene.chosen)
        said.push_back(choice.key + ": " + choice.value + " (" + choice.reason + ")");
    EXPECT_EQ(said, (std::vector<std::string>{
                        "title: cylinder (the name of the file)",
                        "model.symmetry: axisymmetric (the geometry is a cylinder)",
                        "model.frame: total (material stays in place)",
                        "model.solver: explicit (nothing is assumed about inertia)",
                        "model.volumetric_strain: pointwise (the strain of every point is its own)",
                        "grid.grading.r: 1 (equal cells)", "grid.grading.y: 1 (equal cells)",
                        "grid.basis: quadratic (smooth gradients, so no noise where points cross cells)",
                        "points.per_cell: 16 (four a direction)",
                        "points.placement: gauss (mass and forces are integrated as surface loads are)",
                        "initial.stress: 0 Pa (nothing is said)",
                        "solver.strain_step: 0.005 (no pilot run is made)",
                        "output.frames: the last state (none are asked for)"}));
}

TEST(Scene, HasVolumesOfCellsWhereTheSolverIsNotExplicit) {
    const Override mean{"model.volumetric_strain", "cell_mean"};
    EXPECT_EQ(refusal("plain", {mean}), "accepted"); // the solver is still to be chosen
    EXPECT_EQ(refusal("plain", {mean, {"model.solver", "quasi_static"}}), "accepted");
    EXPECT_NE(refusal("plain", {mean, {"model.solver", "explicit"}})
                  .find("the explicit solver has it pointwise only"),
              std::string::npos);
}

TEST(Scene, PlacesPointsUniformlyWhenAsked) {
    EXPECT_EQ(read("plain").placement, Placement::gauss);
    EXPECT_EQ(read("plain", {{"points.placement", "uniform"}}).placement, Placement::uniform);
}

TEST(Override, ReplacesAnyKey) {
    const Scene scene = read("plain", {{"materials.sand.stiffness", "46 MPa"},
                                       {"boundaries.0.value", "150 kPa"},
                                       {"grid.cells.0", "24"},
                                       {"boundaries.1.on", "[bottom]"}});
    EXPECT_EQ(value(scene.materials[0].model, "stiffness").real, 46e6);
    EXPECT_EQ(value(scene.boundaries[0].model, "value").real, 150e3);
    EXPECT_EQ(scene.axes[0].cells, 24);
    EXPECT_EQ(scene.boundaries[1].surfaces, std::vector<int>{2});
}

TEST(Override, MakesKeysThatAreAbsent) {
    const Scene scene = read("plain", {{"solver.damping", "0.1"}, {"grid.grading.r", "1"}});
    EXPECT_EQ(scene.solver.damping, 0.1);
    EXPECT_EQ(scene.axes[0].ratio, 1.0);
}

TEST(Override, LaterOnesWin) {
    EXPECT_EQ(read("plain", {{"points.per_cell", "9"}, {"points.per_cell", "25"}}).points_per_cell, 25);
}

TEST(Override, IsPartOfTheSceneAsRun) {
    const Scene scene = read("plain", {{"materials.sand.stiffness", "46 MPa"}, {"title", "'null'"}});
    const Scene again = config::read_scene_text(scene.yaml, scene.file, {}, registry());
    EXPECT_EQ(value(again.materials[0].model, "stiffness").real, 46e6);
    EXPECT_EQ(again.title, "null");
    EXPECT_EQ(again.yaml, scene.yaml);
}

TEST(Override, IsWhereItsErrorsAre) {
    EXPECT_EQ(refusal("plain", {{"materials.sand.stiffness", "46 Mpa"}}),
              "--set materials.sand.stiffness: materials.sand.stiffness: '46 Mpa': 'Mpa' is not a unit; did "
              "you mean 'MPa' or "
              "'mPa'?");
    EXPECT_EQ(refusal("plain", {{"materials.sand.stifness", "46 MPa"}})
                  .find("--set materials.sand.stifness: unknown key 'stifness' in materials.sand; did you "
                        "mean 'stiffness'?"),
              0u);
}

TEST(Override, RefusesWhatIsNotThere) {
    EXPECT_EQ(refusal("plain", {{"boundaries.7.value", "1 kPa"}}),
              "--set boundaries.7.value: boundaries is a list, items 0 to 2, of which the last would be new; "
              "found '7'");
    EXPECT_EQ(refusal("plain", {{"boundaries.outer.value", "1 kPa"}}),
              "--set boundaries.outer.value: boundaries is a list, items 0 to 2, of which the last would be "
              "new; found 'outer'");
    EXPECT_EQ(refusal("plain", {{"boundaries.-1.value", "1 kPa"}}),
              "--set boundaries.-1.value: boundaries is a list, items 0 to 2, of which the last would be "
              "new; found '-1'");
    EXPECT_EQ(refusal("plain", {{"title.text", "x"}}),
              "--set title.text: title is a single value, 'A ring'; it has no 'text'");
    EXPECT_EQ(refusal("plain", {{"a..b", "1"}}),
              "--set a..b: a key is words with dots between them, like grid.cells.0");
    EXPECT_EQ(refusal("plain", {{"", "1"}}),
              "--set : a key is words with dots between them, like grid.cells.0");
}

TEST(Override, RefusesAValueThatIsNotYaml) {
    EXPECT_EQ(refusal("plain", {{"grid.cells", "[1, 2"}}).find("--set grid.cells: position 1:"), 0u);
    EXPECT_EQ(refusal("plain", {{"grid.cells", ""}}), "--set grid.cells: grid.cells has no value");
}

class ScenePlugins : public testing::Test {
  protected:
    fs::path file =
        fs::path(testing::TempDir()) / ("gault-scene-plugins-" + std::to_string(getpid())) / "scene.yaml";
    void SetUp() override {
        fs::create_directories(file.parent_path() / "mine");
        std::ofstream(file.parent_path() / "other.so");
    }
    void TearDown() override { fs::remove_all(file.parent_path()); }
    std::vector<fs::path> plugins_of(const std::string& text, const std::vector<Override>& overrides = {}) {
        std::ofstream(file) << text;
        return scene_plugins(file, overrides);
    }
};

TEST_F(ScenePlugins, AreRelativeToTheScene) {
    EXPECT_EQ(plugins_of("plugins: [mine, other.so]\n"),
              (std::vector{file.parent_path() / "mine", file.parent_path() / "other.so"}));
    EXPECT_EQ(plugins_of("plugins: mine\n"), std::vector{file.parent_path() / "mine"});
    EXPECT_EQ(plugins_of("gault: 1\n", {{"plugins", "mine"}}), std::vector{file.parent_path() / "mine"});
    EXPECT_TRUE(plugins_of("gault: 1\n").empty());
}

TEST_F(ScenePlugins, ThatAreMissingAreSaidSo) {
    try {
        plugins_of("gault: 1\nplugins: [mine, yours]\n");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()), file.string() + ":2:17: plugins: there is no file or folder '" +
                                                 (file.parent_path() / "yours").string() + "'");
    }
}

} // namespace
} // namespace gault::core
