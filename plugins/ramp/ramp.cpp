#include <gault/program.hpp>

#include <cmath>

// One control follows a table in time: the pressure of a `pressure` boundary or of a driven wall, the
// velocity of a wall.
struct Ramp {
    static constexpr const char* name = "ramp";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "Moves one control along a table in time and records what the surface does.";

    gault::Table pressure, velocity;
    std::string control;
    bool smooth;
    std::optional<double> until;
    int rows;

    static constexpr std::array parameters{
        gault::table<&Ramp::pressure>("pressure", "s", "Pa",
                                      "Pressure at points in time, compression positive.")
            .optional(),
        gault::table<&Ramp::velocity>("velocity", "s", "m/s", "Velocity into the soil at points in time.")
            .optional(),
        gault::parameter<&Ramp::control>("control", "", "",
                                         "Control that it moves; pressure or velocity, as the table.")
            .optional(),
        gault::parameter<&Ramp::smooth>("smooth", "", "1",
                                        "Whether the control rests at each point of the table.")
            .fallback(1),
        gault::parameter<&Ramp::until>("until", "", "s",
                                       "When it ends; the last time of the table if absent.")
            .above(0),
        gault::parameter<&Ramp::rows>("rows", "", "1", "Rows after the first, evenly spaced in time.")
            .at_least(1)
            .fallback(200)};

    enum { measured_radius, measured_displacement, measured_force, measured_area };
    enum { next_row };
    enum { set_value, radius, displacement, normal_force, true_pressure };

    gault::Signals signals;
    double end; // s

    const gault::Table& table() const { return pressure.empty() ? velocity : pressure; }
    const gault::Signals& instance_signals() const { return signals; }
    double value(double time) const { return smooth ? table().smooth(time) : table().linear(time); }

    void prepare() {
        if (pressure.empty() && velocity.empty())
            throw gault::Invalid("pressure", "one of the tables pressure and velocity is required");
        if (!pressure.empty() && !velocity.empty())
            throw gault::Invalid("velocity", "give either pressure or velocity, not both");
        end = until.value_or(table().last());
        if (!(end > 0.0)) throw gault::Invalid("until", "a table that ends at time 0 needs until");

        const bool pressing = !pressure.empty();
        const char* unit = pressing ? "Pa" : "m/s";
        if (control.empty()) control = pressing ? "pressure" : "velocity";
        signals.measures = {
            gault::signal("radius", "m", "Mean current radius of the surface."),
            gault::signal("displacement", "m", "Mean displacement of the surface, into the soil."),
            gault::signal("normal_force", "N", "Force that pushes into the soil."),
            gault::signal("area", "m^2", "Current area of the surface.")};
        signals.controls = {gault::signal(control.c_str(), unit, "What the table commands.", value(0.0))};
        if (control == "pressure") // which a wall heeds when it is told to
            signals.controls.push_back(gault::optional(
                gault::signal("drive", "1", "1: a wall takes its pressure instead of its velocity.", 1.0)));
        signals.memories = {gault::signal("next_row", "1", "Number of the row that is due.")};
        signals.records = {
            gault::signal("set_value", unit, "What the table commands now."),
            gault::signal("radius", "m", "Mean current radius of the surface."),
            gault::signal("displacement", "m", "Mean displacement of the surface, into the soil."),
            gault::signal("normal_force", "N", "Force that pushes into the soil."),
            gault::signal("true_pressure", "Pa", "Force over current area, compression positive.")};
        signals.declare();
    }

    void advance(gault::Step& step) const {
        const double slack = 1e-12 * end;
        const bool done = step.time() >= end - slack;
        write_row(step, done);
        if (done) {
            step.finish();
            return;
        }
        const double event = next_event(step.time() + slack);
        step.stop_at(event);
        // Boundaries act at a step's end.
        step.control(0) = value(std::min(step.time() + step.next_dt(), event));
    }

    double next_event(double after) const { // the next point of the table, or the end
        const auto point = std::upper_bound(table().x.begin(), table().x.end(), after);
        return point == table().x.end() ? end : std::min(*point, end);
    }

    void write_row(gault::Step& step, bool done) const {
        step.record(set_value) = value(step.time());
        step.record(radius) = step.measure(measured_radius);
        step.record(displacement) = step.measure(measured_displacement);
        step.record(normal_force) = step.measure(measured_force);
        step.record(true_pressure) = step.measure(measured_force) / step.measure(measured_area);

        // A time that is a row's but for rounding counts as one.
        const double row = step.time() / end * rows + 1e-9;
        if (!step.first() && !done && row < step.memory(next_row)) return;
        step.memory(next_row) = std::floor(row) + 1.0;
        step.emit();
    }
};

GAULT_MODULE("ramp", "1.0.0", "The Gault authors", "MIT", gault::Program<Ramp>)
