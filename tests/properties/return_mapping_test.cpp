// Return mappings over random soils and increments, through the plugins' shared libraries.
#include "tests/properties/soils.hpp"

#include <cstring>

namespace {
using namespace properties;

constexpr std::size_t points_of_a_case = 256;

struct Step {
    Soil soil;
    std::vector<Increment> points;
    Answer end;
    Step(bool cone, bool flows_inward)
        : soil(random_soil(cone, flows_inward)), points(random_increments(soil, points_of_a_case)),
          end(update(soil, points)) {}
    Tensor trial(std::size_t i) const { return soil.elastic(points[i].stress_old, points[i].strain); }
};

// A yield function of degree one is known to some ten roundings of the stress. The cone's return scales the deviator of
// the trial stress, of which a part of 1e-16 stays.
void is_admissible(bool cone) {
    const Step step(cone, true);
    for (std::size_t i = 0; i < step.points.size(); ++i) {
        const double size = norm(step.end.stress[i]) + (cone ? 1e-6 * norm(step.trial(i)) : 0.0);
        RC_ASSERT(std::isfinite(size));
        RC_ASSERT(step.soil.excess(step.end.stress[i]) <= 1e-9 * (1.0 + size));
        RC_ASSERT(step.end.state[i] >= 0.0);
    }
}

// A stress on the surface is returned to itself.
void is_idempotent(bool cone) {
    const Step step(cone, true);
    std::vector<Increment> again;
    for (const Tensor& s : step.end.stress)
        again.push_back({s, {}});
    const Answer answer = update(step.soil, again);
    for (std::size_t i = 0; i < again.size(); ++i)
        RC_ASSERT(norm(minus(answer.stress[i], again[i].stress_old)) <=
                  1e-12 * (norm(again[i].stress_old) + (cone ? 1e-3 * norm(step.trial(i)) : 0.0)) + 1e-300);
}

// For 0 <= psi <= phi. Rounding of the trial stress is a spurious plastic strain, which stiffness amplifies.
void dissipates(bool cone) {
    const Step step(cone, false);
    const double stiff = 1.0 + std::abs(step.soil.p.lame()) / step.soil.p.G();
    for (std::size_t i = 0; i < step.points.size(); ++i) {
        const Tensor trial = step.trial(i);
        const Tensor plastic = step.soil.compliance(minus(trial, step.end.stress[i]));
        const double noise = 1e-15 * norm(trial) / step.soil.p.G() * stiff * norm(step.end.stress[i]);
        RC_ASSERT(dot(step.end.stress[i], plastic) >= -10.0 * noise);
    }
}

// Whatever batches the points come in, and in whatever order: the same bits.
void is_independent_of_company(bool cone) {
    const Step step(cone, true);
    mohr_coulomb_test::Random random = many();
    const auto order = shuffled(step.points.size(), random);
    std::vector<Increment> points;
    for (const std::size_t from : order)
        points.push_back(step.points[from]);
    std::vector<std::size_t> lengths;
    for (std::size_t left = points.size(); left > 0; left -= lengths.back())
        lengths.push_back(1 + random.engine() % std::min<std::size_t>(left, 40));
    const Answer answer = update(step.soil, points, lengths);
    for (std::size_t i = 0; i < points.size(); ++i) {
        RC_ASSERT(0 == std::memcmp(&answer.stress[i], &step.end.stress[order[i]], sizeof(Tensor)));
        RC_ASSERT(answer.state[i] == step.end.state[order[i]]);
    }
}

RC_GTEST_PROP(MohrCoulombReturn, IsAdmissible, ()) {
    is_admissible(false);
}
RC_GTEST_PROP(MohrCoulombReturn, IsIdempotent, ()) {
    is_idempotent(false);
}
RC_GTEST_PROP(MohrCoulombReturn, Dissipates, ()) {
    dissipates(false);
}
RC_GTEST_PROP(MohrCoulombReturn, IsIndependentOfCompany, ()) {
    is_independent_of_company(false);
}
RC_GTEST_PROP(DruckerPragerReturn, IsAdmissible, ()) {
    is_admissible(true);
}
RC_GTEST_PROP(DruckerPragerReturn, IsIdempotent, ()) {
    is_idempotent(true);
}
RC_GTEST_PROP(DruckerPragerReturn, Dissipates, ()) {
    dissipates(true);
}
RC_GTEST_PROP(DruckerPragerReturn, IsIndependentOfCompany, ()) {
    is_independent_of_company(true);
}

} // namespace
