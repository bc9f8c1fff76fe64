#include <gault/program.hpp>

#include <cmath>

// A self-boring pressuremeter test: the wall of a cavity is moved out at a steady rate after a smooth start.
//
// Travel of the wall, V the steady velocity, T the time of the start, s = t / T:
//   t <= T: u = V T s^4 (5/2 - 3 s + s^2), the integral of a velocity V (10 s^3 - 15 s^4 + 6 s^5)
//   t >= T: u = V (t - T / 2)
struct CavityStrain {
    static constexpr const char* name = "cavity_strain";
    static constexpr const char* doc = "Until the cavity strain reaches a value.";
    double value;
    static constexpr std::array parameters{
        gault::parameter<&CavityStrain::value>("value", "", "1", "(a - a0) / a0.").above(0)};
};

struct Pressuremeter {
    static constexpr const char* name = "pressuremeter";
    static constexpr const char* version = "1.0.0";
    static constexpr const char* doc =
        "Expands a cavity at a steady rate and records pressure and cavity strain.";
    static constexpr const char* reference =
        "Mair, R. J. and Wood, D. M. (1987), Pressuremeter Testing, CIRIA";

    std::optional<double> rate, strain_rate, ramp_time, ramp_strain;
    gault::Records<CavityStrain> until;
    double row_strain;

    static constexpr std::array parameters{
        gault::parameter<&Pressuremeter::rate>("rate", "", "m/s",
                                               "Velocity of the wall; this or strain_rate.")
            .above(0),
        gault::parameter<&Pressuremeter::strain_rate>("strain_rate", "", "1/s",
                                                      "Rate of the cavity strain; this or rate.")
            .above(0),
        gault::parameter<&Pressuremeter::until>("until", "", "1",
                                                "When the test ends, {cavity_strain: 10 %}.")
            .count(1, 1),
        gault::parameter<&Pressuremeter::ramp_time>("ramp_time", "T", "s",
                                                    "Time over which the wall starts to move.")
            .above(0),
        gault::parameter<&Pressuremeter::ramp_strain>(
            "ramp_strain", "", "1",
            "Cavity strain over which the wall starts to move; 0.05 % without ramp_time.")
            .above(0),
        gault::parameter<&Pressuremeter::row_strain>("row_strain", "", "1", "Cavity strain between rows.")
            .above(0)
            .fallback(2.5e-4)};

    enum { radius, initial_radius, area, initial_area, normal_force };
    static constexpr std::array measures{
        gault::signal("radius", "m", "Mean current radius of the cavity."),
        gault::signal("initial_radius", "m", "Initial radius of the cavity."),
        gault::signal("area", "m^2", "Current area of the wall."),
        gault::signal("initial_area", "m^2", "Initial area of the wall."),
        gault::signal("normal_force", "N", "Force that pushes the soil away.")};
    enum { velocity };
    static constexpr std::array controls{gault::signal("velocity", "m/s", "Of the wall, into the soil.")};
    enum { next_row, travel };
    static constexpr std::array memories{
        gault::signal("next_row", "1", "Cavity strain at which a row is due."),
        gault::signal("travel", "m", "How far the wall was commanded to move.")};
    enum { cavity_strain, true_pressure, nominal_pressure, cavity_radius, phase };
    static constexpr std::array records{
        gault::signal("cavity_strain", "1", "(a - a0) / a0."),
        gault::signal("true_pressure", "Pa", "Force over current area of the wall, compression positive."),
        gault::signal("nominal_pressure", "Pa", "Force over initial area of the wall, compression positive."),
        gault::signal("cavity_radius", "m", "Current radius of the cavity."),
        gault::signal("phase", "1", "Number of the phase of the test, from 1.")};

    void prepare() const {
        if (rate && strain_rate)
            throw gault::Invalid("strain_rate", "give either rate or strain_rate, not both");
        if (!rate && !strain_rate) throw gault::Invalid("rate", "one of rate and strain_rate is required");
        if (ramp_time && ramp_strain)
            throw gault::Invalid("ramp_strain", "give either ramp_time or ramp_strain, not both");
    }

    // Of the wall.
    struct Motion {
        double steady, start; // V, m/s; T, s

        double travel(double time) const {
            const double s = time / start;
            return s < 1.0 ? steady * start * s * s * s * s * (2.5 - s * (3.0 - s))
                           : steady * (time - 0.5 * start);
        }
        double time(double distance) const {
            if (distance >= travel(start)) return 0.5 * start + distance / steady;
            double early = 0.0, late = start;
            while (late - early > 1e-15 * start) {
                const double middle = 0.5 * (early + late);
                (travel(middle) < distance ? early : late) = middle;
            }
            return late;
        }
    };
    Motion motion(double a0) const {
        const double steady = rate ? *rate : *strain_rate * a0;
        return {steady, ramp_time ? *ramp_time : 2.0 * ramp_strain.value_or(5e-4) * a0 / steady};
    }

    void advance(gault::Step& step) const {
        const double a0 = step.measure(initial_radius);
        if (!(a0 > 0.0))
            throw std::runtime_error("a pressuremeter is `on` a cylindrical surface; it has no radius");
        const Motion wall = motion(a0);
        const double end = wall.time(std::get<CavityStrain>(until[0]).value * a0);
        const bool done = step.time() >= end * (1.0 - 1e-12);

        write_row(step, a0, done);
        step.memory(travel) += step.control(velocity) * step.dt();
        if (step.memory(travel) > 0.0 && step.measure(radius) < a0)
            throw std::runtime_error(
                "a pressuremeter opens a cavity; the radius of this surface falls as the "
                "wall moves into the soil");
        step.stop_at(end);
        if (done) {
            step.control(velocity) = 0.0;
            step.finish();
        } else {
            // The mean velocity that brings the wall to where it should be at the end of the coming step.
            const double dt = std::min(step.next_dt(), end - step.time());
            step.control(velocity) = (wall.travel(step.time() + dt) - step.memory(travel)) / dt;
        }
    }

    void write_row(gault::Step& step, double a0, bool done) const {
        const double strain = step.measure(radius) / a0 - 1.0;
        step.record(cavity_strain) = strain;
        step.record(true_pressure) = step.measure(normal_force) / step.measure(area);
        step.record(nominal_pressure) = step.measure(normal_force) / step.measure(initial_area);
        step.record(cavity_radius) = step.measure(radius);
        step.record(phase) = 1.0;

        const double slack = 1e-9; // of a row: a strain that is a multiple but for rounding counts as one
        if (!step.first() && !done && strain < step.memory(next_row) - slack * row_strain) return;
        step.memory(next_row) = row_strain * (std::floor(strain / row_strain + slack) + 1.0);
        step.emit();
    }
};

GAULT_MODULE("pressuremeter", "1.0.0", "The Gault authors", "MIT", gault::Program<Pressuremeter>)
