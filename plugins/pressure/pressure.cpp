#include <gault/boundary.hpp>

#include <cmath>

// A pressure that follows the surface: constant, a function of time, or what a program commands.
struct Pressure {
    static constexpr const char* name = "pressure";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "A pressure on a surface, compression positive, that follows it as it moves.";
    static constexpr uint32_t flags = gault::uniform;

    static constexpr std::array controls{gault::signal("pressure", "Pa",
                                                       "Commanded by a program, in place of value or table.",
                                                       std::numeric_limits<double>::quiet_NaN())};

    std::optional<double> value;
    gault::Table table;
    bool smooth;

    static constexpr std::array parameters{
        gault::parameter<&Pressure::value>("value", "p", "Pa", "Pressure, compression positive."),
        gault::table<&Pressure::table>("table", "s", "Pa", "Pressure at points in time.").optional(),
        gault::parameter<&Pressure::smooth>("smooth", "", "1",
                                            "Whether the table rests at each of its points.")
            .fallback(0)};

    void prepare() const {
        if (value && !table.empty()) throw gault::Invalid("table", "give either value or table, not both");
        if (smooth && table.empty())
            throw gault::Invalid("smooth", "smooth is about a table, and there is none");
    }

    void load(gault::Facet& facet) const {
        const double commanded = facet.control(0);
        facet.set_pressure(std::isnan(commanded) ? given(facet.time()) : commanded);
    }

    double given(double time) const {
        if (value) return *value;
        if (table.empty())
            throw std::runtime_error("a pressure without value or table, and no program commands it");
        return smooth ? table.smooth(time) : table.linear(time);
    }
};

GAULT_MODULE("pressure", "1.0.0", "The Gault authors", "MIT", gault::Boundary<Pressure>)
