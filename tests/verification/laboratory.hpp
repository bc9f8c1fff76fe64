// One material point of a plugin in the laboratory: of each of the six components of a step either the strain or the
// stress is prescribed. Stress and strain are those of the contract: tension positive, tensor shear; xx is the
// axial direction of triaxial() and oedometer(). Throws std::runtime_error where no step can be made.
#pragma once
#include "plugin_fixture.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace plugin_test {

struct Control {
    enum Kind { strain, stress } kind;
    double value; // increment of strain; stress at the end of the step, Pa
};
using Controls = std::array<Control, 6>;

class Laboratory {
  public:
    Laboratory(const Component& soil, const Tensor& initial_stress) : batch_(soil, lanes) {
        for (int64_t i = 0; i < lanes; ++i)
            batch_.set_stress_old(i, initial_stress);
        if (batch_.start() != GAULT_OK) throw std::runtime_error(batch_.error.text);
    }

    const Tensor& strain() const { return strain_; } // so far
    Tensor stress() const { return column(batch_.stress_old); }
    double state(int component) const { return batch_.state_old[static_cast<std::size_t>(component)][0]; }
    void set_dt(double dt) { batch_.set_dt(dt); }

    double p() const { // mean stress, compression positive
        const Tensor s = stress();
        return -(s[0] + s[1] + s[2]) / 3.0;
    }
    double q() const { // sqrt(3 J2)
        const Tensor s = stress();
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            sum += 1.5 * (s[i] + p()) * (s[i] + p()) + 3.0 * s[i + 3] * s[i + 3];
        return std::sqrt(sum);
    }
    double volumetric_strain() const { return strain_[0] + strain_[1] + strain_[2]; } // dilation positive

    // Newton's method on the prescribed stresses; d stress / d strain from the differences of the lanes of one batch.
    void step(const Controls& control) {
        Tensor increment{};
        std::vector<std::size_t> unknown;
        for (std::size_t i = 0; i < 6; ++i)
            if (control[i].kind == Control::strain)
                increment[i] = control[i].value;
            else
                unknown.push_back(i);
        for (int iteration = 0;; ++iteration) {
            if (!answers(increment, unknown)) throw std::runtime_error(batch_.error.text);
            const Eigen::VectorXd missing = misfit(control, unknown);
            if (missing.norm() <= 1e-10 * (size(stress()) + size(column(batch_.stress)) + 1.0)) break;
            if (iteration == most_iterations)
                throw std::runtime_error("the prescribed stress is not reached");
            move(control, unknown, missing, increment);
        }
        for (std::size_t i = 0; i < 6; ++i)
            strain_[i] += increment[i];
        batch_.advance();
        for (Columns* columns :
             {&batch_.stress_old, &batch_.state_old}) // every lane stands where the first does
            for (Column& c : *columns)
                std::fill(c.data(), c.data() + lanes, c[0]);
    }

    // Drained: axial strain, tension positive, at constant lateral stress. Undrained: at constant volume, sum zero.
    void triaxial_drained(double axial, double lateral_stress) {
        step({{{Control::strain, axial},
               {Control::stress, lateral_stress},
               {Control::stress, lateral_stress},
               {Control::strain, 0.0},
               {Control::strain, 0.0},
               {Control::strain, 0.0}}});
    }
    void strain_step(const Tensor& increment) {
        Controls c{};
        for (std::size_t i = 0; i < 6; ++i)
            c[i] = {Control::strain, increment[i]};
        step(c);
    }
    void triaxial_undrained(double axial) { strain_step({axial, -axial / 2.0, -axial / 2.0, 0.0, 0.0, 0.0}); }
    void oedometer(double axial) { strain_step({axial, 0.0, 0.0, 0.0, 0.0, 0.0}); }
    void isotropic(double stress) { // to this stress, tension positive
        step({{{Control::stress, stress},
               {Control::stress, stress},
               {Control::stress, stress},
               {Control::strain, 0.0},
               {Control::strain, 0.0},
               {Control::strain, 0.0}}});
    }

  private:
    static constexpr int64_t lanes = 8; // the step, and one shifted for every unknown
    static constexpr double shift = 1e-9;
    static constexpr int most_iterations = 60;

    static Tensor column(const Columns& columns, int64_t lane = 0) {
        Tensor t;
        for (std::size_t i = 0; i < 6; ++i)
            t[i] = columns[i][lane];
        return t;
    }
    static double size(const Tensor& t) {
        double sum = 0.0;
        for (double x : t)
            sum += x * x;
        return std::sqrt(sum);
    }
    bool answers(const Tensor& increment, const std::vector<std::size_t>& unknown) {
        for (int64_t lane = 0; lane < lanes; ++lane) {
            Tensor e = increment;
            if (lane > 0 && static_cast<std::size_t>(lane) <= unknown.size())
                e[unknown[static_cast<std::size_t>(lane) - 1]] += shift;
            batch_.set_strain(lane, e);
        }
        return batch_.update() == GAULT_OK;
    }
    Eigen::VectorXd misfit(const Controls& control, const std::vector<std::size_t>& unknown) const {
        Eigen::VectorXd r(static_cast<Eigen::Index>(unknown.size()));
        for (std::size_t k = 0; k < unknown.size(); ++k)
            r[static_cast<Eigen::Index>(k)] = control[unknown[k]].value - batch_.stress[unknown[k]][0];
        return r;
    }
    // A Newton correction, halved while it does not bring the stress nearer.
    void move(const Controls& control, const std::vector<std::size_t>& unknown,
              const Eigen::VectorXd& missing, Tensor& increment) {
        const auto n = static_cast<Eigen::Index>(unknown.size());
        Eigen::MatrixXd tangent(n, n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j) {
                const Column& s = batch_.stress[unknown[static_cast<std::size_t>(i)]];
                tangent(i, j) = (s[j + 1] - s[0]) / shift;
            }
        Eigen::VectorXd correction = tangent.fullPivLu().solve(missing);
        const Tensor before = increment;
        for (int halving = 0; halving < 12; ++halving, correction *= 0.5) {
            for (Eigen::Index k = 0; k < n; ++k)
                increment[unknown[static_cast<std::size_t>(k)]] =
                    before[unknown[static_cast<std::size_t>(k)]] + correction[k];
            if (answers(increment, unknown) && misfit(control, unknown).norm() < missing.norm()) return;
        }
    }

    Batch batch_;
    Tensor strain_{};
};

} // namespace plugin_test
