// Scenes that run and are wrong, or may be: what the program says of them.
#include "core/scheduler/cautions.hpp"
#include "tests/hard/hard_scene.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gault::core::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const lock = "these cells lock";

TEST(Cautions, NameCellsThatLock) {
    const Override linear{"grid.basis", "linear"}, four{"points.per_cell", "4"};
    EXPECT_THAT(cautions(scene_of("hard/clay_cavity", {linear})), Contains(HasSubstr(lock)));
    EXPECT_THAT(cautions(scene_of("hard/clay_cavity", {four})), Contains(HasSubstr(lock)));
    EXPECT_THAT(cautions(scene_of("hard/clay_cavity", {linear, {"points.per_cell", "1"}})), IsEmpty());
    EXPECT_THAT(cautions(scene_of("hard/sand_cavity", {linear})), IsEmpty()) << "Poisson's ratio 0.25";
}

// The caution is right: by how much the pressure of the clay (282.34 kPa) is missed on 20 cells.
TEST(Cautions, OfCellsThatLockAreRight) {
    const auto pressure = [](const char* basis, const char* points) {
        HardScene s("hard/clay_cavity",
                    {{"grid", fmt::format("{{cells: 20, basis: {}}}", basis)}, {"points.per_cell", points}});
        s.run();
        return s.last("true_pressure") / 282.34e3 - 1.0;
    };
    const double locked = pressure("linear", "2"), right = pressure("linear", "1"),
                 quadratic = pressure("quadratic", "2");
    std::printf("linear, 2 points %.3g, 1 point %.3g, quadratic, 2 points %.3g\n", locked, right, quadratic);
    EXPECT_GT(locked, 0.5);
    EXPECT_NEAR(right, 0.0, 0.02);
    EXPECT_NEAR(quadratic, 0.0, 0.02);
}

TEST(Cautions, SayThatStressesScatterInQuadraticCells) {
    const char* text = "the stresses of points scatter";
    EXPECT_THAT(cautions(scene_of("hard/clay_cavity", {})), Contains(HasSubstr(text)));
    EXPECT_THAT(cautions(scene_of("hard/sand_cavity", {})), IsEmpty());
}

TEST(Cautions, SayThatNobodyWatchesTheFarFieldOfTheUpdatedFrame) {
    EXPECT_THAT(cautions(scene_of("hard/sand_cavity", {{"model.frame", "updated"}})),
                Contains(HasSubstr("it is not watched")));
}

TEST(Cautions, NameEdgesOfRegionsWithinCells) {
    const auto said = [](const char* cells, const char* region) {
        return cautions(scene_of("hard/sand_cavity", {{"grid.cells", cells},
                                                      {"grid.grading", "{r: 1}"},
                                                      {"geometry.annulus.outer_radius", "120 mm"},
                                                      {"regions", region}}));
    };
    const char* ring = "[{name: ring, r: [0, 30 mm], overrides: {young_modulus: 5 MPa}}]";
    EXPECT_THAT(said("50", ring), IsEmpty()); // 2 mm each
    EXPECT_THAT(said("40", ring), IsEmpty()); // 2.5 mm each
    EXPECT_THAT(said("25", ring),             // 4 mm each
                Contains(HasSubstr("the region 'ring' has an edge at 0.03 m along r, within a cell; cells are whole, "
                                   "and it is taken to be at ")));
}

TEST(FarField, IsRefusedWhereXIsNoRadius) {
    for (const char* side : {"left", "right"})
        EXPECT_THAT(
            [&] {
                scene_of("hard/pulse", {{"boundaries.2", fmt::format("{{on: {}, type: far_field}}", side)}});
            },
            testing::ThrowsMessage<InputError>(
                HasSubstr("far_field stands for the soil outside a cylinder; it cannot act on")));
    EXPECT_THAT(
        [] {
            scene_of("hard/sand_cavity", {{"boundaries.0", "{on: inner, type: far_field}"}});
        },
        testing::ThrowsMessage<InputError>(HasSubstr("it cannot act on 'inner'")));
}

} // namespace
} // namespace gault::core::test
