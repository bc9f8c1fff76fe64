#include "surface_fixture.hpp"

#include <gtest/gtest.h>

namespace {
using namespace plugin_test;
using Held = std::array<double, 3>;

Held held_by_fixity(const Settings& settings) {
    const Component c("fixity", GAULT_BOUNDARY, "fixity", settings);
    Nodes nodes(c, {{1.0, 0.0, 0.0}});
    EXPECT_EQ(nodes.constrain(), GAULT_OK);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(nodes.velocity[axis][0], nodes.fixed[axis][0] != 0.0 ? 0.0 : Nodes::unset);
    return {nodes.fixed[0][0], nodes.fixed[1][0], nodes.fixed[2][0]};
}

TEST(Fixity, HoldsEveryDirectionUnlessSomeAreNamed) {
    EXPECT_EQ(held_by_fixity({}), (Held{1, 1, 1}));
    EXPECT_EQ(held_by_fixity({{"x", true}}), (Held{1, 0, 0}));
    EXPECT_EQ(held_by_fixity({{"x", true}, {"y", true}}), (Held{1, 1, 0}));
    EXPECT_EQ(held_by_fixity({{"x", false}}), (Held{0, 1, 1}));
}

TEST(Fixity, RefusesToHoldNothing) {
    EXPECT_THROW(held_by_fixity({{"x", false}, {"y", false}, {"z", false}}), Invalid);
}

TEST(Roller, HoldsTheNormalAndLetsTheSurfaceSlide) {
    const Component c("fixity", GAULT_BOUNDARY, "roller", {});
    Nodes nodes(c, {{0.0, -1.0, 0.0}, {0.99, 0.1, 0.0}});
    ASSERT_EQ(nodes.constrain(), GAULT_OK);
    EXPECT_EQ((Held{nodes.fixed[0][0], nodes.fixed[1][0], nodes.fixed[2][0]}), (Held{0, 1, 0}));
    EXPECT_EQ((Held{nodes.fixed[0][1], nodes.fixed[1][1], nodes.fixed[2][1]}), (Held{1, 0, 0}));
    EXPECT_EQ(nodes.velocity[1][0], 0.0);
}

} // namespace
