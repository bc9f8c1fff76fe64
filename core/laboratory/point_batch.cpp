#include "core/laboratory/point_batch.hpp"
#include "core/registry/answer.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace gault::core {

PointBatch::PointBatch(const Material& material, std::size_t count)
    : state_old(static_cast<std::size_t>(material.state_components())), state(state_old.size()),
      input(material.inputs().size()), material_(&material), count_(count),
      padded_(round_up(count, GAULT_LANES)) {
    const auto make = [this](auto& columns, double value = 0.0) {
        for (Column& column : columns)
            column.assign(padded_, value);
    };
    make(strain), make(stress_old), make(stress), make(state_old), make(state), make(input, 0.01);
    modulus.assign(padded_, 0.0);
    shear_modulus.assign(padded_, 0.0);
    volume_ratio_.assign(padded_, 1.0);
    for (const StateInfo& info : material.states())
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
            state_old[static_cast<std::size_t>(info.first + k)].assign(padded_, info.declared.initial);
    for (std::size_t k = 0; k < input.size(); ++k)
        if (material.inputs()[k] != HostField::characteristic_length)
            input[k].assign(padded_, material.inputs()[k] == HostField::density ? material.density() : 1.0);
    if (material.finite_strain())
        for (std::size_t k = 0; k < 9; ++k)
            for (auto* columns : {&F_old, &F_new})
                (*columns)[k].assign(padded_, k % 4 == 0 ? 1.0 : 0.0);
}

Tensor PointBatch::get(const std::array<Column, 6>& columns, std::size_t point) const {
    Tensor value;
    for (std::size_t k = 0; k < 6; ++k)
        value[k] = columns[k][point];
    return value;
}

void PointBatch::set(std::array<Column, 6>& columns, std::size_t point, const Tensor& value) {
    for (std::size_t k = 0; k < 6; ++k)
        columns[k][point] = value[k];
}

void PointBatch::set_strain(std::size_t point, const Tensor& increment) {
    set(strain, point, increment);
    const double ratio = volume_ratio_[point] * std::exp(increment[0] + increment[1] + increment[2]);
    for (std::size_t k = 0; k < input.size(); ++k) {
        if (material_->inputs()[k] == HostField::density) input[k][point] = material_->density() / ratio;
        if (material_->inputs()[k] == HostField::volume_ratio) input[k][point] = ratio;
    }
    if (!material_->finite_strain()) return;
    const Matrix stretch = deformation_gradient(increment);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            double sum = 0.0;
            for (std::size_t k = 0; k < 3; ++k)
                sum += stretch[3 * i + k] * F_old[3 * k + j][point];
            F_new[3 * i + j][point] = sum;
        }
}

void PointBatch::set_states(std::size_t point, const std::map<std::string, std::vector<double>>& states) {
    for (const StateInfo& info : material_->states())
        if (const auto given = states.find(info.declared.name); given != states.end())
            for (std::size_t k = 0; k < given->second.size(); ++k)
                state_old[static_cast<std::size_t>(info.first) + k][point] = given->second[k];
}

void PointBatch::take(std::size_t point, const PointBatch& from, std::size_t its_point) {
    const auto copy = [&](auto& to, const auto& source) {
        for (std::size_t k = 0; k < to.size(); ++k)
            if (!to[k].empty()) to[k][point] = source[k][its_point];
    };
    copy(strain, from.strain), copy(stress_old, from.stress_old), copy(state_old, from.state_old);
    copy(input, from.input), copy(F_old, from.F_old), copy(F_new, from.F_new);
    volume_ratio_[point] = from.volume_ratio_[its_point];
}

void PointBatch::pad() {
    const auto repeat = [this](auto& columns) {
        for (Column& column : columns)
            if (!column.empty())
                std::fill(column.begin() + static_cast<std::ptrdiff_t>(count_), column.end(),
                          column[count_ - 1]);
    };
    repeat(strain), repeat(stress_old), repeat(state_old), repeat(input), repeat(F_old), repeat(F_new);
    std::fill(volume_ratio_.begin() + static_cast<std::ptrdiff_t>(count_), volume_ratio_.end(),
              volume_ratio_[count_ - 1]);
}

UpdateFailure PointBatch::call(gault_status (*function)(const void*, gault_points*, gault_error*) noexcept,
                               double dt, bool wants_tangent) {
    gault_points p{};
    p.size = sizeof p;
    p.count = static_cast<int64_t>(count_);
    p.padded = static_cast<int64_t>(padded_);
    p.time = time + dt;
    p.dt = dt;
    p.suggest = 0.5;
    old_states_.clear(), states_.clear(), inputs_.clear();
    for (std::size_t k = 0; k < 6; ++k) {
        p.strain[k] = strain[k].data();
        p.stress_old[k] = stress_old[k].data();
        p.stress[k] = stress[k].data();
    }
    for (std::size_t k = 0; k < state.size(); ++k) {
        old_states_.push_back(state_old[k].data());
        states_.push_back(state[k].data());
    }
    for (const Column& column : input)
        inputs_.push_back(column.data());
    p.state_old = old_states_.data();
    p.state = states_.data();
    p.input = inputs_.data();
    p.modulus = modulus.empty() ? nullptr : modulus.data();
    p.shear_modulus = shear_modulus.empty() ? nullptr : shear_modulus.data();
    for (std::size_t k = 0; k < 9 && material_->finite_strain(); ++k) {
        p.F_old[k] = F_old[k].data();
        p.F_new[k] = F_new[k].data();
    }
    for (std::size_t k = 0; k < 36 && wants_tangent; ++k) {
        tangent[k].resize(padded_);
        p.tangent[k] = tangent[k].data();
    }
    gault_error error{-1, 0, -1, ""};
    const gault_status status = function(material_->instance().self(), &p, &error);
    suggested = p.suggest;
    if (status == GAULT_OK) return {};
    UpdateFailure failure{status, std::nullopt, error_text(error),
                          step_fraction(p.suggest, 1.0 / 1024.0, 0.5)};
    if (error.point >= 0 && error.point < p.count) failure.slot = static_cast<std::size_t>(error.point);
    return failure;
}

UpdateFailure PointBatch::start() {
    for (std::size_t k = 0; k < 6; ++k)
        stress[k] = stress_old[k];
    state = state_old;
    if (!material_->api().start) return {};
    const UpdateFailure failure = call(material_->api().start, 0.0, false);
    if (failure.status == GAULT_OK) state_old = state;
    return failure;
}

UpdateFailure PointBatch::update(double dt, bool wants_tangent) {
    return call(material_->api().update, dt, wants_tangent);
}

void PointBatch::accept() {
    stress_old = stress;
    state_old = state;
    F_old = F_new;
    for (std::size_t i = 0; i < padded_ && !input.empty(); ++i)
        volume_ratio_[i] *= std::exp(strain[0][i] + strain[1][i] + strain[2][i]);
}

Matrix deformation_gradient(const Tensor& e) {
    Eigen::Matrix3d m;
    m << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(m);
    const Eigen::Matrix3d f = axes.eigenvectors() * axes.eigenvalues().array().exp().matrix().asDiagonal() *
                              axes.eigenvectors().transpose();
    Matrix row_major;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major.data()) = f;
    return row_major;
}

} // namespace gault::core
