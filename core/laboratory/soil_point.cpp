#include "core/laboratory/soil_point.hpp"

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

} // namespace

SoilPoint::SoilPoint(const Material& material, const Tensor& stress,
                     const std::map<std::string, std::vector<double>>& states, double characteristic_length)
    : batch_(material, 7) {
    for (std::size_t k = 0; k < batch_.input.size(); ++k)
        if (material.inputs()[k] == HostField::characteristic_length)
            batch_.input[k].assign(8, characteristic_length);
    for (std::size_t lane = 0; lane < 7; ++lane)
        batch_.set(batch_.stress_old, lane, stress);
    batch_.pad();
    if (const UpdateFailure failure = batch_.start(); failure.status != GAULT_OK)
        throw RunError(fmt::format("material '{}': {}", material.name(), failure.text));
    for (std::size_t lane = 0; lane < 8; ++lane)
        batch_.set_states(lane, states);
}

Tensor SoilPoint::shifted(const Tensor& increment, std::size_t lane) const {
    Tensor e = increment;
    if (lane > 0) e[lane - 1] += shift;
    return e;
}

void SoilPoint::lay_out(const Tensor& increment, bool differences) {
    const Tensor after = plus(total_, increment);
    const double ratio = std::exp(after[0] + after[1] + after[2]);
    for (std::size_t lane = 0; lane < 7; ++lane) {
        const Tensor e = shifted(increment, differences ? lane : 0);
        batch_.set(batch_.strain, lane, e);
        if (!material().finite_strain()) continue;
        const Matrix from = deformation_gradient(total_), to = deformation_gradient(plus(total_, e));
        for (std::size_t k = 0; k < 9; ++k)
            batch_.F_old[k][lane] = from[k], batch_.F_new[k][lane] = to[k];
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
        batch_ = before;
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
