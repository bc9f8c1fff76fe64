#include <gault/observer.hpp>

#include <cmath>

// How the pressure is spread over the volume of the soil.
struct NewObserver {
    static constexpr const char* name = "new_observer";
    static constexpr const char* version = "1.0.0"; // in every result: raise it when a number changes
    static constexpr const char* doc =
        "Mean pressure of the soil, and how much of it bears more than a limit.";

    double limit;
    static constexpr std::array parameters{
        gault::parameter<&NewObserver::limit>("limit", "p_l", "Pa", "Mean stress, compression positive.")};

    enum { mean_pressure, share_above };
    static constexpr std::array results{
        gault::signal("mean_pressure", "Pa", "Of all points, by their volume; compression positive."),
        gault::signal("share_above", "1", "Of the volume, where the pressure is above the limit.")};

    // All points, whenever results are due.
    void evaluate(gault::Sample& sample) const {
        double volume = 0, product = 0, above = 0;
        for (int64_t i = 0; i < sample.count(); ++i) {
            const double pressure = -(sample.stress(0, i) + sample.stress(1, i) + sample.stress(2, i)) / 3;
            volume += sample.volume(i);
            product += sample.volume(i) * pressure;
            if (pressure > limit) above += sample.volume(i);
        }
        sample.result(mean_pressure) = product / volume;
        sample.result(share_above) = above / volume;
    }
};

GAULT_MODULE("new_observer", "1.0.0", "Your name", "MIT", gault::Observer<NewObserver>)
