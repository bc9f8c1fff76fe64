// A test of one material point: stages under mixed control, a row of results a step.
#pragma once
#include "core/config/element.hpp"
#include "core/laboratory/soil_point.hpp"
#include "core/output/results.hpp"

#include <functional>
#include <string>
#include <vector>

namespace gault::core {

class ElementRun {
  public:
    explicit ElementRun(const ElementTest& test); // InputError, RunError: the soil refuses

    // Compression positive, as a person reads; shear strains are the tensor's.
    const std::vector<ColumnInfo>& columns() const { return columns_; }
    // Calls `row` once for the start and after every step. RunError: at a stage, with the reason; rows given stay.
    void go(const std::function<void(const std::vector<double>&)>& row);

    const SoilPoint& point() const { return point_; }
    const Tensor& last_increment() const { return last_; } // of strain, of the last step
    int64_t steps() const { return steps_; }
    int64_t iterations() const { return iterations_; }

  private:
    std::vector<double> values(int stage) const;

    const ElementTest& test_;
    Material material_;
    SoilPoint point_;
    std::vector<ColumnInfo> columns_;
    double pore_pressure_ = 0.0; // Pa, compression positive
    bool undrained_ = false;     // some stage is
    Tensor last_{};
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

// Wall time of one point's constitutive update in batches of `batch` points where `point` stands, the best of
// several turns; s.
double seconds_per_update(const SoilPoint& point, const Tensor& increment, std::size_t batch);

} // namespace gault::core
