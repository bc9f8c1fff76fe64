// The phases of a test, and the parts that each is made of.
#pragma once
#include "events.hpp"

#include <algorithm>

namespace pressuremeter {

struct Setting {     // what phases take where they do not say it themselves
    double a0, time; // m; s, now
    std::optional<double> rate, strain_rate;
    // Of the cavity strain where a wall is sent at this speed, m/s.
    double tolerance(double speed) const { return std::max(sent, resolved(time) * speed / a0); }
};

// A stretch with one way of driving the wall.
struct Part {
    enum class Drive { wall, pressure };
    Drive drive = Drive::wall;
    double rate = 0.0; // of the wall, m/s, outward positive, or of the pressure, Pa/s; 0: held
    std::vector<Event> ends = {};
    std::vector<double> readings = {}; // s since the part began, rising
    int loop = 0, pressure_step = 0;   // numbers within the phase, from 1; 0: neither
    bool held = false;                 // a pressure step has reached its pressure
};

inline double wall_speed(const std::optional<double>& rate, const std::optional<double>& strain_rate,
                         const Setting& setting) {
    if (rate) return *rate;
    if (strain_rate) return *strain_rate * setting.a0;
    return setting.rate ? *setting.rate : *setting.strain_rate * setting.a0;
}

constexpr const char* rate_doc = "Velocity of the wall.";
constexpr const char* strain_rate_doc = "Rate of the cavity strain.";
constexpr const char* pressure_rate_doc = "Rate of the true pressure, where that is what is driven.";

inline void check_speed(const std::optional<double>& rate, const std::optional<double>& strain_rate,
                        const std::optional<double>& pressure_rate) {
    if (rate.has_value() + strain_rate.has_value() + pressure_rate.has_value() > 1)
        throw std::runtime_error("give one of rate, strain_rate and pressure_rate");
}

// expand and unload.
template <int Direction>
struct Move {
    static constexpr const char* name = Direction > 0 ? "expand" : "unload";
    static constexpr const char* doc =
        Direction > 0 ? "The cavity is opened at a steady rate." : "The cavity is closed at a steady rate.";

    std::optional<double> rate, strain_rate, pressure_rate;
    Until until;
    static constexpr std::array parameters{
        gault::parameter<&Move::rate>("rate", "", "m/s", rate_doc).above(0),
        gault::parameter<&Move::strain_rate>("strain_rate", "", "1/s", strain_rate_doc).above(0),
        gault::parameter<&Move::pressure_rate>("pressure_rate", "", "Pa/s", pressure_rate_doc).above(0),
        gault::parameter<&Move::until>("until", "", "1", "What ends it; of several, the first one reached.")
            .count(1, 0)};

    bool needs_speed() const { return !rate && !strain_rate && !pressure_rate; }
    bool drives_pressure() const { return pressure_rate.has_value(); }
    bool drives_wall() const { return !pressure_rate; }
    void check() const { check_speed(rate, strain_rate, pressure_rate); }
    std::optional<Part> part(int number, const Setting& setting, const Origin& phase, const Origin&) const {
        if (number > 0) return std::nullopt;
        const double speed = pressure_rate ? *pressure_rate : wall_speed(rate, strain_rate, setting);
        return Part{pressure_rate ? Part::Drive::pressure : Part::Drive::wall, Direction * speed,
                    events_of(until, phase, Direction, pressure_rate ? followed : setting.tolerance(speed))};
    }
};
using Expand = Move<1>;
using Unload = Move<-1>;

struct Loop {
    static constexpr const char* name = "loop";
    static constexpr const char* doc = "Unload-reload loops, back to the strain or pressure they began at.";

    std::optional<double> strain_amplitude, pressure_amplitude, rate, strain_rate, pressure_rate;
    int count;
    static constexpr std::array parameters{
        gault::parameter<&Loop::strain_amplitude>("strain_amplitude", "", "1",
                                                  "Fall of the cavity strain; this or pressure_amplitude.")
            .above(0),
        gault::parameter<&Loop::pressure_amplitude>("pressure_amplitude", "", "Pa",
                                                    "Fall of the true pressure; this or strain_amplitude.")
            .above(0),
        gault::parameter<&Loop::rate>("rate", "", "m/s", rate_doc).above(0),
        gault::parameter<&Loop::strain_rate>("strain_rate", "", "1/s", strain_rate_doc).above(0),
        gault::parameter<&Loop::pressure_rate>("pressure_rate", "", "Pa/s", pressure_rate_doc).above(0),
        gault::parameter<&Loop::count>("count", "", "1", "How many, one after the other.")
            .at_least(1)
            .fallback(1)};

    bool needs_speed() const { return !rate && !strain_rate && !pressure_rate; }
    bool drives_pressure() const { return pressure_rate.has_value(); }
    bool drives_wall() const { return !pressure_rate; }
    void check() const {
        check_speed(rate, strain_rate, pressure_rate);
        if (strain_amplitude.has_value() == pressure_amplitude.has_value())
            throw std::runtime_error("give one of strain_amplitude and pressure_amplitude");
    }
    std::optional<Part> part(int number, const Setting& setting, const Origin& phase, const Origin&) const {
        if (number >= 2 * count) return std::nullopt;
        if (pressure_amplitude && !(*pressure_amplitude < phase.state.pressure))
            throw std::runtime_error("a loop falls by more than the pressure it begins at");
        const double direction = number % 2 == 0 ? -1.0 : 1.0, fall = direction < 0.0 ? 1.0 : 0.0;
        const double speed = pressure_rate ? *pressure_rate : wall_speed(rate, strain_rate, setting);
        Event end = strain_amplitude
                        ? strain_event(phase.state.strain - fall * *strain_amplitude, direction,
                                       pressure_rate ? followed : setting.tolerance(speed))
                        : pressure_event(phase.state.pressure - fall * *pressure_amplitude, direction, phase);
        end.ends_phase = false;
        Part part{pressure_rate ? Part::Drive::pressure : Part::Drive::wall, direction * speed, {end}};
        part.loop = number / 2 + 1;
        return part;
    }
};

struct Hold {
    static constexpr const char* name = "hold";
    static constexpr const char* doc = "Nothing is moved: creep under a held pressure, or relaxation.";

    enum class Of { pressure, wall };
    static constexpr const char* words[] = {"pressure", "wall", nullptr};
    double duration;
    std::vector<double> readings;
    Of of;
    static constexpr std::array parameters{
        gault::parameter<&Hold::duration>("duration", "", "s", "How long.").at_least(0),
        gault::parameter<&Hold::readings>("readings", "", "s",
                                          "Times since it began at which a row is written.")
            .above(0)
            .optional(),
        gault::parameter<&Hold::of>("of", "", "1", "What is held.").choices(words).fallback(0)};

    bool needs_speed() const { return false; }
    bool drives_pressure() const { return of == Of::pressure; }
    bool drives_wall() const { return of == Of::wall; }
    void check() const {}
    std::optional<Part> part(int number, const Setting&, const Origin& phase, const Origin&) const {
        if (number > 0) return std::nullopt;
        Part part{of == Of::pressure ? Part::Drive::pressure : Part::Drive::wall,
                  0.0,
                  {time_event(phase.state.time + duration)}};
        part.readings = readings;
        std::sort(part.readings.begin(), part.readings.end());
        return part;
    }
};

struct PressureSteps {
    static constexpr const char* name = "pressure_steps";
    static constexpr const char* doc =
        "Equal steps of pressure, each held with readings (Menard test, ISO 22476-4).";

    double increment, rise, hold;
    std::vector<double> readings;
    std::optional<int> count;
    Until until;
    static constexpr std::array parameters{
        gault::parameter<&PressureSteps::increment>("increment", "", "Pa", "From one step to the next.")
            .above(0),
        gault::parameter<&PressureSteps::rise>("rise", "", "s", "Time in which the pressure rises by it.")
            .above(0)
            .fallback(1.0),
        gault::parameter<&PressureSteps::hold>("hold", "", "s", "Time for which the pressure is then held.")
            .at_least(0)
            .fallback(60.0),
        gault::parameter<&PressureSteps::readings>(
            "readings", "", "s", "Times since the hold began; 1, 15, 30 and 60 s where it lasts so long.")
            .above(0)
            .optional(),
        gault::parameter<&PressureSteps::count>("count", "", "1", "Number of steps.").at_least(1),
        gault::parameter<&PressureSteps::until>("until", "", "1",
                                                "What ends it; of several, the first one reached.")
            .optional()};

    bool needs_speed() const { return false; }
    bool drives_pressure() const { return true; }
    bool drives_wall() const { return false; }
    void check() const {
        if (!count && until.empty()) throw std::runtime_error("give count or until: something must end it");
    }
    std::optional<Part> part(int number, const Setting&, const Origin& phase, const Origin& begun) const {
        const int step = number / 2 + 1;
        if (count && step > *count) return std::nullopt;
        Part part{Part::Drive::pressure, 0.0, events_of(until, phase, 1.0, followed)};
        part.pressure_step = step;
        part.held = number % 2 == 1;
        if (part.held) {
            part.ends.push_back(time_event(begun.state.time + hold));
            part.readings = readings.empty() ? std::vector<double>{1.0, 15.0, 30.0, 60.0} : readings;
            std::sort(part.readings.begin(), part.readings.end());
        } else {
            part.ends.push_back(pressure_event(phase.state.pressure + step * increment, 1.0, phase));
            part.rate = (part.ends.back().target - begun.state.pressure) / rise;
        }
        part.ends.back().ends_phase = false;
        return part;
    }
};

using Phases = gault::Records<Expand, Unload, Loop, Hold, PressureSteps>;

} // namespace pressuremeter
