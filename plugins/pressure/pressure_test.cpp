#include "surface_fixture.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;

Component boundary(const Settings& settings) {
    return {"pressure", GAULT_BOUNDARY, "pressure", settings};
}

double pressure_at(const Component& c, double time) {
    Facets facets(c, 1);
    EXPECT_EQ(facets.load(time), GAULT_OK) << facets.error.text;
    return facets.pressure[0];
}

TEST(Pressure, StaysWhereAValueIsGiven) {
    const Component c = boundary({{"value", 90e3}});
    EXPECT_EQ(pressure_at(c, 0.0), 90e3);
    EXPECT_EQ(pressure_at(c, 100.0), 90e3);
}

TEST(Pressure, FollowsATableAndStaysAtItsEnds) {
    const Component c = boundary({{"table", Points{{1.0, 100.0}, {3.0, 200.0}, {4.0, 0.0}}}});
    EXPECT_EQ(pressure_at(c, 0.0), 100.0);
    EXPECT_EQ(pressure_at(c, 1.5), 125.0);
    EXPECT_EQ(pressure_at(c, 3.75), 50.0);
    EXPECT_EQ(pressure_at(c, 9.0), 0.0);
}

TEST(Pressure, RestsAtThePointsOfASmoothTable) {
    const Component c = boundary({{"table", Points{{0.0, 0.0}, {1.0, 1.0}, {2.0, 3.0}}}, {"smooth", true}});
    EXPECT_DOUBLE_EQ(pressure_at(c, 0.5), 0.5);
    EXPECT_DOUBLE_EQ(pressure_at(c, 1.0), 1.0);
    // Near a point a distance s away the quintic moves by 10 s^3 of the next rise.
    EXPECT_NEAR(pressure_at(c, 1.0 + 1e-3) - 1.0, 2.0 * 10e-9, 1e-10);
    EXPECT_NEAR(pressure_at(c, 1.0 - 1e-3) - 1.0, -10e-9, 1e-10);
}

TEST(Pressure, YieldsToAProgram) {
    for (const Settings& settings : {Settings{}, Settings{{"value", 90e3}}}) {
        const Component c = boundary(settings);
        Facets facets(c, 1);
        facets.control[0] = 42.0;
        ASSERT_EQ(facets.load(0.0), GAULT_OK);
        EXPECT_EQ(facets.pressure[0], 42.0);
    }
}

TEST(Pressure, SaysThatNothingTellsItsValue) {
    const Component c = boundary({});
    Facets facets(c, 1);
    EXPECT_EQ(facets.load(0.0), GAULT_FAILED);
    EXPECT_STREQ(facets.error.text, "a pressure without value or table, and no program commands it");
}

TEST(Pressure, RefusesAValueBesideATable) {
    try {
        boundary({{"value", 1.0}, {"table", Points{{0.0, 1.0}, {1.0, 2.0}}}});
        FAIL() << "accepted";
    } catch (const Invalid& e) {
        EXPECT_EQ(e.parameter, "table");
    }
    EXPECT_THROW(boundary({{"value", 1.0}, {"smooth", true}}), Invalid);
}

} // namespace
