#include "core/laboratory/element_test.hpp"
#include "core/laboratory/mixed_control.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace gault::core {
namespace {

const char* const component_names[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

double trace(const Tensor& t) {
    return t[0] + t[1] + t[2];
}
double deviator_norm_squared(const Tensor& t) { // e:e
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += std::pow(t[k] - trace(t) / 3.0, 2) + 2.0 * t[k + 3] * t[k + 3];
    return sum;
}

double largest_shear_stress(const Tensor& t) {
    Eigen::Matrix3d m;
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    const Eigen::Vector3d principal = m.selfadjointView<Eigen::Lower>().eigenvalues();
    return 0.5 * (principal[2] - principal[0]);
}

std::vector<ColumnInfo> columns_of(const Material& material, bool undrained) {
    std::vector<ColumnInfo> columns = {
        {"time", "s", "Time at the end of the step"},
        {"stage", "1", "Stage in hand, as carried out, from 1; 0 at the start"},
    };
    for (const char* name : component_names)
        columns.push_back(
            {std::string("strain_") + name, "1", "Logarithmic strain, compression positive, tensor shear"});
    for (const char* name : component_names)
        columns.push_back(
            {std::string("stress_") + name, "Pa", "Effective Cauchy stress, compression positive"});
    columns.push_back({"mean_stress", "Pa", "p', effective, compression positive"});
    columns.push_back({"deviator_stress", "Pa", "q = sqrt(3 J2)"});
    columns.push_back({"volumetric_strain", "1", "Compression positive"});
    columns.push_back({"deviatoric_strain", "1", "sqrt(2/3 e:e) of the total strain"});
    if (undrained) columns.push_back({"pore_pressure", "Pa", "Excess over that at the start"});
    for (const StateInfo& info : material.states())
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
            columns.push_back({info.declared.shape == GAULT_SCALAR
                                   ? std::string(info.declared.name)
                                   : fmt::format("{}_{}", info.declared.name,
                                                 info.declared.shape == GAULT_VECTOR ? component_names[k] + 1
                                                                                     : component_names[k]),
                               info.declared.unit, info.declared.doc});
    return columns;
}

bool any_undrained(const ElementTest& test) {
    return std::any_of(test.stages.begin(), test.stages.end(),
                       [](const ElementStage& stage) { return stage.undrained.has_value(); });
}

} // namespace

ElementRun::ElementRun(const ElementTest& test)
    : test_(test), material_(test.material),
      point_(material_, test.stress, test.states, test.characteristic_length),
      columns_(columns_of(material_, any_undrained(test))), undrained_(any_undrained(test)) {}

std::vector<double> ElementRun::values(int stage) const {
    std::vector<double> row = {point_.time(), static_cast<double>(stage)};
    const Tensor stress = point_.stress();
    for (const Tensor* tensor : {&point_.strain(), &stress})
        for (const double x : *tensor)
            row.push_back(0.0 - x);
    row.push_back(0.0 - trace(stress) / 3.0);
    row.push_back(std::sqrt(1.5 * deviator_norm_squared(stress)));
    row.push_back(0.0 - trace(point_.strain()));
    row.push_back(std::sqrt(2.0 / 3.0 * deviator_norm_squared(point_.strain())));
    if (undrained_) row.push_back(pore_pressure_);
    for (int k = 0; k < material_.state_components(); ++k)
        row.push_back(point_.state(k));
    for (std::size_t k = 0; k < row.size(); ++k)
        if (!std::isfinite(row[k]))
            throw RunError(fmt::format("stage {}: column '{}' is {}", stage, columns_[k].header(), row[k]));
    return row;
}

void ElementRun::go(const std::function<void(const std::vector<double>&)>& row) {
    row(values(0));
    for (std::size_t i = 0; i < test_.stages.size(); ++i) {
        const ElementStage& stage = test_.stages[i];
        MixedControl control(point_, stage);
        const double pressure = pore_pressure_;
        const Tensor begin = point_.stress();
        const auto arrive = [&] {
            if (stage.undrained) { // total stress stays: what the skeleton sheds, the water takes
                pore_pressure_ = pressure;
                for (std::size_t k = 0; k < 3; ++k)
                    pore_pressure_ += (*stage.undrained)[k] * (point_.stress()[k] - begin[k]);
                undrained_strength_ =
                    std::max(undrained_strength_.value_or(0.0), largest_shear_stress(point_.stress()));
            }
            row(values(static_cast<int>(i) + 1));
        };
        const int64_t before = iterations_;
        for (int step = 1; step <= stage.steps; ++step) {
            const double time = point_.time();
            try {
                control.go_to(static_cast<double>(step) / stage.steps);
            } catch (const RunError&) {
                iterations_ = before + control.iterations();
                if (point_.time() > time) arrive(); // as far as it went
                throw;
            }
            iterations_ = before + control.iterations();
            ++steps_;
            arrive();
        }
    }
}

std::vector<ReplayAnswer> replay(const ElementTest& test) {
    const ElementReplay& call = *test.replay;
    const Material material(test.material);
    std::vector<ReplayAnswer> answers;
    for (const double fraction : {1.0, 0.5, 0.25, 0.125, 1e-2, 1e-3, 0.0}) {
        PointBatch batch(material, 1);
        Tensor part = call.strain;
        for (double& e : part)
            e *= fraction;
        batch.set(batch.stress_old, 0, call.stress);
        batch.set(batch.strain, 0, part);
        batch.set_states(0, call.states);
        for (std::size_t k = 0; k < batch.input.size(); ++k)
            if (const auto given = call.inputs.find(material.api().inputs[k]); given != call.inputs.end())
                batch.input[k][0] = given->second[0];
        for (std::size_t k = 0; k < 9 && call.F_old; ++k) { // straight on, as a run divides a step
            batch.F_old[k][0] = (*call.F_old)[k];
            batch.F_new[k][0] = (*call.F_old)[k] + fraction * ((*call.F_new)[k] - (*call.F_old)[k]);
        }
        batch.pad();
        batch.time = call.time - call.dt;
        ReplayAnswer answer{fraction, batch.update(fraction * call.dt), batch.get(batch.stress, 0), {}};
        for (const Column& column : batch.state)
            answer.state.push_back(column[0]);
        answers.push_back(std::move(answer));
    }
    return answers;
}

std::optional<double> seconds_per_update(const SoilPoint& point, std::size_t count) {
    PointBatch batch(point.material(), count);
    for (std::size_t i = 0; i < count; ++i) {
        batch.take(i, point.batch(), 0);
        batch.set_strain(i, point.batch().get(point.batch().strain, 0));
    }
    batch.pad();
    batch.time = point.time();
    using Clock = std::chrono::steady_clock;
    double best = HUGE_VAL;
    int calls = 1;
    for (int turn = 0; turn < 12; ++turn) {
        const auto start = Clock::now();
        for (int call = 0; call < calls; ++call)
            if (batch.update(point.last_dt()).status != GAULT_OK) return std::nullopt;
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        best = std::min(best, seconds / calls / static_cast<double>(count));
        if (seconds < 4e-3) calls *= 2;
    }
    return best;
}

} // namespace gault::core
