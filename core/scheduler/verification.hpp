// The run against what is known: reference curves, radial profiles, observers with closed forms.
#pragma once
#include "core/config/scene.hpp"
#include "core/output/compare.hpp"
#include "core/output/results.hpp"
#include "core/registry/instance.hpp"
#include "core/solver/explicit.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gault::core {

class Verification {
  public:
    Verification(const Scene& scene, const std::vector<ColumnInfo>& columns); // reads every file: InputError

    // Compares the profiles that are due when `measure` has reached `value`.
    void at(const std::string& measure, double value, const Motion& motion);
    // Errors of the whole history; the history's columns are those given to the constructor.
    nlohmann::json finish(const std::vector<std::vector<double>>& rows) const;
    // Results of the observers at the present state.
    nlohmann::json observe(ExplicitSolver& solver);

  private:
    struct Curve {
        const CurveReference* use;
        std::size_t x, y; // columns of the history
        std::vector<double> x_reference, y_reference;
    };
    struct Profile {
        std::string measure;
        double value;
        std::filesystem::path file;
        std::vector<double> radius, sigma_r, sigma_theta; // m; Pa, compression positive
        bool done = false;
    };
    struct Observer {
        Instance instance;
        int side;
        std::vector<std::string> measures;
    };
    std::vector<Curve> curves_;
    std::vector<Profile> profiles_;
    std::vector<Observer> observers_;
    nlohmann::json profile_errors_ = nlohmann::json::array();
    std::filesystem::path folder_; // of the scene
};

} // namespace gault::core
