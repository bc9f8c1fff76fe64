#include "core/laboratory/soil_point.hpp"
#include "core/base/suggest.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gault::core {
namespace {

constexpr double shift = 1e-8; // of strain, for differences
constexpr int most_pieces = 1024;

Tensor plus(Tensor a, const Tensor& b, double factor = 1.0) {
    for (std::size_t k = 0; k < 6; ++k)
        a[k] += factor * b[k];
    return a;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k)
                c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    return c;
}

} // namespace

SoilPoint::SoilPoint(const Material& material, const Tensor& stress,
                     const std::map<std::string, std::vector<double>>& states)
    : batch_(material, 7) {
    for (std::size_t lane = 0; lane < 7; ++lane)
        batch_.set(batch_.stress_old, lane, stress);
    batch_.pad();
    if (const UpdateFailure failure = batch_.start(); failure.status != GAULT_OK)
        throw RunError(fmt::format("material '{}': {}", material.name(), failure.text));
    for (const auto& [name, values] : states) {
        std::vector<std::string> names;
        bool found = false;
        for (const StateInfo& info : material.states()) {
            names.emplace_back(info.declared.name);
            if (name != info.declared.name) continue;
            found = true;
            if (values.size() != info.declared.shape)
                throw InputError(fmt::format("initial.states.{} has {} values; the state has {}", name,
                                             values.size(), static_cast<int>(info.declared.shape)));
            for (std::size_t k = 0; k < values.size(); ++k)
                batch_.state_old[static_cast<std::size_t>(info.first) + k].assign(8, values[k]);
        }
        if (!found)
            throw InputError(fmt::format("initial.states.{}: '{}' has no such state{}", name, material.name(),
                                         suggestion(name, names)));
    }
}

Tensor SoilPoint::shifted(const Tensor& increment, std::size_t lane) const {
    Tensor e = increment;
    if (lane > 0) e[lane - 1] += shift;
    return e;
}

void SoilPoint::lay_out(const Tensor& increment, bool differences) {
    const Tensor after = plus(total_, increment);
    const double ratio = std::exp(after[0] + after[1] + after[2]);
    Matrix from{}, to{};
    if (material().finite_strain()) from = deformation_gradient(total_), to = deformation_gradient(after);
    for (std::size_t lane = 0; lane < 7; ++lane) {
        const std::size_t moved = differences ? lane : 0;
        batch_.set(batch_.strain, lane, shifted(increment, moved));
        if (!material().finite_strain()) continue;
        Tensor e{};
        const Matrix F = moved ? product(deformation_gradient(shifted(e, moved)), to) : to;
        for (std::size_t k = 0; k < 9; ++k)
            batch_.F_old[k][lane] = from[k], batch_.F_new[k][lane] = F[k];
    }
    for (std::size_t k = 0; k < batch_.input.size(); ++k) {
        const HostField field = material().inputs()[k];
        if (field == HostField::density) batch_.input[k].assign(8, material().density() / ratio);
        if (field == HostField::volume_ratio) batch_.input[k].assign(8, ratio);
    }
    batch_.pad();
}

SoilPoint::Answer SoilPoint::answer(const Tensor& increment, double dt, bool tangent) {
    const bool differences = tangent && !material().has_tangent();
    lay_out(increment, differences);
    increment_ = increment;
    dt_ = dt;
    updates_ += differences ? 7 : 1;
    Answer answer{batch_.update(dt, tangent && !differences), batch_.get(batch_.stress, 0), Matrix6::Zero()};
    if (answer.failure.status != GAULT_OK || !tangent) return answer;
    for (std::size_t row = 0; row < 6; ++row)
        for (std::size_t column = 0; column < 6; ++column)
            answer.tangent(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
                differences ? (batch_.stress[row][column + 1] - batch_.stress[row][0]) / shift
                            : batch_.tangent[6 * row + column][0];
    return answer;
}

void SoilPoint::accept() {
    total_ = plus(total_, increment_);
    batch_.accept();
    for (std::size_t lane = 1; lane < 8; ++lane) { // all of them stand where the point does
        batch_.set(batch_.stress_old, lane, stress());
        for (Column& column : batch_.state_old)
            column[lane] = column[0];
    }
    batch_.time += dt_;
}

void SoilPoint::strain(const Tensor& increment, double dt) {
    UpdateFailure failure = answer(increment, dt, false).failure;
    if (failure.status == GAULT_OK) return accept();
    const PointBatch before = batch_;
    const Tensor total = total_;
    for (int pieces = 2; failure.status == GAULT_RETRY && pieces <= most_pieces; pieces *= 2) {
        batch_.stress_old = before.stress_old;
        batch_.state_old = before.state_old;
        batch_.time = before.time;
        total_ = total;
        failure = {};
        for (int piece = 0; piece < pieces && failure.status == GAULT_OK; ++piece) {
            failure = answer(plus({}, increment, 1.0 / pieces), dt / pieces, false).failure;
            if (failure.status == GAULT_OK) accept();
        }
        if (failure.status == GAULT_OK) return;
    }
    throw RunError(failure.status == GAULT_RETRY
                       ? fmt::format("material '{}': the step had to be divided more than {} times",
                                     material().name(), most_pieces)
                       : fmt::format("material '{}': {}", material().name(), failure.text));
}

} // namespace gault::core
