// One material point without a host: the plugin is called through the contract as a host calls it.
#pragma once
#include <gault/gault.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using Tensor = std::array<double, 6>; // xx yy zz xy yz zx; tension positive, tensor shear

inline void expect(double found, double expected, double tolerance, const char* what) {
    if (std::fabs(found - expected) <= tolerance) return;
    std::printf("%s: found %.17g, expected %.17g +- %g\n", what, found, expected, tolerance);
    std::exit(1);
}

class OnePoint {
  public:
    Tensor stress{}; // Pa
    std::vector<double> state;

    // Values of the parameters, in the order of their declaration.
    explicit OnePoint(const std::vector<double>& values) {
        gault_error error{};
        expect(create(values, &self_, &error), GAULT_OK, 0, "status of create()");
        for (uint32_t i = 0; i < api().state_count; ++i)
            state.insert(state.end(), api().states[i].shape, api().states[i].initial);
    }
    ~OnePoint() { model().destroy(self_); }
    OnePoint(const OnePoint&) = delete;
    OnePoint& operator=(const OnePoint&) = delete;

    // OK: stress and state are those at the end of the increment.
    gault_status strain(const Tensor& increment) {
        std::vector<Lanes> strains(6), old(6), now(6), old_state(state.size()), new_state(state.size());
        std::vector<double*> old_states, new_states; // one array a component
        gault_points batch{};
        batch.size = sizeof batch, batch.count = 1, batch.padded = GAULT_LANES, batch.dt = 1;
        for (std::size_t i = 0; i < 6; ++i) {
            batch.strain[i] = fill(strains[i], increment[i]);
            batch.stress_old[i] = fill(old[i], stress[i]);
            batch.stress[i] = now[i].value;
        }
        for (std::size_t i = 0; i < state.size(); ++i) {
            old_states.push_back(fill(old_state[i], state[i]));
            new_states.push_back(new_state[i].value);
        }
        batch.state_old = old_states.data(), batch.state = new_states.data();
        gault_error error{};
        const gault_status status = api().update(self_, &batch, &error);
        if (status != GAULT_OK) return status;
        for (std::size_t i = 0; i < 6; ++i)
            stress[i] = now[i].value[0];
        for (std::size_t i = 0; i < state.size(); ++i)
            state[i] = new_state[i].value[0];
        return status;
    }

    // The parameter that is named when these values are refused; "" where they are not.
    static std::string refused(const std::vector<double>& values) {
        gault_error error{};
        void* self = nullptr;
        const gault_status status = create(values, &self, &error);
        if (status == GAULT_OK) model().destroy(self);
        if (status != GAULT_INVALID) return "";
        return error.parameter < 0 ? "a parameter that is not declared" : model().parameters[error.parameter]->name;
    }

  private:
    struct alignas(64) Lanes { // the batch has one point; the other lanes repeat it
        double value[GAULT_LANES];
    };
    static double* fill(Lanes& lanes, double value) {
        for (double& lane : lanes.value)
            lane = value;
        return lanes.value;
    }
    static const gault_component& model() { return *GAULT_ENTRY.components[0]; }
    static const gault_material_api& api() { return *static_cast<const gault_material_api*>(model().api); }
    static gault_status create(const std::vector<double>& values, void** self, gault_error* error) {
        std::vector<gault_value> given(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            given[i].real = values[i], given[i].count = 1;
        gault_host host{};
        host.size = sizeof host;
        return model().create(&host, given.data(), self, error);
    }

    void* self_ = nullptr;
};
