#include "core/certificate/rotation.hpp"

#include <algorithm>
#include <numbers>

namespace gault::core {

Eigen::Matrix3d random_rotation(Random& random) {
    double c[4];
    for (double& x : c)
        x = uniform(random, -1.0, 1.0);
    return Eigen::Quaterniond(c[0], c[1], c[2], c[3]).normalized().toRotationMatrix();
}
Eigen::Matrix3d random_rotation_about(int axis, Random& random) {
    const double angle = uniform(random, 0.1, 2.0 * std::numbers::pi - 0.1);
    return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

Tensor rotated(const Eigen::Matrix3d& q, const Tensor& t) {
    Eigen::Matrix3d m;
    m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
    m = (q * m * q.transpose()).eval();
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}

void rotate_states(const Material& material, const Eigen::Matrix3d& q, const std::vector<Column>& from,
                   std::vector<Column>& to) {
    for (const StateInfo& info : material.states()) {
        const auto first = static_cast<std::size_t>(info.first);
        if (info.declared.shape == GAULT_SCALAR) to[first][0] = from[first][0];
        if (info.declared.shape == GAULT_VECTOR) {
            const Eigen::Vector3d v =
                q * Eigen::Vector3d(from[first][0], from[first + 1][0], from[first + 2][0]);
            for (std::size_t k = 0; k < 3; ++k)
                to[first + k][0] = v[static_cast<Eigen::Index>(k)];
        }
        if (info.declared.shape == GAULT_SYMMETRIC) {
            Tensor t;
            for (std::size_t k = 0; k < 6; ++k)
                t[k] = from[first + k][0];
            t = rotated(q, t);
            for (std::size_t k = 0; k < 6; ++k)
                to[first + k][0] = t[k];
        }
    }
}

} // namespace gault::core
