// Tensors, and the states of a point, seen after a rotation.
#pragma once
#include "core/certificate/cloud.hpp"

#include <Eigen/Geometry>

namespace gault::core {

Eigen::Matrix3d random_rotation(Random& random);
Eigen::Matrix3d random_rotation_about(int axis, Random& random);

Tensor rotated(const Eigen::Matrix3d& q, const Tensor& t); // q t q^T

// Vector and tensor states of a point of one batch go, rotated, to the same point of another; scalars as they are.
void rotate_states(const Material& material, const Eigen::Matrix3d& q, const std::vector<Column>& from,
                   std::vector<Column>& to);

} // namespace gault::core
