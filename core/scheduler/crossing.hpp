// Notices when a quantity reaches or passes a value, in either direction, for the first time.
#pragma once
#include <limits>

namespace gault::core {

class Crossing {
  public:
    explicit Crossing(double target) : target_(target) {}
    double target() const { return target_; }
    bool done() const { return done_; }
    bool reached(double now); // true once

  private:
    double target_, before_ = std::numeric_limits<double>::quiet_NaN();
    bool done_ = false;
};

} // namespace gault::core
