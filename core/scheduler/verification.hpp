// The run against what is known: reference curves, radial profiles, observers with closed forms.
#pragma once
#include "core/config/scene.hpp"
#include "core/output/compare.hpp"
#include "core/output/results.hpp"
#include "core/registry/instance.hpp"
#include "core/scheduler/crossing.hpp"
#include "core/solver/solver.hpp"

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gault::core {

class Verification {
  public:
    Verification(const Scene& scene, const std::vector<ColumnInfo>& columns); // reads every file: InputError

    // Compares the profiles that are due; `measured` gives a column of the history now.
    void look(const std::function<double(const std::string&)>& measured, const Motion& motion);
    // Errors of the whole history; the history's columns are those given to the constructor.
    // What could not be compared says why, under `not_compared`.
    nlohmann::json finish(const std::vector<std::vector<double>>& rows) const;
    // Results of the observers at the present state.
    nlohmann::json observe(Solver& solver);

  private:
    struct Curve {
        CurveReference use;
        nlohmann::json source; // {file} or {against}
        std::size_t x, y;      // columns of the history
        std::vector<double> x_reference, y_reference;
        bool first_loading = false; // holds until x falls
    };
    struct Profile {
        std::string measure;
        Crossing value;
        nlohmann::json source;
        std::vector<double> radius, sigma_r, sigma_theta; // m; Pa, compression positive
        nlohmann::json errors;                            // null before its value is reached
    };
    struct Observer {
        Instance instance;
        int surface;
        std::vector<std::string> measures;
    };
    void add_palmer(const Scene& scene, const std::vector<ColumnInfo>& columns);
    static nlohmann::json ask(const Observer& observer, Solver& solver, gault_sample sample);

    std::vector<Curve> curves_;
    std::vector<Profile> profiles_;
    std::vector<Observer> observers_;
};

} // namespace gault::core
