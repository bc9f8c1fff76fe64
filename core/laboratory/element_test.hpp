// A test of one material point: stages under mixed control, a row of results a step.
#pragma once
#include "core/config/element.hpp"
#include "core/laboratory/soil_point.hpp"
#include "core/output/results.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

class ElementRun {
  public:
    explicit ElementRun(const ElementTest& test); // RunError: the soil refuses

    // Compression positive, as a person reads; shear strains are the tensor's.
    const std::vector<ColumnInfo>& columns() const { return columns_; }
    // Calls `row` once for the start and after every step. RunError: at a stage, with the reason; the last row is then
    // as far as the point came.
    void go(const std::function<void(const std::vector<double>&)>& row);

    const SoilPoint& point() const { return point_; }
    // Half the largest difference of two principal stresses in undrained stages, s_u where they go to failure; Pa.
    const std::optional<double>& undrained_strength() const { return undrained_strength_; }
    int64_t steps() const { return steps_; }
    int64_t iterations() const { return iterations_; }

  private:
    std::vector<double> values(int stage) const; // RunError: one is not finite

    const ElementTest& test_;
    Material material_;
    SoilPoint point_;
    std::vector<ColumnInfo> columns_;
    double pore_pressure_ = 0.0; // Pa, compression positive
    bool undrained_ = false;     // some stage is
    std::optional<double> undrained_strength_;
    int64_t steps_ = 0, iterations_ = 0;
};

// What the model answers to the call, and to parts of its increment.
struct ReplayAnswer {
    double fraction; // of the increment
    UpdateFailure failure;
    Tensor stress;
    std::vector<double> state;
};
std::vector<ReplayAnswer> replay(const ElementTest& test);

// Wall time of one point's constitutive update, the best of several turns: `batch` points that stand where `point` does,
// strained once more as it was last; s. Nothing: the soil does not take that step.
std::optional<double> seconds_per_update(const SoilPoint& point, std::size_t batch);

} // namespace gault::core
