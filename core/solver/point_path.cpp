#include "core/solver/point_path.hpp"
#include "core/base/error.hpp"
#include "core/registry/answer.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <cmath>

namespace gault::core {
namespace {

constexpr std::size_t lanes = GAULT_LANES; // all alike
constexpr int most_pieces = 1024;

template <std::size_t N>
void make(std::array<Column, N>& columns) {
    for (Column& column : columns)
        column.assign(lanes, 0.0);
}

void fill(Column& column, double value) {
    column.assign(lanes, value);
}

// exp(e), row-major.
std::array<double, 9> gradient(const std::array<double, 6>& e) {
    Eigen::Matrix3d m;
    m << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(m);
    const Eigen::Matrix3d f = axes.eigenvectors() * axes.eigenvalues().array().exp().matrix().asDiagonal() *
                              axes.eigenvectors().transpose();
    std::array<double, 9> row_major;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major.data()) = f;
    return row_major;
}

} // namespace

PointPath::PointPath(const Material& material, const std::array<double, 6>& stress)
    : material_(material), stress_(stress), old_state_(static_cast<std::size_t>(material.state_components())),
      new_state_(old_state_.size()), input_(material.inputs().size()) {
    for (auto* columns : {&increment_, &old_stress_, &new_stress_})
        make(*columns);
    for (auto* columns : {&old_gradient_, &new_gradient_})
        make(*columns);
    for (const StateInfo& info : material.states())
        for (int k = 0; k < static_cast<int>(info.declared.shape); ++k)
            fill(new_state_[static_cast<std::size_t>(info.first + k)], info.declared.initial);
    for (int k = 0; k < 6; ++k)
        fill(new_stress_[static_cast<std::size_t>(k)], stress[static_cast<std::size_t>(k)]);
    if (!material.api().start) return;
    gault_points p = points({}, 0.0);
    gault_error error{-1, 0, -1, ""};
    if (material.api().start(material.instance().self(), &p, &error) != GAULT_OK)
        throw RunError(fmt::format("material '{}': {}", material.name(), error_text(error)));
}

// The state and stress of the last update become the old ones.
gault_points PointPath::points(const std::array<double, 6>& increment, double dt) {
    gault_points p{};
    p.size = sizeof p;
    p.count = p.padded = static_cast<int64_t>(lanes);
    p.time = time_ + dt;
    p.dt = dt;
    p.suggest = 0.5;
    std::array<double, 6> after = total_;
    for (std::size_t k = 0; k < 6; ++k) {
        after[k] += increment[k];
        fill(increment_[k], increment[k]);
        old_stress_[k] = new_stress_[k];
        p.strain[k] = increment_[k].data();
        p.stress_old[k] = old_stress_[k].data();
        p.stress[k] = new_stress_[k].data();
    }
    if (material_.finite_strain()) {
        const std::array<double, 9> from = gradient(total_), to = gradient(after);
        for (std::size_t k = 0; k < 9; ++k) {
            fill(old_gradient_[k], from[k]);
            fill(new_gradient_[k], to[k]);
            p.F_old[k] = old_gradient_[k].data();
            p.F_new[k] = new_gradient_[k].data();
        }
    }
    old_states_.clear(), new_states_.clear(), inputs_.clear();
    for (std::size_t k = 0; k < new_state_.size(); ++k) {
        old_state_[k] = new_state_[k];
        old_states_.push_back(old_state_[k].data());
        new_states_.push_back(new_state_[k].data());
    }
    const double ratio = std::exp(after[0] + after[1] + after[2]);
    for (std::size_t k = 0; k < input_.size(); ++k) {
        const HostField field = material_.inputs()[k];
        fill(input_[k], field == HostField::density        ? material_.density() / ratio
                        : field == HostField::volume_ratio ? ratio
                                                           : 1.0); // a cell of one metre
        inputs_.push_back(input_[k].data());
    }
    p.state_old = old_states_.data();
    p.state = new_states_.data();
    p.input = inputs_.data();
    return p;
}

void PointPath::strain(const std::array<double, 6>& increment, double dt) {
    const std::array<Column, 6> stress = new_stress_;
    const std::vector<Column> state = new_state_;
    const std::array<double, 6> total = total_;
    const double time = time_;
    for (int pieces = 1; pieces <= most_pieces; pieces *= 2) {
        std::array<double, 6> part = increment;
        for (double& e : part)
            e /= pieces;
        gault_status status = GAULT_OK;
        gault_error error{-1, 0, -1, ""};
        for (int piece = 0; piece < pieces && status == GAULT_OK; ++piece) {
            gault_points p = points(part, dt / pieces);
            status = material_.api().update(material_.instance().self(), &p, &error);
            for (std::size_t k = 0; k < 6; ++k)
                total_[k] += part[k];
            time_ += dt / pieces;
        }
        if (status == GAULT_OK) {
            for (std::size_t k = 0; k < 6; ++k)
                stress_[k] = new_stress_[k][0];
            return;
        }
        if (status != GAULT_RETRY)
            throw RunError(fmt::format("material '{}': {}", material_.name(), error_text(error)));
        new_stress_ = stress;
        new_state_ = state;
        total_ = total;
        time_ = time;
    }
    throw RunError(fmt::format("material '{}': the step had to be divided more than {} times",
                               material_.name(), most_pieces));
}

} // namespace gault::core
