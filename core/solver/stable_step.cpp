#include "core/solver/stable_step.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace gault::core {
namespace {

double dot(const VectorField& a, const VectorField& b) {
    double total = 0.0;
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < a.c[k].size(); ++n)
            total += a.c[k][n] * b.c[k][n];
    return total;
}

void scale(VectorField& a, double factor) {
    for (Column& c : a.c)
        for (double& x : c)
            x *= factor;
}

void subtract(VectorField& a, double factor, const VectorField& b) {
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < a.c[k].size(); ++n)
            a.c[k][n] -= factor * b.c[k][n];
}

// a := M^-1 a on free components, 0 on fixed ones.
void divide(VectorField& a, const Column& mass, const FixedField& fixed) {
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < mass.size(); ++n)
            a.c[k][n] = mass[n] > 0.0 && fixed.c[k][n] == 0.0 ? a.c[k][n] / mass[n] : 0.0;
}

// A field with all wave numbers in it, the same in every run.
VectorField start_vector(const Column& mass, const FixedField& fixed, const NodeLayout& layout) {
    VectorField q(layout);
    uint64_t state = 88172645463325252ull;
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < mass.size(); ++n) {
            state ^= state << 13, state ^= state >> 7, state ^= state << 17;
            if (mass[n] > 0.0 && fixed.c[k][n] == 0.0)
                q.c[k][n] = static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
        }
    return q;
}

} // namespace

double stable_step(Motion& motion, const std::vector<std::array<Column, 2>>& moduli, const FixedField& fixed,
                   double mass_scaling) {
    const NodeLayout& layout = motion.grid().layout();
    const Column& mass = motion.mass();
    VectorField q = start_vector(mass, fixed, layout), before(layout), product(layout), v(layout), z(layout);
    std::vector<double> diagonal, beside;
    double top = 0.0, beta = 0.0;
    constexpr int most = 200, check = 5;
    motion.consistent_mass(q, product);
    double norm = std::sqrt(dot(q, product));
    if (norm == 0.0) return stable_step(motion, moduli, FixedField(layout), mass_scaling); // nothing is free
    for (int k = 0; k < most && norm > 0.0; ++k) {
        scale(q, 1.0 / norm);
        scale(product, 1.0 / norm);
        if (k > 0) beside.push_back(beta);
        v = product;
        divide(v, mass, fixed);
        motion.stiffness(v, moduli, z);
        divide(z, mass, fixed);
        scale(z, -1.0); // internal forces oppose the displacement
        const double alpha = dot(z, product);
        diagonal.push_back(alpha);
        subtract(z, alpha, q);
        subtract(z, beta, before);
        before = q;
        q = z;
        motion.consistent_mass(q, product);
        beta = norm = std::sqrt(std::max(0.0, dot(q, product)));
        if (k % check != check - 1 && k + 1 < most && norm > 1e-12 * alpha) continue;
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
        solver.computeFromTridiagonal(
            Eigen::Map<Eigen::VectorXd>(diagonal.data(), static_cast<Eigen::Index>(diagonal.size())),
            Eigen::Map<Eigen::VectorXd>(beside.data(), static_cast<Eigen::Index>(beside.size())),
            Eigen::ComputeEigenvectors);
        const Eigen::Index k_top = solver.eigenvalues().size() - 1; // in increasing order
        top = solver.eigenvalues()[k_top];
        // Bounds the error of `top`.
        const double residual = beta * std::abs(solver.eigenvectors()(k_top, k_top));
        if (residual < 1e-3 * top) break;
    }
    return 2.0 * std::sqrt(mass_scaling / top);
}

} // namespace gault::core
