#include <gault/boundary.hpp>

#include <cmath>

// A wall that a program drives: its velocity or the pressure on it.
struct Wall {
    static constexpr const char* name = "wall";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc = "A wall that a program moves into the soil or loads with a pressure.";
    static constexpr uint32_t flags = gault::uniform;

    enum { velocity, pressure, drive };
    static constexpr std::array controls{
        gault::signal("velocity", "m/s", "Into the soil, where the velocity is driven."),
        gault::signal("pressure", "Pa", "Compression positive, where the pressure is driven."),
        gault::signal("drive", "1", "0: the velocity is prescribed; 1: the pressure is.")};

    bool rough;

    static constexpr std::array parameters{
        gault::parameter<&Wall::rough>("rough", "", "1",
                                       "Whether the soil sticks to the wall or slides along it.")
            .fallback(0)};

    void constrain(gault::Node& node) const {
        const bool driven = node.control(drive) < 0.5;
        for (int axis = 0; axis < 3; ++axis) {
            const double normal = node.normal(axis);
            if (std::abs(normal) > 0.7) {
                if (driven) node.prescribe(axis, (normal > 0.0 ? -1.0 : 1.0) * node.control(velocity));
            } else if (rough) {
                node.prescribe(axis, 0.0);
            }
        }
    }
    void load(gault::Facet& facet) const {
        if (facet.control(drive) >= 0.5) facet.set_pressure(facet.control(pressure));
    }
};

GAULT_MODULE("wall", "1.0.0", "The Gault authors", "MIT", gault::Boundary<Wall>)
