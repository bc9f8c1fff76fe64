// The biaxial test on sand that softens, on n cells along 40 mm.
#pragma once
#include "tests/hard/hard_scene.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <numbers>

namespace gault::core::test {

struct Biaxial {
    std::vector<double> way, load; // of the plate: mm; kPa over the initial width
    double width, angle;           // of the band: mm, degrees
    double cell;                   // mm

    // `length`: the regularisation length, mm; 0: none, which is that of the cells.
    Biaxial(int n, double length, double until, const std::vector<Override>& more = {}) : cell(40.0 / n) {
        std::vector<Override> all{
            {"grid.cells", cells(n, 5 * n / 2)},
            {"materials.sand.regularisation_length", fmt::format("{} mm", length > 0.0 ? length : cell)},
            {"program.velocity",
             fmt::format("[[0 s, 0 mm/s], [10 ms, 20 mm/s], [{} ms, 20 mm/s]]", 50.0 * until + 5.0)}};
        all.insert(all.end(), more.begin(), more.end());
        HardScene s("hard/biaxial", all);
        s.run();
        way = s.column("displacement");
        load = s.column("normal_force");
        for (std::size_t i = 0; i < way.size(); ++i)
            way[i] *= 1e3, load[i] /= 40.0;
        measure_band(s);
        std::printf("%2d cells, length %2.0f mm: load %.1f kPa at 1 mm, %.1f at the end; work %.1f kPa mm; "
                    "band %.2f mm = %.2f "
                    "cells, %.1f deg\n",
                    n, length, load_at(1.0), load.back(), work(), width, width / cell, angle);
    }

    double load_at(double u) const {
        std::size_t i = 1;
        while (i + 1 < way.size() && way[i] < u)
            ++i;
        return load[i - 1] + (load[i] - load[i - 1]) * (u - way[i - 1]) / (way[i] - way[i - 1]);
    }
    double peak() const { return *std::max_element(load.begin(), load.end()); }
    double work() const { // of the plate, over the initial width
        double sum = 0.0;
        for (std::size_t i = 1; i < way.size(); ++i)
            sum += 0.5 * (load[i] + load[i - 1]) * (way[i] - way[i - 1]);
        return sum;
    }

  private:
    // The width that a band of one strain would have, with as much strain and as large a square of it: between x = 10 and 30 mm,
    // away from its ends.
    void measure_band(const HardScene& s) {
        const PointArrays p = s.points();
        const std::vector<double> strain = collect_state(s.solver.motion(), "plastic_strain");
        double sum = 0.0, squares = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
        for (std::size_t i = 0; i < strain.size(); ++i) {
            if (p.reference[0][i] < 0.01 || p.reference[0][i] > 0.03) continue;
            const double w = strain[i] * strain[i];
            sum += strain[i];
            squares += w;
            x += w * p.reference[0][i], y += w * p.reference[1][i];
            xx += w * p.reference[0][i] * p.reference[0][i], xy += w * p.reference[0][i] * p.reference[1][i];
        }
        const double slope = (xy - x * y / squares) / (xx - x * x / squares);
        const double length = 20.0 * std::sqrt(1.0 + slope * slope), area = 0.25 * cell * cell;
        angle = std::atan(slope) * 180.0 / std::numbers::pi;
        width = sum * sum / squares * area / length;
    }
};

// |a - b| / b while the plate moves between these ways, mm: mean and largest.
struct Difference {
    double mean = 0.0, largest = 0.0;
    Difference(const Biaxial& a, const Biaxial& b, double from, double to) {
        constexpr int parts = 200;
        for (int i = 0; i <= parts; ++i) {
            const double u = from + (to - from) * i / parts, d = std::abs(a.load_at(u) / b.load_at(u) - 1.0);
            mean += d / (parts + 1);
            largest = std::max(largest, d);
        }
        std::printf("loads apart by %.2f %%, at most %.2f %%\n", 100.0 * mean, 100.0 * largest);
    }
};

} // namespace gault::core::test
