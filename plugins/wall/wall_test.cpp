#include "surface_fixture.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;
enum { velocity, pressure, drive };

TEST(Wall, MovesIntoTheSoilAgainstItsNormal) {
    const Component c("wall", GAULT_BOUNDARY, "wall", {});
    Nodes nodes(c, {{-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    nodes.control[velocity] = 2e-3;
    ASSERT_EQ(nodes.constrain(), GAULT_OK);
    EXPECT_EQ(nodes.fixed[0][0], 1.0);
    EXPECT_EQ(nodes.velocity[0][0], 2e-3);
    EXPECT_EQ(nodes.fixed[1][0], 0.0);
    EXPECT_EQ(nodes.fixed[1][1], 1.0);
    EXPECT_EQ(nodes.velocity[1][1], -2e-3);
}

TEST(Wall, MovesBackWithANegativeVelocity) {
    const Component c("wall", GAULT_BOUNDARY, "wall", {});
    Nodes nodes(c, {{-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    nodes.control[velocity] = -2e-3;
    ASSERT_EQ(nodes.constrain(), GAULT_OK);
    EXPECT_EQ(nodes.velocity[0][0], -2e-3);
    EXPECT_EQ(nodes.velocity[1][1], 2e-3);
}

TEST(Wall, HoldsStillUntilItIsCommanded) {
    const Component c("wall", GAULT_BOUNDARY, "wall", {});
    Nodes nodes(c, {{-1.0, 0.0, 0.0}});
    ASSERT_EQ(nodes.constrain(), GAULT_OK);
    EXPECT_EQ(nodes.fixed[0][0], 1.0);
    EXPECT_EQ(nodes.velocity[0][0], 0.0);
}

TEST(Wall, HoldsTheSoilAlongItOnlyWhereItIsRough) {
    const Component c("wall", GAULT_BOUNDARY, "wall", {{"rough", true}});
    Nodes nodes(c, {{-1.0, 0.0, 0.0}});
    nodes.control[velocity] = 1e-3;
    ASSERT_EQ(nodes.constrain(), GAULT_OK);
    EXPECT_EQ(nodes.fixed[1][0], 1.0);
    EXPECT_EQ(nodes.velocity[1][0], 0.0);
}

TEST(Wall, SwitchesBetweenVelocityAndPressureAsItIsDriven) {
    const Component c("wall", GAULT_BOUNDARY, "wall", {});
    Nodes nodes(c, {{-1.0, 0.0, 0.0}});
    Facets facets(c, 2);
    facets.control[pressure] = 5e5;
    ASSERT_EQ(facets.load(0.0), GAULT_OK);
    EXPECT_EQ(facets.pressure[1], 0.0);

    nodes.control[drive] = facets.control[drive] = 1.0;
    ASSERT_EQ(nodes.constrain(), GAULT_OK);
    ASSERT_EQ(facets.load(0.0), GAULT_OK);
    EXPECT_EQ(nodes.fixed[0][0], 0.0);
    EXPECT_EQ(facets.pressure[1], 5e5);
}

} // namespace
