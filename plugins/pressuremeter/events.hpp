// What ends a phase of the test.
#pragma once
#include <gault/program.hpp>

#include <cmath>
#include <limits>

namespace pressuremeter {

// As a scene writes them: until: {cavity_strain: 10 %}, or a list of which the first one reached counts.
struct CavityStrain {
    static constexpr const char* name = "cavity_strain";
    static constexpr const char* doc = "The cavity strain (a - a0) / a0 reaches a value.";
    double value;
    static constexpr std::array parameters{
        gault::parameter<&CavityStrain::value>("value", "", "1", "(a - a0) / a0.").above(-1)};
};
struct Pressure {
    static constexpr const char* name = "pressure";
    static constexpr const char* doc = "The true pressure reaches a value.";
    double value;
    static constexpr std::array parameters{
        gault::parameter<&Pressure::value>("value", "", "Pa", "Compression positive.")};
};
struct PressureDrop {
    static constexpr const char* name = "pressure_drop";
    static constexpr const char* doc = "The true pressure has fallen from its highest value in the phase.";
    double value;
    static constexpr std::array parameters{
        gault::parameter<&PressureDrop::value>("value", "", "Pa", "By how much.").above(0)};
};
struct VolumeRatio {
    static constexpr const char* name = "volume_ratio";
    static constexpr const char* doc = "The volume of the cavity over the initial one reaches a value.";
    double value;
    static constexpr std::array parameters{
        gault::parameter<&VolumeRatio::value>("value", "", "1", "2: the volume has doubled.").above(0)};
};
struct Duration {
    static constexpr const char* name = "duration";
    static constexpr const char* doc = "The phase has lasted so long.";
    double value;
    static constexpr std::array parameters{
        gault::parameter<&Duration::value>("value", "", "s", "Since the phase began.").at_least(0)};
};
using Until = gault::Records<CavityStrain, Pressure, PressureDrop, VolumeRatio, Duration>;

struct State {                                                     // of the test
    double time = 0.0, strain = 0.0, pressure = 0.0, volume = 1.0; // s; 1; Pa, true; over the initial one
};
struct Origin { // where a phase or a part of it began
    State state;
    double highest = 0.0; // pressure since, Pa
};

// `quantity` passes `target` in the direction of `sign`.
struct Event {
    double State::*quantity;
    double target, sign;
    double tolerance;       // far below what a reading resolves, far above what equilibrium leaves open
    bool ends_phase = true; // or only its present part

    bool is(double State::*other) const { return quantity == other; }
    double left(const State& s) const { return sign * (target - s.*quantity); } // negative: passed
    bool reached(const State& s) const { return left(s) <= tolerance; }
    bool overshot(const State& s) const { return left(s) < -tolerance; }
};

// A driven wall goes where it is sent, but for rounding; with a driven pressure the strain follows.
constexpr double sent = 1e-12, followed = 1e-9;

// s: what rounding leaves open of a time.
inline double resolved(double time) {
    return 4.0 * std::numeric_limits<double>::epsilon() * time;
}

inline Event strain_event(double target, double sign, double tolerance) {
    return {&State::strain, target, sign, tolerance};
}
inline Event pressure_event(double target, double sign, const Origin& origin) {
    return {&State::pressure, target, sign, 1e-6 * std::max(std::abs(target), std::abs(origin.highest))};
}
inline Event time_event(double target) {
    return {&State::time, target, 1.0, 1e-12 * target};
}

// In the phase that began at `origin` and moves the wall in the direction of `sign`.
inline Event event_of(const Until::value_type& item, const Origin& origin, double sign,
                      double strain_tolerance) {
    if (const auto* e = std::get_if<CavityStrain>(&item))
        return strain_event(e->value, sign, strain_tolerance);
    if (const auto* e = std::get_if<Pressure>(&item)) return pressure_event(e->value, sign, origin);
    if (const auto* e = std::get_if<PressureDrop>(&item))
        return pressure_event(origin.highest - e->value, -1.0, origin);
    if (const auto* e = std::get_if<VolumeRatio>(&item))
        return {&State::volume, e->value, sign, 1e-8 * e->value};
    return time_event(origin.state.time + std::get<Duration>(item).value);
}

inline std::vector<Event> events_of(const Until& until, const Origin& origin, double sign,
                                    double strain_tolerance) {
    std::vector<Event> events;
    for (const auto& item : until)
        events.push_back(event_of(item, origin, sign, strain_tolerance));
    return events;
}

} // namespace pressuremeter
