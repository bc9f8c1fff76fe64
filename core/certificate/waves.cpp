#include "core/certificate/checks.hpp"
#include "core/certificate/rotation.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gault::core::checks {
namespace {

constexpr int row_of[] = {0, 1, 2, 0, 1, 2}, column_of[] = {0, 1, 2, 1, 2, 0};

// The largest eigenvalue of n . C . n, over the three axes and 60 random directions n.
double fastest_wave(const Matrix6& d, Random& random) {
    double most = 0.0;
    for (int direction = 0; direction < 63; ++direction) {
        const Eigen::Vector3d n =
            direction < 3 ? Eigen::Vector3d::Unit(direction).eval() : random_rotation(random).col(0).eval();
        Eigen::Matrix3d q = Eigen::Matrix3d::Zero();
        for (int a = 0; a < 6; ++a)
            for (int b = 0; b < 6; ++b) {
                const double c = d(a, b) * (b < 3 ? 1.0 : 0.5); // C_ijkl
                for (int left = 0; left < (a < 3 ? 1 : 2); ++left)
                    for (int right = 0; right < (b < 3 ? 1 : 2); ++right) {
                        const int i = left ? column_of[a] : row_of[a], j = left ? row_of[a] : column_of[a];
                        const int k = right ? column_of[b] : row_of[b], l = right ? row_of[b] : column_of[b];
                        q(i, k) += n[j] * c * n[l];
                    }
            }
        most = std::max(most, Eigen::EigenSolver<Eigen::Matrix3d>(q, false).eigenvalues().real().maxCoeff());
    }
    return most;
}

// The bound as the host asks for it: at rest.
bool ask_for_moduli(PointBatch& point) {
    point.set_strain(0, {});
    point.pad();
    return point.update(0.0).status == GAULT_OK;
}

} // namespace

// Elastic waves are bounded, to a tenth of the host's margin. Flow that is not associated makes some that are faster
// than any elastic one, in sand by more than twice the modulus: those to all of the margin, 1 / 0.9^2. Beyond, an
// explicit run feeds them until nothing of its result is right, and says nothing.
Finding modulus(const Subject& subject) {
    constexpr double exact = 1.01, borne = 1.0 / (0.9 * 0.9);
    const Material material(subject.use);
    Random random(9);
    double most[2] = {0.0, 0.0};
    int points[2] = {0, 0};
    for (const double strained : {2e-5, strain_to_yield(material, subject.stress).size}) {
        const PointBatch cloud = scatter(material, subject.stress, 150, 12, strained, random);
        for (std::size_t i = 0; i < cloud.count(); ++i) {
            PointBatch rest(material, 1);
            rest.take(0, cloud, i);
            rest.time = cloud.time;
            if (!ask_for_moduli(rest))
                return failed("has no modulus at rest: a step of no length is not answered");
            const double bound = rest.modulus[0], shear = rest.shear_modulus[0];
            if (!(bound > 0.0) || !std::isfinite(bound) || !(shear >= 0.0) || !std::isfinite(shear))
                return failed(
                    fmt::format("reports a modulus of {:g} Pa and a shear modulus of {:g} Pa", bound, shear));
            const std::optional<PointBatch> one = answered_one(cloud, i, 1e-8, 1e-7, random, quick);
            const std::optional<Differences> d = one ? differences(*one, quick) : std::nullopt;
            if (!d || d->bend > 1e-3 * bound) continue; // from one branch into another
            const int kind = is_elastic(*one) ? 0 : 1;
            ++points[kind];
            most[kind] = std::max(most[kind], fastest_wave(d->central, random) / bound);
        }
    }
    if (points[0] + points[1] == 0) return left_out("the stress bends at every point");
    return judge(
        most[0] <= exact && most[1] <= borne,
        fmt::format("of it, the fastest wave needs {:.4f} in {} elastic points, {:.3f} in {} that yield{}",
                    most[0], points[0], most[1], points[1],
                    most[1] > borne ? ": report as much there, or explicit runs go wrong" : ""));
}

} // namespace gault::core::checks
