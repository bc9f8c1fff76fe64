// How far a wall has travelled that starts, and where it is wanted stops, smoothly.
#pragma once
#include <cmath>
#include <limits>

namespace pressuremeter {

// Travel at the speed V after a start over the time T, s = t / T:
//     t <= T: u = V T s^4 (5/2 - 3 s + s^2), the integral of the velocity V (10 s^3 - 15 s^4 + 6 s^5)
//     t >= T: u = V (t - T / 2)
// to the distance D. A stop there mirrors the start: it takes D / V + T, and D / T is the speed where D < V T.
class Path {
  public:
    Path(double speed, double start, double distance, bool stops)
        : speed_(stops && distance < speed * start ? distance / start : speed), start_(start),
          stop_(stops ? start : 0.0), distance_(distance),
          end_(stops ? distance / speed_ + start : time(distance)) {}

    double end() const { return end_; } // s, infinite where the distance is
    double travel(double time) const {
        if (time >= end_) return distance_;
        if (time > end_ - stop_) return distance_ - early(end_ - time);
        return time < start_ ? early(time) : speed_ * (time - 0.5 * start_);
    }

  private:
    double early(double time) const {
        const double s = time / start_;
        return speed_ * start_ * s * s * s * s * (2.5 - s * (3.0 - s));
    }
    double time(double distance) const { // without a stop
        if (distance >= 0.5 * speed_ * start_) return 0.5 * start_ + distance / speed_;
        double before = 0.0, after = start_;
        while (after - before > 1e-15 * start_) {
            const double middle = 0.5 * (before + after);
            (early(middle) < distance ? before : after) = middle;
        }
        return after;
    }
    double speed_, start_, stop_, distance_, end_; // m/s, s, s, m, s
};

} // namespace pressuremeter
