#include <gault/boundary.hpp>

#include <cmath>

// Zero velocity in chosen directions: those said to be held; where none is, all that are not said to be free.
struct Fixity {
    static constexpr const char* name = "fixity";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "Holds the soil still: in the directions named, or in all.";
    static constexpr uint32_t flags = gault::uniform;

    std::optional<bool> x, y, z;
    std::array<bool, 3> held;

    static constexpr std::array parameters{
        gault::parameter<&Fixity::x>("x", "", "1", "Whether the first direction is held."),
        gault::parameter<&Fixity::y>("y", "", "1", "Whether the second direction is held."),
        gault::parameter<&Fixity::z>("z", "", "1", "Whether the third direction is held.")};

    void prepare() {
        const bool named = x.value_or(false) || y.value_or(false) || z.value_or(false);
        held = {x.value_or(!named), y.value_or(!named), z.value_or(!named)};
        if (!held[0] && !held[1] && !held[2])
            throw gault::Invalid("x", "a fixity that holds no direction does nothing");
    }
    void constrain(gault::Node& node) const {
        for (int axis = 0; axis < 3; ++axis)
            if (held[static_cast<std::size_t>(axis)]) node.prescribe(axis, 0.0);
    }
};

// Zero velocity along an axis-aligned normal, free to slide.
struct Roller {
    static constexpr const char* name = "roller";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "Holds the soil along the normal of a surface and lets it slide.";
    static constexpr uint32_t flags = gault::uniform | gault::holds_normal;

    void constrain(gault::Node& node) const {
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(node.normal(axis)) > 0.7) node.prescribe(axis, 0.0);
    }
};

GAULT_MODULE("fixity", "1.0.0", "The Gault authors", "MIT", gault::Boundary<Fixity>, gault::Boundary<Roller>)
