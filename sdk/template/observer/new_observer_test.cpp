#include <gault/gault.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

void expect(double found, double expected, double tolerance, const char* what) {
    if (std::fabs(found - expected) <= tolerance) return;
    std::printf("%s: found %.17g, expected %.17g +- %g\n", what, found, expected, tolerance);
    std::exit(1);
}

struct Results {
    double mean_pressure, share_above;
};

// The plugin without a host, called through the contract as a host calls it: points under these pressures.
Results observe(double limit, const std::vector<double>& pressure, const std::vector<double>& volume) {
    const gault_component& observer = *GAULT_ENTRY.components[0];
    gault_value value{};
    value.real = limit, value.count = 1;
    gault_host host{};
    host.size = sizeof host;
    gault_error error{};
    void* self = nullptr;
    expect(observer.create(&host, &value, &self, &error), GAULT_OK, 0, "status of create()");
    std::vector<double> direct, shear(pressure.size(), 7e3);
    for (const double p : pressure)
        direct.push_back(-p);
    double found[2] = {};
    gault_sample sample{};
    sample.size = sizeof sample, sample.count = static_cast<int64_t>(pressure.size());
    for (int i = 0; i < 6; ++i)
        sample.stress[i] = i < 3 ? direct.data() : shear.data();
    sample.volume = volume.data();
    sample.result = found;
    const auto& api = *static_cast<const gault_observer_api*>(observer.api);
    expect(api.evaluate(self, &sample, &error), GAULT_OK, 0, "status of evaluate()");
    observer.destroy(self);
    return {found[0], found[1]};
}

void weighs_points_by_their_volume() {
    const Results r = observe(1e5, {9e4, 1.2e5, 2e5}, {2, 1, 1});
    expect(r.mean_pressure, 1.25e5, 1e-6, "mean pressure");
    expect(r.share_above, 0.5, 1e-15, "share above the limit");
}

} // namespace

int main() {
    weighs_points_by_their_volume();
    std::puts("new_observer: all right");
}
