// How far a wall has travelled that starts and stops smoothly.
#pragma once
#include <cmath>
#include <limits>

namespace pressuremeter {

// Travel at the speed V after a start over the time T, s = t / T:
//     t <= T: u = V T s^4 (5/2 - 3 s + s^2), the integral of the velocity V (10 s^3 - 15 s^4 + 6 s^5)
//     t >= T: u = V (t - T / 2)
// Where the distance D is known the stop mirrors the start: it takes D / V + T. A distance shorter than V T is
// travelled at the speed D / T.
class Path {
  public:
    Path(double speed, double start, double distance = std::numeric_limits<double>::infinity())
        : speed_(distance < speed * start ? distance / start : speed), start_(start), distance_(distance),
          end_(distance / speed_ + start) {}

    double end() const { return end_; } // s, infinite where the distance is
    double travel(double time) const {
        if (time >= end_) return distance_;
        if (time > end_ - start_) return distance_ - early(end_ - time);
        return time < start_ ? early(time) : speed_ * (time - 0.5 * start_);
    }

  private:
    double early(double time) const {
        const double s = time / start_;
        return speed_ * start_ * s * s * s * s * (2.5 - s * (3.0 - s));
    }
    double speed_, start_, distance_, end_; // m/s, s, m, s
};

} // namespace pressuremeter
