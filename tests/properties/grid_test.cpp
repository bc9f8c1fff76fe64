// Bases over random knots, bodies over random grids.
#include "tests/properties/bodies.hpp"

namespace {
using namespace properties;

Axis random_axis() {
    std::vector<double> knots{uniform(-10.0, 10.0)};
    for (int cells = whole(1, 12); cells > 0; --cells)
        knots.push_back(knots.back() + magnitude(-3.0, 1.0));
    return Axis(std::move(knots), whole(1, 2));
}

RC_GTEST_PROP(RandomAxis, HasFunctionsThatSumToOneAndReproduceX, ()) {
    const Axis axis = random_axis();
    const double size = std::abs(axis.lower()) + std::abs(axis.upper());
    for (int n = 0; n < 50; ++n) {
        const int cell = whole(0, axis.cells() - 1);
        const double xi = uniform(0.0, 1.0), h = axis.length()[cell], x = axis.origin()[cell] + xi * h;
        const Axis::Weights w = axis.weights(cell, xi);
        double one = 0.0, zero = 0.0, place = 0.0, slope = 0.0, steepest = 0.0;
        for (int a = 0; a <= axis.degree(); ++a) {
            RC_ASSERT(w.value[a] >= -rounding && w.value[a] <= 1.0 + rounding);
            one += w.value[a];
            zero += w.slope[a];
            place += w.value[a] * axis.node(cell + a);
            slope += w.slope[a] * axis.node(cell + a);
            steepest = std::max(steepest, std::abs(w.slope[a]));
        }
        RC_ASSERT(std::abs(one - 1.0) <= 4 * rounding);
        RC_ASSERT(std::abs(zero) <= 8 * rounding * steepest);
        RC_ASSERT(std::abs(place - x) <= 8 * rounding * size);
        RC_ASSERT(std::abs(slope - 1.0) <= 16 * rounding * (1.0 + steepest * size));
    }
}

// Sum of the gradients of all functions at every point: a uniform velocity strains nothing, and the internal forces of any
// stress, which are those gradients, sum to zero.
RC_GTEST_PROP(RandomGrid, InternalForcesSumToZero, ()) {
    RandomBody random(random_shape(random_symmetry()), 1e5);
    Body& body = *random.body;
    mohr_coulomb_test::Random values = properties::many();
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord&) {
        for (int k = 0; k < 4; ++k)
            c.stress[k][slot] = 1e5 * values.uniform(-1.0, 1.0);
    });
    VectorField f(body.layout());
    body.motion->forces(f);
    const bool ring = body.model.grid.axisymmetric();
    for (int k = ring ? 1 : 0; k < 2; ++k) { // along the radius the hoop stress has a resultant
        double sum = 0.0, size = 0.0;
        for (const double force : f.c[k])
            sum += force, size += std::abs(force);
        RC_ASSERT(size > 0.0);
        RC_ASSERT(std::abs(sum) <= 100 * rounding * size + 1e-3 * rounding * 1e5);
    }
}

// Rounding of displacements of this size, over the smallest cell, in the stress.
double noise(const RandomBody& random, double moved) {
    return 30 * rounding * (1e5 + (lame + 2 * shear) * (moved / random.smallest_cell() + 1.0));
}

// Strain is a difference of displacements over cells: it is known to their rounding over the smallest cell.
RC_GTEST_PROP(RandomGrid, TranslationCostsNoStress, ()) {
    const Symmetry symmetry = random_symmetry();
    RandomBody random(random_shape(symmetry), 1e5);
    Body& body = *random.body;
    std::array<double, 2> way{uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
    if (symmetry == Symmetry::axisymmetric) way[0] = 0.0;
    for (int n = 0; n < 5; ++n)
        body.motion->deform(body.field([&](double, double) { return way; }), {1.0, 1.0});
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord&) {
        for (int k = 0; k < 6; ++k)
            RC_ASSERT(std::abs(c.stress[k][slot] - random.stress[k]) <= 5 * noise(random, 1.0));
    });
}

// Nodes go from step to step on chords: the strain of a step is zero whatever its angle, and the stress turns with it.
RC_GTEST_PROP(RandomGrid, RotationCostsNoStress, ()) {
    RandomBody random(random_shape(Symmetry::plane_strain), 1e5);
    Body& body = *random.body;
    const double step = uniform(-0.1, 0.1);
    double angle = 0.0;
    constexpr int steps = 5;
    for (int n = 0; n < steps; ++n, angle += step) {
        const double from = random.total() ? angle : 0.0; // the updated grid stays
        const double c = std::cos(from + step) - std::cos(from), s = std::sin(from + step) - std::sin(from);
        body.motion->deform(body.field([&](double x, double y) {
            return std::array{c * x - s * y, s * x + c * y};
        }),
                            {1.0, 1.0});
    }
    const auto& s = random.stress;
    const auto turned = mohr_coulomb_test::rotated({s[0], s[1], s[2], s[3], 0.0, 0.0},
                                                   {{{std::cos(angle), -std::sin(angle), 0.0},
                                                     {std::sin(angle), std::cos(angle), 0.0},
                                                     {0.0, 0.0, 1.0}}});
    body.each_point([&](PointColumns& c, std::size_t slot, const PointRecord&) {
        for (int k = 0; k < 6; ++k)
            RC_ASSERT(std::abs(c.stress[k][slot] - turned[k]) <= steps * noise(random, 0.1 * 6.0));
    });
}

} // namespace
