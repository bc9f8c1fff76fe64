#include <gault/program.hpp>

// Pushes a wall into the soil at a constant velocity, and records the pressure on it.
struct NewProgram {
    static constexpr const char* name = "new_program";
    static constexpr const char* version = "1.0.0"; // in every result: raise it when a number changes
    static constexpr const char* doc = "Pushes a wall into the soil at a constant velocity.";

    double velocity, until;
    int rows;
    static constexpr std::array parameters{
        gault::parameter<&NewProgram::velocity>("velocity", "v", "m/s", "Of the wall, into the soil.")
            .above(0),
        gault::parameter<&NewProgram::until>("until", "u", "m", "Displacement at the end.").above(0),
        gault::parameter<&NewProgram::rows>("rows", "", "1", "Rows of the history after the first.")
            .at_least(1)
            .fallback(20)};

    // What the host measures, what the wall is told, what is remembered, what a row holds.
    enum { moved, force, area };
    static constexpr std::array measures{gault::signal("displacement", "m", "Of the surface, into the soil."),
                                         gault::signal("normal_force", "N", "That pushes into the soil."),
                                         gault::signal("area", "m^2", "Of the surface, current.")};
    static constexpr std::array controls{gault::signal("velocity", "m/s", "Of the wall.")};
    enum { next_row };
    static constexpr std::array memories{gault::signal("next_row", "1", "Number of the row that is due.", 0)};
    enum { displacement, pressure };
    static constexpr std::array records{
        gault::signal("displacement", "m", "Of the surface, into the soil."),
        gault::signal("pressure", "Pa", "Force over current area, compression positive.")};

    // Before the first step, and at the end of every step. The answer depends on the step alone.
    void advance(gault::Step& step) const {
        const double interval = until / velocity / rows; // s
        step.record(displacement) = step.measure(moved);
        step.record(pressure) = step.measure(force) / step.measure(area);
        if (step.time() >= (1 - 1e-12) * step.memory(next_row) * interval) {
            step.emit();
            step.memory(next_row) += 1;
        }
        if (step.memory(next_row) > rows) step.finish();
        step.control(0) = velocity;
        step.stop_at(step.memory(next_row) * interval); // a step ends exactly there
    }

    // Once, when the run is complete.
    void evaluate(const gault::History& history, gault::Report& report) const {
        const int64_t last = history.rows() - 1;
        report.result("secant_stiffness", "Pa/m",
                      (history.record(pressure, last) - history.record(pressure, 0)) /
                          (history.record(displacement, last) - history.record(displacement, 0)));
    }
};

GAULT_MODULE("new_program", "1.0.0", "Your name", "MIT", gault::Program<NewProgram>)
