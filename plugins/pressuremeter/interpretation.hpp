// What engineers derive from a pressuremeter curve, each with its source, or the reason why not.
#pragma once
#include <gault/program.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace pressuremeter {

struct Row { // of the history
    double strain, pressure, volume;
    int phase, loop, pressure_step;
    bool held;
};
using Rows = std::vector<Row>;

struct Assumptions {
    std::optional<double> critical_friction_angle; // rad
    double pore_pressure, fit_from, fit_to, menard_poisson_ratio;
};

struct Line {
    double slope, intercept;
    double scatter; // root mean square of the residuals over the range of y
};

inline Line fit(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0, left = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        mx += x[i] / n, my += y[i] / n;
    for (std::size_t i = 0; i < x.size(); ++i)
        xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
    const double slope = xy / xx, intercept = my - slope * mx;
    for (std::size_t i = 0; i < x.size(); ++i)
        left += std::pow(y[i] - slope * x[i] - intercept, 2);
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    return {slope, intercept, std::sqrt(left / n) / (*high - *low)};
}

constexpr double degrees = 180.0 / gault::pi;

// A straight line leaves less; the curve of a soil for which the analysis is not made leaves more: 3 % for a
// frictional one in Gibson and Anderson's plot, 2 % for an undrained clay in Hughes'.
constexpr double straight = 0.01;

// First loading: rows outside loops at which the cavity is wider than ever; of a held step the last one.
inline Rows first_loading(const Rows& rows) {
    Rows all;
    for (const Row& row : rows) {
        const bool same_step = !all.empty() && row.pressure_step > 0 && row.phase == all.back().phase &&
                               row.pressure_step == all.back().pressure_step;
        if (row.loop > 0 || (!all.empty() && !same_step && row.strain <= all.back().strain)) continue;
        if (same_step) all.pop_back();
        all.push_back(row);
    }
    return all;
}

// The pressure where `x` of a row reaches a value, along straight lines between rows; NaN where it never does.
template <class X>
double pressure_at(const Rows& rows, double value, X x) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double low = x(rows[i - 1]), high = x(rows[i]);
        if (low <= value && value <= high && low < high)
            return rows[i - 1].pressure +
                   (rows[i].pressure - rows[i - 1].pressure) * (value - low) / (high - low);
    }
    return std::nan("");
}
inline double pressure_at_strain(const Rows& rows,
                                 double strain) { // log-log: a curve of sand is straight there
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i - 1].strain <= strain && strain <= rows[i].strain && rows[i - 1].strain > 0.0)
            return rows[i - 1].pressure * std::pow(rows[i].pressure / rows[i - 1].pressure,
                                                   std::log(strain / rows[i - 1].strain) /
                                                       std::log(rows[i].strain / rows[i - 1].strain));
    return std::nan("");
}

inline std::string percent(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g %%", 100.0 * value);
    return text;
}

class Interpretation {
  public:
    Interpretation(Rows rows, const Assumptions& assumed, gault::Report& report)
        : rows_(std::move(rows)), loading_(first_loading(rows_)), assumed_(assumed), report_(report) {}

    void all() const {
        lift_off();
        menard();
        limit_pressure();
        loops();
        hughes();
        gibson_anderson();
    }

  private:
    void lift_off() const {
        const char* name = "lift_off_stress";
        const char* source = "Mair and Wood (1987), section 5.2: the pressure at which the wall first moves";
        const double still = 1e-9; // cavity strain
        std::size_t i = 0;
        while (i < rows_.size() && rows_[i].strain <= still)
            ++i;
        if (i == 0 || i == rows_.size())
            return report_.absent(name, "the cavity was not opened from its initial radius", source);
        const Row &before = rows_[i - 1], &after = rows_[i];
        const double share = std::max(0.0, -before.strain) / (after.strain - before.strain);
        report_.result(name, "Pa", before.pressure + share * (after.pressure - before.pressure), source,
                       "where the cavity first leaves its initial radius");
    }

    // The points of the Menard curve: where the first step began, and the last reading of every held step.
    Rows menard_points() const {
        const auto stepping = [](const Row& row) { return row.pressure_step > 0; };
        const auto first = std::find_if(rows_.begin(), rows_.end(), stepping);
        Rows points;
        if (first == rows_.end() || first == rows_.begin()) return points;
        points.push_back(*(first - 1));
        for (auto row = first; row != rows_.end(); ++row) {
            if (!row->held) continue;
            if (points.size() > 1 && points.back().phase == row->phase &&
                points.back().pressure_step == row->pressure_step)
                points.pop_back();
            points.push_back(*row);
        }
        return points;
    }

    void menard() const {
        const Rows points = menard_points();
        const double volume = menard_modulus(points);
        menard_limit(points, volume);
    }

    // ISO 22476-4 (2012), D.2: the pseudo-elastic range is where dV/dp is within beta of its least. Returns the
    // cavity's volume at the range's start, or the initial one.
    double menard_modulus(const Rows& points) const {
        const char* name = "menard_modulus";
        const char* source =
            "ISO 22476-4 (2012), D.2: E_M = 2 (1 + nu) V_m dp/dV, V_m the mean volume of the cavity";
        const double initial = rows_.empty() ? 1.0 : rows_[0].volume;
        if (points.size() < 4) {
            report_.absent(name, "needs a phase of pressure_steps with at least three held steps", source);
            return initial;
        }
        const auto compliance = [&](std::size_t i) {
            return (points[i].volume - points[i - 1].volume) / (points[i].pressure - points[i - 1].pressure);
        };
        std::size_t best = 1;
        for (std::size_t i = 2; i < points.size(); ++i)
            if (compliance(i) < compliance(best)) best = i;
        const Row &low = points[best - 1], &high = points[best];
        const double beta = 1.0 + 0.01 * (high.pressure + low.pressure) / (high.pressure - low.pressure);
        std::size_t first = best - 1, last = best;
        while (first > 0 && compliance(first) <= beta * compliance(best))
            --first;
        while (last + 1 < points.size() && compliance(last + 1) <= beta * compliance(best))
            ++last;
        const Row &from = points[first], &to = points[last];
        char note[160];
        std::snprintf(note, sizeof note, "over %.4g to %.4g kPa, with nu = %g by convention",
                      1e-3 * from.pressure, 1e-3 * to.pressure, assumed_.menard_poisson_ratio);
        report_.result(name, "Pa",
                       (1.0 + assumed_.menard_poisson_ratio) * (from.volume + to.volume) *
                           (to.pressure - from.pressure) / (to.volume - from.volume),
                       source, note);
        return from.volume;
    }

    // ISO 22476-4 (2012), D.4: at twice the volume that the cavity has at the start of the pseudo-elastic range.
    void menard_limit(const Rows& points, double volume) const {
        const char* name = "menard_limit_pressure";
        const char* source = "ISO 22476-4 (2012), D.4: the pressure at twice the volume of the cavity";
        const double doubled = pressure_at(rows_, 2.0 * volume, [](const Row& r) { return r.volume; });
        if (std::isfinite(doubled)) return report_.result(name, "Pa", doubled, source, "measured");
        const Rows& curve = points.size() >= 4 ? points : loading_;
        if (curve.size() < 4 || curve.back().volume < 1.5 * volume)
            return report_.absent(
                name, "the cavity's volume grew by less than a half: too little to extrapolate from", source);
        std::vector<double> pressure, reciprocal;
        for (std::size_t i = curve.size() - 3; i < curve.size(); ++i) {
            pressure.push_back(curve[i].pressure);
            reciprocal.push_back(1.0 / (curve[i].volume - rows_[0].volume));
        }
        const Line line = fit(pressure, reciprocal);
        const double limit = (1.0 / (2.0 * volume - rows_[0].volume) - line.intercept) / line.slope;
        if (!(limit > curve.back().pressure))
            return report_.absent(name, "the reciprocal volume does not fall as the pressure rises", source);
        report_.result(
            name, "Pa", limit, source,
            "extrapolated from the last three points by the reciprocal volume, the widest cavity being " +
                percent(curve.back().volume / volume) + " of the volume at the start");
    }

    // Pressures at three radii in equal ratios approach their limit as a geometric sequence.
    void limit_pressure() const {
        const char* name = "limit_pressure";
        const char* source = "Aitken (1926): delta-squared extrapolation of p at a, a / 1.25, a / 1.25^2";
        const double ratio = 1.25, a = loading_.empty() ? 1.0 : 1.0 + loading_.back().strain;
        if (a < 2.0 - 1e-6)
            return report_.absent(name, "the radius was not doubled: too far from the limit to extrapolate",
                                  source);
        const double p0 = pressure_at_strain(loading_, a / ratio / ratio - 1.0),
                     p1 = pressure_at_strain(loading_, a / ratio - 1.0), p2 = loading_.back().pressure;
        const double first = p1 - p0, second = p2 - p1;
        if (!(first > second && second >= 0.0))
            return report_.absent(name, "the pressure does not level off", source);
        report_.result(name, "Pa", p2 + second * second / (first - second), source,
                       "in the limit of an infinitely wide cavity; extrapolated from a / a0 = " +
                           std::to_string(a).substr(0, 4) +
                           (a < 4.0 ? "; 1 to 4 % low from twice the radius, less from more" : ""));
    }

    void loops() const {
        int last = 0;
        for (const Row& row : rows_)
            last = std::max(last, row.loop);
        if (last == 0)
            report_.absent("loop_1_shear_modulus", "the test has no unload-reload loop", "Wroth (1982)");
        for (int number = 1; number <= last; ++number)
            loop(number);
    }

    // Between the ends of the loop: where unloading began, and where it turned.
    void loop(int number) const {
        const auto first =
            std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.loop == number; });
        if (first == rows_.end() || first == rows_.begin()) return;
        const Row& start = *(first - 1);
        const Row* turn = &*first;
        for (auto r = first; r != rows_.end() && r->loop == number; ++r)
            if (r->strain < turn->strain) turn = &*r;
        const std::string name = "loop_" + std::to_string(number) + "_";
        if (!(turn->pressure > 0.0))
            return report_.absent(name + "shear_modulus", "the loop took the pressure below zero",
                                  "Wroth (1982)");
        const char* source = "Wroth (1982): G_ur = 0.5 dp / d(ln a)";
        const double range = std::log((1.0 + start.strain) / (1.0 + turn->strain));
        report_.result(name + "shear_modulus", "Pa", 0.5 * (start.pressure - turn->pressure) / range, source,
                       "secant between the ends of the loop");
        report_.result(name + "amplitude", "1", range, source, "range of ln(a)");
        report_.result(name + "mean_pressure", "Pa", 0.5 * (start.pressure + turn->pressure), source);
    }

    // x and y of first loading at 81 equally spaced strains of the range of the fits; empty where it was not covered.
    template <class F>
    std::pair<std::vector<double>, std::vector<double>> sampled(F f) const {
        std::pair<std::vector<double>, std::vector<double>> xy;
        const int intervals = 80;
        for (int i = 0; i <= intervals; ++i) {
            const double share = static_cast<double>(i) / intervals;
            // Not a hair past the last row.
            const double strain = (1.0 - share) * assumed_.fit_from + share * assumed_.fit_to * (1.0 - 1e-7);
            const double p = pressure_at_strain(loading_, strain);
            if (!std::isfinite(p)) return {};
            const auto [x, y] = f(strain, p);
            xy.first.push_back(x);
            xy.second.push_back(y);
        }
        return xy;
    }
    std::string fitted() const {
        return "fitted over " + percent(assumed_.fit_from) + " to " + percent(assumed_.fit_to) +
               " cavity strain";
    }
    std::string not_covered() const {
        return "first loading does not cover " + percent(assumed_.fit_from) + " to " +
               percent(assumed_.fit_to) + " cavity strain";
    }

    // s = d ln(p - u0) / d ln((a - a0) / a); sin phi = s / (1 + (s - 1) sin phi_cv), sin psi = s + (s - 1) sin phi_cv.
    void hughes() const {
        const char* source = "Hughes, Wroth and Windle (1977), Geotechnique 27, 455-477";
        const auto absent = [&](const std::string& reason) {
            report_.absent("friction_angle", reason, source);
            report_.absent("dilation_angle", reason, source);
        };
        if (!assumed_.critical_friction_angle)
            return absent("needs critical_friction_angle, and a drained test in sand");
        const double u0 = assumed_.pore_pressure;
        const auto [x, y] = sampled([&](double strain, double p) {
            return std::pair{std::log(strain / (1.0 + strain)), std::log(p - u0)};
        });
        if (x.empty()) return absent(not_covered());
        const Line line = fit(x, y);
        if (!(line.scatter <= straight))
            return absent("ln p against ln strain is not straight (scatter " + percent(line.scatter) +
                          " of its range): not a drained sand at its full strength");
        const double critical = std::sin(*assumed_.critical_friction_angle), s = line.slope;
        const double sin_phi = s / (1.0 + (s - 1.0) * critical), sin_psi = s + (s - 1.0) * critical;
        if (!(std::abs(sin_phi) < 1.0 && std::abs(sin_psi) < 1.0))
            return absent("the slope " + std::to_string(s) + " belongs to no angle of friction");
        const std::string note = fitted() +
                                 " (a - a0) / a0, against (a - a0) / a; the analysis has no elastic strain "
                                 "in the plastic zone, no cohesion and an "
                                 "infinite soil, and returns less than the strength where they matter";
        report_.result("friction_angle", "deg", std::asin(sin_phi) * degrees, source, note);
        report_.result("dilation_angle", "deg", std::asin(sin_psi) * degrees, source, note);
    }

    // p = p_L + s_u ln(dV / V), dV / V = 1 - (a0 / a)^2.
    void gibson_anderson() const {
        const char* source = "Gibson and Anderson (1961): p = p_L + s_u ln(dV / V)";
        const auto absent = [&](const std::string& reason) {
            report_.absent("undrained_strength", reason, source);
            report_.absent("undrained_limit_pressure", reason, source);
        };
        const auto [x, y] = sampled([](double strain, double p) {
            return std::pair{std::log(1.0 - std::pow(1.0 + strain, -2.0)), p};
        });
        if (x.empty()) return absent(not_covered());
        const Line line = fit(x, y);
        if (!(line.scatter <= straight) || !(line.slope > 0.0))
            return absent("p against ln(dV / V) is not straight (scatter " + percent(line.scatter) +
                          " of its range): not an undrained clay at its full strength");
        const std::string note = fitted() + "; for undrained clay without hardening or softening, and "
                                            "without a bound: a cylinder of 10 (20) cavity radii "
                                            "under constant pressure shows 12 (3) % too little";
        report_.result("undrained_strength", "Pa", line.slope, source, note);
        report_.result("undrained_limit_pressure", "Pa", line.intercept, source, note);
    }

    Rows rows_, loading_;
    Assumptions assumed_;
    gault::Report& report_;
};

} // namespace pressuremeter
