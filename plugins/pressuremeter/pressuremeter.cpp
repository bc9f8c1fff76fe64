#include "interpretation.hpp"
#include "path.hpp"
#include "phases.hpp"

namespace pressuremeter {

// A pressuremeter test: phases one after the other, each of which drives the wall or the pressure until an event.
struct Pressuremeter {
    static constexpr const char* name = "pressuremeter";
    static constexpr const char* version = "1.1.0";
    static constexpr const char* doc = "A pressuremeter test in phases, and what engineers derive from it.";
    static constexpr const char* reference =
        "Mair, R. J. and Wood, D. M. (1987), Pressuremeter Testing, CIRIA; ISO 22476-4 (2012)";

    Phases phases;
    Until until;
    std::optional<double> rate, strain_rate, ramp_time, ramp_strain, row_strain;
    std::optional<double> critical_friction_angle;
    double pore_pressure, fit_from, fit_to, menard_poisson_ratio;

    static constexpr std::array parameters{
        gault::parameter<&Pressuremeter::phases>("phases", "", "1",
                                                 "What is done, in this order; without it one expansion.")
            .optional(),
        gault::parameter<&Pressuremeter::until>("until", "", "1",
                                                "When the one expansion ends, {cavity_strain: 10 %}.")
            .optional(),
        gault::parameter<&Pressuremeter::rate>(
            "rate", "", "m/s", "Velocity of the wall where a phase says none; or strain_rate.")
            .above(0),
        gault::parameter<&Pressuremeter::strain_rate>("strain_rate", "", "1/s",
                                                      "Rate of the cavity strain there; or rate.")
            .above(0),
        gault::parameter<&Pressuremeter::ramp_time>("ramp_time", "T", "s",
                                                    "Time over which the wall starts and stops.")
            .above(0),
        gault::parameter<&Pressuremeter::ramp_strain>(
            "ramp_strain", "", "1",
            "Cavity strain over which it does; without ramp_time 0.05 %, and 0 where there is no inertia.")
            .above(0),
        gault::parameter<&Pressuremeter::row_strain>(
            "row_strain", "", "1",
            "Cavity strain between rows; 0.025 %, and a row a step where there is no inertia, ten each way of a loop.")
            .above(0),
        gault::parameter<&Pressuremeter::critical_friction_angle>(
            "critical_friction_angle", "phi_cv", "rad",
            "Of a sand at constant volume: its friction angle is then derived.")
            .above(0)
            .below(0.5 * gault::pi),
        gault::parameter<&Pressuremeter::pore_pressure>("pore_pressure", "u0", "Pa", "In that sand.")
            .fallback(0),
        gault::parameter<&Pressuremeter::fit_from>("fit_from", "", "1",
                                                   "Cavity strain at which fits of first loading begin.")
            .above(0)
            .fallback(0.02),
        gault::parameter<&Pressuremeter::fit_to>("fit_to", "", "1", "Cavity strain at which they end.")
            .above(0)
            .fallback(0.10),
        gault::parameter<&Pressuremeter::menard_poisson_ratio>("menard_poisson_ratio", "nu", "1",
                                                               "In Menard's modulus, by convention.")
            .above(-1)
            .at_most(0.5)
            .fallback(0.33)};

    enum { radius, initial_radius, area, initial_area, normal_force, enclosed_volume };
    static constexpr std::array measures{
        gault::signal("radius", "m", "Mean current radius of the cavity."),
        gault::signal("initial_radius", "m", "Initial radius of the cavity."),
        gault::signal("area", "m^2", "Current area of the wall."),
        gault::signal("initial_area", "m^2", "Initial area of the wall."),
        gault::signal("normal_force", "N", "Force that pushes the soil away."),
        gault::signal("enclosed_volume", "m^3", "Volume of the cavity.")};
    enum { velocity, pressure, drive };
    static constexpr std::array controls{
        gault::signal("velocity", "m/s", "Of the wall, into the soil, in phases that drive the wall."),
        gault::signal("pressure", "Pa", "On the wall, in phases that drive the pressure."),
        gault::signal("drive", "1", "Which of the two: 0 velocity, 1 pressure.")};
    enum {
        phase_number,
        part_number,
        phase_time,
        phase_strain,
        phase_pressure,
        part_time,
        part_strain,
        part_pressure,
        highest,
        strain_before,
        pressure_before,
        volume_before,
        initial_volume,
        loops_before,
        last_row
    };
    static constexpr std::array memories{
        gault::signal("phase_number", "1", "Of the present phase, from 0."),
        gault::signal("part_number", "1", "Of its present part, from 0."),
        gault::signal("phase_time", "s", "When the phase began."),
        gault::signal("phase_strain", "1", "Cavity strain then."),
        gault::signal("phase_pressure", "Pa", "True pressure then."),
        gault::signal("part_time", "s", "When the part began."),
        gault::signal("part_strain", "1", "Cavity strain then."),
        gault::signal("part_pressure", "Pa", "True pressure then."),
        gault::signal("highest", "Pa", "Highest true pressure in the phase."),
        gault::signal("strain_before", "1", "Cavity strain at the start of the step."),
        gault::signal("pressure_before", "Pa", "True pressure then."),
        gault::signal("volume_before", "1", "Volume of the cavity over the initial one then."),
        gault::signal("initial_volume", "m^3", "Of the cavity."),
        gault::signal("loops_before", "1", "Loops of earlier phases."),
        gault::signal("last_row", "1", "Multiple of row_strain below the last row.")};
    enum {
        cavity_strain,
        true_pressure,
        nominal_pressure,
        cavity_radius,
        volume,
        phase,
        loop,
        pressure_step,
        held
    };
    static constexpr std::array records{
        gault::signal("cavity_strain", "1", "(a - a0) / a0."),
        gault::signal("true_pressure", "Pa", "Force over current area of the wall, compression positive."),
        gault::signal("nominal_pressure", "Pa", "Force over initial area of the wall, compression positive."),
        gault::signal("cavity_radius", "m", "Current radius of the cavity."),
        gault::signal("volume", "m^3", "Of the cavity."),
        gault::signal("phase", "1", "Number of the phase of the test, from 1."),
        gault::signal("loop", "1", "Number of the unload-reload loop, from 1; 0 outside loops."),
        gault::signal("pressure_step", "1", "Number of the pressure step of the phase, from 1; 0: none."),
        gault::signal("held", "1", "1 while a pressure step holds its pressure.")};

    gault::Signals signals;
    const gault::Signals& instance_signals() const { return signals; }

    void prepare() {
        refuse_two("strain_rate", rate, strain_rate, "give either rate or strain_rate, not both");
        refuse_two("ramp_strain", ramp_time, ramp_strain, "give either ramp_time or ramp_strain, not both");
        if (!(fit_from < fit_to)) throw gault::Invalid("fit_to", "must be above fit_from");
        if (!phases.empty() && !until.empty())
            throw gault::Invalid("until", "belongs to a test without phases; give each phase its own");
        if (phases.empty()) {
            if (until.empty()) throw gault::Invalid("phases", "give phases, or until for a single expansion");
            Expand expand{};
            expand.until = until;
            phases.push_back(expand);
        }
        for (std::size_t i = 0; i < phases.size(); ++i)
            std::visit([&](const auto& one) { check(one, i); }, phases[i]);
        declare();
    }

    static void refuse_two(const char* parameter, const std::optional<double>& one,
                           const std::optional<double>& other, const char* text) {
        if (one && other) throw gault::Invalid(parameter, text);
    }

    template <class Phase>
    void check(const Phase& one, std::size_t i) const {
        const std::string where = "phase " + std::to_string(i + 1) + " (" + Phase::name + "): ";
        try {
            one.check();
        } catch (const std::exception& wrong) {
            throw gault::Invalid("phases", where + wrong.what());
        }
        if (one.needs_speed() && !rate && !strain_rate)
            throw gault::Invalid(until.empty() ? "phases" : "rate",
                                 until.empty() ? where + "give it a rate, a strain_rate or a pressure_rate, "
                                                         "or the program a rate or strain_rate"
                                               : "one of rate and strain_rate is required");
    }

    void declare() {
        bool wall = false, fluid = false;
        for (const auto& one : phases)
            std::visit([&](const auto& p) { wall |= p.drives_wall(), fluid |= p.drives_pressure(); }, one);
        signals.measures.assign(measures.begin(), measures.end());
        signals.memories.assign(memories.begin(), memories.end());
        signals.records.assign(records.begin(), records.end());
        signals.controls = {wall ? controls[velocity] : gault::optional(controls[velocity]),
                            fluid ? controls[pressure] : gault::optional(controls[pressure]),
                            fluid ? controls[drive] : gault::optional(controls[drive])};
        signals.declare();
    }

    void advance(gault::Step& step) const {
        const State now = state(step), before = state_before(step, now);
        if (step.first()) {
            begin_phase(step, now, 0);
        } else if (const double share = share_to_event(step, before, now); share < 1.0) {
            step.retry(share);
            return;
        }
        step.memory(highest) = std::max(step.memory(highest), now.pressure);
        write_row(step, now);
        const bool done = !move_on(step, now);
        step.memory(strain_before) = now.strain;
        step.memory(pressure_before) = now.pressure;
        step.memory(volume_before) = now.volume;
        if (done) {
            step.control(velocity) = 0.0;
            step.emit();
            step.finish();
        } else {
            command(step, before, now);
        }
    }

    static State state(gault::Step& step) {
        const double a0 = step.measure(initial_radius);
        if (!(a0 > 0.0))
            throw std::runtime_error("a pressuremeter is `on` a cylindrical surface; it has no radius");
        if (step.first()) step.memory(initial_volume) = step.measure(enclosed_volume);
        return {step.time(), step.measure(radius) / a0 - 1.0, step.measure(normal_force) / step.measure(area),
                step.measure(enclosed_volume) / step.memory(initial_volume)};
    }
    static State state_before(gault::Step& step, const State& now) {
        if (step.first()) return now;
        return {now.time - step.dt(), step.memory(strain_before), step.memory(pressure_before),
                step.memory(volume_before)};
    }
    static Origin phase_origin(gault::Step& step) {
        return {{step.memory(phase_time), step.memory(phase_strain), step.memory(phase_pressure)},
                step.memory(highest)};
    }
    static Origin part_origin(gault::Step& step) {
        return {{step.memory(part_time), step.memory(part_strain), step.memory(part_pressure)},
                step.memory(highest)};
    }

    static void begin_phase(gault::Step& step, const State& now, int number) {
        step.memory(phase_number) = number;
        step.memory(phase_time) = now.time;
        step.memory(phase_strain) = now.strain;
        step.memory(phase_pressure) = step.memory(highest) = now.pressure;
        begin_part(step, now, 0);
    }
    static void begin_part(gault::Step& step, const State& now, int number) {
        step.memory(part_number) = number;
        step.memory(part_time) = now.time;
        step.memory(part_strain) = now.strain;
        step.memory(part_pressure) = now.pressure;
    }

    const Phases::value_type& present_phase(gault::Step& step) const {
        return phases[static_cast<std::size_t>(step.memory(phase_number))];
    }
    std::optional<Part> present(gault::Step& step) const {
        const Setting setting{step.measure(initial_radius), step.time(), rate, strain_rate};
        const int number = static_cast<int>(step.memory(part_number));
        return std::visit(
            [&](const auto& one) { return one.part(number, setting, phase_origin(step), part_origin(step)); },
            present_phase(step));
    }

    // The share of the step that ended after which the first event was reached; 1 where none was overshot.
    double share_to_event(gault::Step& step, const State& before, const State& now) const {
        const Part part = present(step).value();
        if (part.drive == Part::Drive::wall && part.rate > 0.0 &&
            now.strain < step.memory(part_strain) - sent)
            throw std::runtime_error(
                "a pressuremeter opens a cavity; the radius of this surface falls as the wall "
                "moves into the soil");
        double share = 1.0;
        if (!step.repeatable() || step.dt() <= 1e-12 * longest(part, before, step.measure(initial_radius)))
            return share;
        for (const Event& event : part.ends)
            if (event.overshot(now))
                share = std::min(share, event.left(before) / (event.left(before) - event.left(now)));
        return share;
    }

    static constexpr double rows_of_a_loop = 10.0; // each way, at least, so that it is drawn as what it is

    // s, over which a part may change much.
    static double longest(const Part& part, const State& now, double a0) {
        if (part.rate == 0.0) return gault::infinity;
        return part.drive == Part::Drive::wall ? 0.05 * (1.0 + now.strain) * a0 / std::abs(part.rate)
                                               : std::max(std::abs(now.pressure), 1e4) / std::abs(part.rate);
    }

    // s, from one end of a loop to the other.
    static double way_of_a_loop(gault::Step& step, const Part& part, const Path& path) {
        if (part.drive == Part::Drive::wall) return path.end();
        double way = gault::infinity;
        for (const Event& event : part.ends)
            if (event.is(&State::pressure) && part.rate != 0.0)
                way = std::min(way, std::abs((event.target - step.memory(part_pressure)) / part.rate));
        return way;
    }

    // To the part that lies ahead; false at the end of the test.
    bool move_on(gault::Step& step, const State& now) const {
        for (;;) {
            const auto part = present(step);
            bool phase_ended = !part;
            if (part) {
                const auto reached = std::find_if(part->ends.begin(), part->ends.end(),
                                                  [&](const Event& e) { return e.reached(now); });
                if (reached == part->ends.end()) return true;
                step.emit();
                phase_ended = reached->ends_phase;
            }
            if (!phase_ended) {
                begin_part(step, now, static_cast<int>(step.memory(part_number)) + 1);
                continue;
            }
            if (const auto* loops = std::get_if<Loop>(&present_phase(step)))
                step.memory(loops_before) += loops->count;
            const auto next = static_cast<std::size_t>(step.memory(phase_number)) + 1;
            if (next == phases.size()) return false;
            begin_phase(step, now, static_cast<int>(next));
        }
    }

    // Sets what the wall does until the next event.
    void command(gault::Step& step, const State& before, const State& now) const {
        const Part part = present(step).value();
        const double a0 = step.measure(initial_radius), since = now.time - step.memory(part_time);
        const Path path = path_of(step, part, a0);
        double next = next_event(step, part, before, now, step.memory(part_time));
        if (part.drive == Part::Drive::wall) next = std::min(next, step.memory(part_time) + path.end());
        if (step.repeatable() && part.loop > 0)
            next = std::min(next, now.time + way_of_a_loop(step, part, path) / rows_of_a_loop);
        for (const double reading : part.readings)
            if (const double at = step.memory(part_time) + reading; at > now.time * (1.0 + 1e-12))
                next = std::min(next, at);
        if (step.repeatable() && row_strain && part.drive == Part::Drive::wall && part.rate != 0.0)
            next = std::min(next, next_row(part, now, a0));
        next = std::max(next, now.time + resolved(now.time));
        step.stop_at(next);
        const double dt = std::min(step.next_dt(), next - now.time);
        if (part.drive == Part::Drive::wall) {
            const double way = (now.strain - step.memory(part_strain)) * a0;
            const double wanted = part.rate == 0.0 ? 0.0 : std::copysign(path.travel(since + dt), part.rate);
            step.control(velocity) = (wanted - way) / dt;
            step.control(drive) = 0.0;
        } else {
            step.control(pressure) = step.memory(part_pressure) + part.rate * (since + dt);
            step.control(drive) = 1.0;
        }
    }

    // The wall's, which stops where a strain is to be reached and something follows.
    Path path_of(gault::Step& step, const Part& part, double a0) const {
        if (part.drive == Part::Drive::pressure || part.rate == 0.0)
            return {1.0, 0.0, gault::infinity, false};
        const double speed = std::abs(part.rate);
        double distance = gault::infinity;
        for (const Event& event : part.ends)
            if (event.is(&State::strain))
                distance = std::min(distance, event.sign * (event.target - step.memory(part_strain)) * a0);
        const double usual = step.repeatable() ? 0.0 : 5e-4;
        const double start = ramp_time ? *ramp_time : 2.0 * ramp_strain.value_or(usual) * a0 / speed;
        const bool last = step.memory(phase_number) + 1.0 == static_cast<double>(phases.size());
        return {speed, start, distance, !last};
    }

    // What the last step tells of the time of the next event; with inertia steps are too short to tell.
    static double next_event(const gault::Step& step, const Part& part, const State& before, const State& now,
                             double began) {
        double next = now.time + longest(part, now, step.measure(initial_radius));
        const double dt = now.time - std::max(before.time, began);
        const bool sent_there = part.drive == Part::Drive::wall;
        for (const Event& event : part.ends) {
            if (event.is(&State::time)) {
                next = std::min(next, event.target);
            } else if (!sent_there && event.is(&State::pressure) && part.rate != 0.0) {
                next = std::min(next, now.time + (event.target - now.pressure) / part.rate);
            } else if (step.repeatable() && dt > 0.0 && !(sent_there && event.is(&State::strain))) {
                const double speed = (event.left(before) - event.left(now)) / dt;
                if (speed > 0.0) next = std::min(next, now.time + event.left(now) / speed);
            }
        }
        return next;
    }

    double next_row(const Part& part, const State& now, double a0) const {
        const double at = now.strain, size = *row_strain;
        const double target =
            part.rate > 0.0 ? std::floor((at + sent) / size) + 1.0 : std::ceil((at - sent) / size) - 1.0;
        return now.time + (target * size - at) * a0 / part.rate;
    }

    void write_row(gault::Step& step, const State& now) const {
        const Part part = step.first() ? Part{} : present(step).value();
        step.record(cavity_strain) = now.strain;
        step.record(true_pressure) = now.pressure;
        step.record(nominal_pressure) = step.measure(normal_force) / step.measure(initial_area);
        step.record(cavity_radius) = step.measure(radius);
        step.record(volume) = step.measure(enclosed_volume);
        step.record(phase) = step.memory(phase_number) + 1.0;
        step.record(loop) = part.loop > 0 ? step.memory(loops_before) + part.loop : 0.0;
        step.record(pressure_step) = part.pressure_step;
        step.record(held) = part.held ? 1.0 : 0.0;

        const double row = std::floor((now.strain + sent) / row_strain.value_or(2.5e-4));
        bool due = step.first() || step.repeatable() || row != step.memory(last_row);
        for (const double reading : part.readings)
            due |= std::abs(step.memory(part_time) + reading - now.time) <= 1e-12 * now.time;
        step.memory(last_row) = row;
        if (due) step.emit();
    }

    void evaluate(const gault::History& history, gault::Report& report) const {
        Rows rows;
        for (int64_t i = 0; i < history.rows(); ++i) {
            const auto number = [&](int column) { return static_cast<int>(history.record(column, i)); };
            rows.push_back({history.record(cavity_strain, i), history.record(true_pressure, i),
                            history.record(volume, i), number(phase), number(loop), number(pressure_step),
                            number(held) == 1});
        }
        const Assumptions assumed{critical_friction_angle, pore_pressure, fit_from, fit_to,
                                  menard_poisson_ratio};
        Interpretation(std::move(rows), assumed, report).all();
    }
};

} // namespace pressuremeter

GAULT_MODULE("pressuremeter", "1.1.0", "The Gault authors", "MIT",
             gault::Program<pressuremeter::Pressuremeter>)
