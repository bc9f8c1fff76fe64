#include "tests/unit/transfer/plain.hpp"
#include "tests/unit/transfer/trial.hpp"

#include "core/base/isa.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <tuple>

namespace gault::core {
namespace {

constexpr double rounding = 1e-12; // of sums of order-one numbers

// instruction set, degree, axisymmetric; a variant that this processor lacks is the best that it has
class EveryKernel : public testing::TestWithParam<std::tuple<Isa, int, bool>> {
  protected:
    int degree = std::get<1>(GetParam());
    bool axisymmetric = std::get<2>(GetParam());
    const Kernels& kernels = variant(std::get<0>(GetParam()));

    const Kernels& variant(Isa isa) const {
        setenv("GAULT_ISA", isa_name(isa), 1);
        const Kernels& found = select_kernels({degree, degree, axisymmetric});
        unsetenv("GAULT_ISA");
        return found;
    }
};

// A point of a trial, as the plain code sees it.
class PlainPoint {
  public:
    PlainPoint(const Trial& t, std::size_t slot) : t_(t), slot_(slot) {
        const PointColumns& c = t.points.columns();
        const int column = t.cell_column(slot), row = t.cell_row(slot);
        x = t.updated ? c.place[0][slot] : t.x.origin()[column] + c.place[0][slot] * t.x.length()[column];
        y = t.updated ? c.place[1][slot] : t.y.origin()[row] + c.place[1][slot] * t.y.length()[row];
        nx = plain::basis(t.x, x, t.degree), ny = plain::basis(t.y, y, t.degree);
        dx = plain::slopes(t.x, x), dy = plain::slopes(t.y, y);
    }
    double x, y;
    std::vector<double> nx, ny, dx, dy;

    template <class F>
    void nodes(F f) const { // f(node, N, dN/dx, dN/dy)
        for (int j = 0; j < t_.y.nodes(); ++j)
            for (int i = 0; i < t_.x.nodes(); ++i)
                f(t_.layout.index(i, j), nx[i] * ny[j], dx[i] * ny[j], nx[i] * dy[j]);
    }
    std::array<double, 2> at(const VectorField& field) const {
        std::array<double, 2> value{};
        nodes([&](std::size_t n, double w, double, double) {
            for (int k = 0; k < 2; ++k)
                value[k] += w * field.c[k][n];
        });
        return value;
    }
    // d field / dX, with field_r / r in the hoop place
    plain::Matrix gradient(const VectorField& field) const {
        plain::Matrix g{};
        nodes([&](std::size_t n, double, double gx, double gy) {
            for (int k = 0; k < 2; ++k) {
                g[k][0] += gx * field.c[k][n];
                g[k][1] += gy * field.c[k][n];
            }
        });
        if (t_.axisymmetric) g[2][2] = at(field)[0] / x;
        return g;
    }
    std::array<double, 6> stress() const {
        std::array<double, 6> s;
        for (int k = 0; k < 6; ++k)
            s[k] = t_.points.columns().stress[k][slot_];
        return s;
    }

  private:
    const Trial& t_;
    std::size_t slot_;
};

void expect_fields(const std::vector<Column>& found, const std::vector<Column>& expected) {
    for (std::size_t k = 0; k < expected.size(); ++k)
        for (std::size_t n = 0; n < expected[k].size(); ++n)
            ASSERT_NEAR(found[k][n], expected[k][n], rounding * 100.0) << k << ' ' << n;
}

void expect_step(const SlotResults& r, std::size_t slot, const plain::Step& expected) {
    constexpr int in_plane[4] = {0, 1, 2, 3};
    for (const int k : in_plane)
        ASSERT_NEAR(r.strain[k][slot], expected.strain[k], rounding) << k;
    for (int k = 0; k < 6; ++k)
        ASSERT_NEAR(r.stress_old[k][slot], expected.stress_old[k], rounding) << k;
    ASSERT_NEAR(r.rotation[0][slot], expected.cosine, rounding);
    ASSERT_NEAR(r.rotation[1][slot], -expected.sine, rounding); // x' = c x + s y
}

void expect_gradient(const std::array<Column, 5>& found, std::size_t slot, const plain::Matrix& f) {
    const double expected[5] = {f[0][0], f[0][1], f[1][0], f[1][1], f[2][2]};
    for (int k = 0; k < 5; ++k)
        ASSERT_NEAR(found[k][slot], expected[k], rounding) << k;
}

TEST_P(EveryKernel, StrainsAndRotatesInTheTotalFrameAsPlainMatricesDo) {
    Trial t(degree, axisymmetric, false);
    for (const bool rotate : {true, false}) {
        SlotResults r(t.points.slots());
        t.sweep(r, 2, [&](BatchView& v) { kernels.total_strain(t.grid(), v, t.input(0.03, rotate)); });
        t.points.each_point([&](std::size_t slot) {
            const PlainPoint p(t, slot);
            const auto f_old = plain::combine(1.0, plain::identity(), 1.0, p.gradient(t.displacement));
            const auto f_new = plain::combine(1.0, f_old, 0.03, p.gradient(t.velocity));
            const plain::Step expected = plain::step(f_old, f_new, p.stress(), rotate);
            expect_step(r, slot, expected);
            expect_gradient(r.gradient_old, slot, f_old);
            expect_gradient(r.gradient_new, slot, f_new);
            ASSERT_NEAR(r.volume_ratio[slot], plain::determinant(f_new), rounding);
        });
    }
}

// f_i = - V (stress . grad N + stress_zz N / r) at the end of the step, in the present configuration
TEST_P(EveryKernel, ForcesInTheTotalFrameAreStressTimesPresentGradients) {
    Trial t(degree, axisymmetric, false);
    SlotResults r(t.points.slots());
    const double dt = 0.03;
    const auto found = t.sweep(r, 2, [&](BatchView& v) {
        kernels.total_strain(t.grid(), v, t.input(dt));
        kernels.total_force(t.grid(), v);
    });
    std::vector<Column> expected(2, Column(t.layout.size));
    t.points.each_point([&](std::size_t slot) {
        const PlainPoint p(t, slot);
        const auto f =
            plain::combine(1.0, plain::combine(1.0, plain::identity(), 1.0, p.gradient(t.displacement)), dt,
                           p.gradient(t.velocity));
        const auto inverse = plain::inverted(f);
        const double radius = p.x + p.at(t.displacement)[0] + dt * p.at(t.velocity)[0];
        const double reference = t.points.columns().measure[slot] * (axisymmetric ? p.x : 1.0);
        const double volume = reference * plain::determinant(f);
        const auto s = p.stress();
        p.nodes([&](std::size_t n, double value, double gx, double gy) {
            const double x = gx * inverse[0][0] + gy * inverse[1][0],
                         y = gx * inverse[0][1] + gy * inverse[1][1];
            expected[0][n] -= volume * (s[0] * x + s[3] * y + (axisymmetric ? s[2] * value / radius : 0.0));
            expected[1][n] -= volume * (s[3] * x + s[1] * y);
        });
    });
    expect_fields(found, expected);
}

TEST_P(EveryKernel, ViscousStressIsTheElasticStressOfTheStepsStrain) {
    constexpr double lame = 2.0, shear = 3.0;
    for (const bool updated : {false, true}) {
        Trial t(degree, axisymmetric, updated);
        SlotResults r(t.points.slots());
        const auto forces = [&](double viscous) {
            return t.sweep(r, updated ? 3 : 2, [&](BatchView& v) {
                v.viscous_lame = viscous * lame;
                v.viscous_shear = viscous * shear;
                if (updated) {
                    kernels.updated_strain(t.grid(), v, t.input(0.03), false, false);
                    kernels.updated_force(t.grid(), v);
                } else {
                    kernels.total_strain(t.grid(), v, t.input(0.03));
                    kernels.total_force(t.grid(), v);
                }
            });
        };
        const auto with = forces(1.0);
        t.points.each_point([&](std::size_t slot) {
            const double volumetric = lame * (r.strain[0][slot] + r.strain[1][slot] + r.strain[2][slot]);
            for (int k = 0; k < 4; ++k)
                t.points.columns().stress[k][slot] +=
                    2.0 * shear * r.strain[k][slot] + (k < 3 ? volumetric : 0.0);
        });
        expect_fields(with, forces(0.0));
    }
}

// sum f . v = - sum V stress : strain rate, for any velocity
TEST_P(EveryKernel, ForcesDoTheWorkOfTheStresses) {
    constexpr double dt = 1e-7; // the strain of a step is linear in the velocity to this order
    for (const bool updated : {false, true}) {
        Trial t(degree, axisymmetric, updated);
        SlotResults r(t.points.slots());
        const auto f = t.sweep(r, 3, [&](BatchView& v) {
            if (updated) {
                kernels.updated_strain(t.grid(), v, t.input(dt), false, false);
                kernels.updated_force(t.grid(), v);
            } else {
                kernels.total_strain(t.grid(), v, t.input(dt));
                kernels.total_force(t.grid(), v);
            }
        });
        double power = 0.0, work = 0.0, size = 0.0;
        for (int k = 0; k < 2; ++k)
            for (std::size_t n = 0; n < t.layout.size; ++n)
                power += f[k][n] * t.velocity.c[k][n];
        t.points.each_point([&](std::size_t slot) {
            const PointColumns& c = t.points.columns();
            const double r0 = axisymmetric ? PlainPoint(t, slot).x : 1.0;
            const double volume = updated ? c.measure[slot] : c.measure[slot] * r0 * r.volume_ratio[slot];
            for (int k = 0; k < 4; ++k) {
                const double part =
                    volume * c.stress[k][slot] * r.strain[k][slot] / dt * (k == 3 ? 2.0 : 1.0);
                work += part;
                size += std::abs(part);
            }
        });
        EXPECT_NEAR(power, -work, 1e-6 * size) << (updated ? "updated" : "total");
    }
}

TEST_P(EveryKernel, StrainsAndMovesInTheUpdatedFrameAsPlainMatricesDo) {
    constexpr double dt = 0.03;
    const Trial before(degree, axisymmetric, true);
    for (const bool move : {true, false}) {
        Trial t(degree, axisymmetric, true);
        SlotResults r(t.points.slots());
        t.sweep(r, 3, [&](BatchView& v) { kernels.updated_strain(t.grid(), v, t.input(dt), true, move); });
        before.points.each_point([&](std::size_t slot) {
            const PlainPoint p(before, slot);
            const PointColumns &old = before.points.columns(), &now = t.points.columns();
            const auto change = plain::combine(1.0, plain::identity(), dt, p.gradient(before.velocity));
            expect_step(r, slot, plain::step(plain::identity(), change, p.stress(), true));
            ASSERT_NEAR(now.measure[slot], old.measure[slot] * plain::determinant(change), rounding);
            const auto f = [&](const PointColumns& c) {
                return plain::Matrix{{{c.deformation[0][slot], c.deformation[1][slot], 0},
                                      {c.deformation[2][slot], c.deformation[3][slot], 0},
                                      {0, 0, c.deformation[4][slot]}}};
            };
            expect_gradient(r.gradient_old, slot, f(old));
            expect_gradient(r.gradient_new, slot, plain::product(change, f(old)));
            expect_gradient(now.deformation, slot, plain::product(change, f(old)));
            const auto v = p.at(before.velocity);
            for (int k = 0; k < 2; ++k)
                ASSERT_NEAR(now.place[k][slot], old.place[k][slot] + (move ? dt * v[k] : 0.0), rounding);
        });
    }
}

TEST_P(EveryKernel, AProbeOfTheUpdatedFrameChangesNoPoint) {
    const Trial before(degree, axisymmetric, true);
    Trial t(degree, axisymmetric, true);
    SlotResults r(t.points.slots());
    t.sweep(r, 3, [&](BatchView& v) { kernels.updated_strain(t.grid(), v, t.input(0.03), false, false); });
    const PointColumns &old = before.points.columns(), &now = t.points.columns();
    EXPECT_EQ(now.measure, old.measure);
    EXPECT_EQ(now.place, old.place);
    EXPECT_EQ(now.deformation, old.deformation);
}

TEST_P(EveryKernel, ForcesAndMassInTheUpdatedFrameAreSumsOverPoints) {
    Trial t(degree, axisymmetric, true);
    SlotResults r(t.points.slots());
    std::vector<Column> expected(3, Column(t.layout.size));
    t.points.each_point([&](std::size_t slot) {
        const PlainPoint p(t, slot);
        const auto s = p.stress();
        const double volume = t.points.columns().measure[slot], hoop = axisymmetric ? s[2] / p.x : 0.0;
        p.nodes([&](std::size_t n, double value, double gx, double gy) {
            expected[0][n] -= volume * (s[0] * gx + s[3] * gy + hoop * value);
            expected[1][n] -= volume * (s[3] * gx + s[1] * gy);
            expected[2][n] += t.points.columns().mass[slot] * value;
        });
    });
    expect_fields(t.sweep(r, 3, [&](BatchView& v) { kernels.updated_force(t.grid(), v); }), expected);
}

TEST_P(EveryKernel, VelocitiesGoToThePointsAndBackAsMomentum) {
    constexpr double dt = 0.03;
    const Trial before(degree, axisymmetric, true);
    Trial t(degree, axisymmetric, true);
    SlotResults r(t.points.slots());
    const double* acceleration[2] = {t.acceleration.c[0].data(), t.acceleration.c[1].data()};
    const double* moving[2] = {t.velocity.c[0].data(), t.velocity.c[1].data()};
    const auto momentum = t.sweep(
        r, 3, [&](BatchView& v) { kernels.updated_velocity(t.grid(), v, dt, acceleration, nullptr, true); });
    std::vector<Column> expected(3, Column(t.layout.size));
    before.points.each_point([&](std::size_t slot) {
        const PlainPoint p(before, slot);
        const PointColumns &old = before.points.columns(), &now = t.points.columns();
        const auto a = p.at(before.acceleration);
        for (int k = 0; k < 2; ++k)
            ASSERT_NEAR(now.velocity[k][slot], old.velocity[k][slot] + dt * a[k], rounding);
        p.nodes([&](std::size_t n, double value, double, double) {
            const double share = value * old.mass[slot];
            for (int k = 0; k < 2; ++k)
                expected[k][n] += share * (old.velocity[k][slot] + dt * a[k]);
            expected[2][n] += share;
        });
    });
    expect_fields(momentum, expected);

    t.sweep(r, 3, [&](BatchView& v) { kernels.updated_velocity(t.grid(), v, dt, nullptr, moving, false); });
    before.points.each_point([&](std::size_t slot) {
        const auto v = PlainPoint(before, slot).at(before.velocity);
        for (int k = 0; k < 2; ++k)
            ASSERT_NEAR(t.points.columns().place[k][slot], before.points.columns().place[k][slot] + dt * v[k],
                        rounding);
    });
}

TEST_P(EveryKernel, ReportsTheLargestStrainAndTheFirstPointBeyondTheLimit) {
    for (const bool updated : {false, true}) {
        Trial t(degree, axisymmetric, updated);
        SlotResults r(t.points.slots());
        const auto reports = [&](double limit) {
            std::vector<StrainReport> all;
            t.sweep(r, 3, [&](BatchView& v) {
                all.push_back(
                    updated ? kernels.updated_strain(t.grid(), v, t.input(0.03, true, limit), false, false)
                            : kernels.total_strain(t.grid(), v, t.input(0.03, true, limit)));
            });
            return all;
        };
        const auto free = reports(10.0), held = reports(0.05);
        for (std::size_t b = 0; b < free.size(); ++b) {
            const Batch& batch = t.points.layout().batches[b];
            const std::size_t first = static_cast<std::size_t>(batch.first_page) * page_slots;
            double largest = 0.0;
            int64_t bad = -1;
            for (int i = 0; i < batch.pages * page_slots; ++i)
                for (int k = 0; k < 4; ++k) {
                    largest = std::max(largest, std::abs(r.strain[k][first + i]));
                    if (bad < 0 && std::abs(r.strain[k][first + i]) >= 0.05) bad = i;
                }
            EXPECT_EQ(free[b].bad, -1);
            EXPECT_EQ(free[b].largest, largest);
            EXPECT_EQ(held[b].bad, bad);
        }
    }
}

TEST_P(EveryKernel, NoticesAPointThatIsNotANumberOrTurnedInsideOut) {
    for (const bool updated : {false, true})
        for (const double rate : {std::nan(""), -40.0}) { // 1 + rate dt < 0
            Trial t(degree, axisymmetric, updated);
            SlotResults r(t.points.slots());
            t.displacement.clear();
            t.velocity.clear();
            for (int j = 0; j < t.y.nodes(); ++j)
                for (int i = 0; i < t.x.nodes(); ++i)
                    t.velocity.c[1][t.layout.index(i, j)] = rate * t.y.node(j);
            t.sweep(r, 3, [&](BatchView& v) {
                const StrainInput in = t.input(0.03, true, 1e300);
                const StrainReport report = updated ? kernels.updated_strain(t.grid(), v, in, false, false)
                                                    : kernels.total_strain(t.grid(), v, in);
                EXPECT_EQ(report.bad, 0) << rate;
            });
        }
}

TEST_P(EveryKernel, EmptySlotsContributeNothing) {
    for (const bool updated : {false, true}) {
        const auto everything = [&](Trial& t) {
            SlotResults r(t.points.slots());
            std::vector<Column> all;
            const double* a[2] = {t.acceleration.c[0].data(), t.acceleration.c[1].data()};
            for (int pass = 0; pass < 2; ++pass)
                for (Column& c : t.sweep(r, 3, [&](BatchView& v) {
                         if (updated && pass == 0)
                             kernels.updated_velocity(t.grid(), v, 0.03, a, nullptr, true);
                         if (updated && pass == 1) {
                             const auto report =
                                 kernels.updated_strain(t.grid(), v, t.input(0.03), true, true);
                             EXPECT_EQ(report.bad, -1);
                             kernels.updated_force(t.grid(), v);
                         }
                         if (!updated) {
                             EXPECT_EQ(kernels.total_strain(t.grid(), v, t.input(0.03)).bad, -1);
                             kernels.total_force(t.grid(), v);
                         }
                     }))
                    all.push_back(std::move(c));
            return all;
        };
        const Trial untouched(degree, axisymmetric, updated);
        Trial clean(degree, axisymmetric, updated), dirty(degree, axisymmetric, updated);
        std::size_t empty = 0;
        for (std::size_t slot = 0; slot < dirty.points.slots(); ++slot) {
            if (dirty.points.identity(slot) != no_point) continue;
            ++empty;
            PointColumns& c = dirty.points.columns();
            for (Column& s : c.stress)
                s[slot] = 1e9;
            for (Column& p : c.place)
                p[slot] += 0.7; // in another cell by now
            if (!updated) continue;
            for (Column& v : c.velocity)
                v[slot] = 1e9;
        }
        ASSERT_GT(empty, 0u);
        EXPECT_EQ(everything(clean), everything(dirty)) << (updated ? "updated" : "total");
        for (std::size_t slot = 0; updated && slot < dirty.points.slots(); ++slot) {
            if (dirty.points.identity(slot) != no_point) continue;
            for (int k = 0; k < 5; ++k)
                ASSERT_EQ(dirty.points.columns().deformation[k][slot],
                          untouched.points.columns().deformation[k][slot]);
        }
    }
}

TEST_P(EveryKernel, FindsThePointsThatLeftTheirCells) {
    Trial t(degree, axisymmetric, true);
    std::vector<std::size_t> expected;
    t.points.each_point([&](std::size_t slot) {
        if (slot % 3) return;
        expected.push_back(slot);
        t.points.columns().place[slot % 2][slot] += slot % 4 < 2 ? 5.0 : -5.0;
    });
    SlotResults r(t.points.slots());
    std::vector<std::size_t> found;
    for (const Batch& batch : t.points.layout().batches) {
        int64_t slots[1000];
        const BatchView v = t.view(batch, r);
        const int64_t n = kernels.leavers(t.grid(), v, slots, 1000);
        EXPECT_EQ(kernels.leavers(t.grid(), v, slots, 1), n) << "counts beyond its capacity";
        kernels.leavers(t.grid(), v, slots, 1000);
        for (int64_t i = 0; i < n; ++i)
            found.push_back(static_cast<std::size_t>(batch.first_page) * page_slots +
                            static_cast<std::size_t>(slots[i]));
    }
    EXPECT_EQ(found, expected);
}

TEST_P(EveryKernel, StencilMultipliesByTheNeighbours) {
    Trial t(degree, axisymmetric, false);
    const int reach = 2 * degree + 1;
    std::vector<Column> coefficient(static_cast<std::size_t>(reach * reach), Column(t.layout.size));
    for (Column& c : coefficient)
        for (double& value : c)
            value = t.uniform(-1.0, 1.0);
    const Column& in = t.velocity.c[0];
    Column out(t.layout.size);
    for (int j = 0; j < t.layout.ny; ++j) {
        const std::size_t begin = t.layout.row_begin(j);
        std::vector<const double*> at;
        for (const Column& c : coefficient)
            at.push_back(c.data() + begin);
        kernels.stencil(at.data(), t.layout.row, in.data() + begin, out.data() + begin);
    }
    for (int j = 0; j < t.layout.ny; ++j)
        for (int i = 0; i < t.layout.nx; ++i) {
            double expected = 0.0;
            for (int b = -degree; b <= degree; ++b)
                for (int a = -degree; a <= degree; ++a)
                    expected += coefficient[static_cast<std::size_t>((b + degree) * reach + a + degree)]
                                           [t.layout.index(i, j)] *
                                in[t.layout.index(i + a, j + b)];
            ASSERT_NEAR(out[t.layout.index(i, j)], expected, rounding);
        }
}

// Points are computed lane by lane: to the bit. Sums over points run in another order: to rounding.
TEST_P(EveryKernel, AgreesWithTheBaseline) {
    const Kernels& baseline = variant(Isa::baseline);
    Trial t(degree, axisymmetric, false), u(degree, axisymmetric, false);
    SlotResults r(t.points.slots()), s(u.points.slots());
    const auto run = [](const Kernels& k, Trial& trial, SlotResults& results) {
        return trial.sweep(results, 2, [&](BatchView& v) {
            k.total_strain(trial.grid(), v, trial.input(0.03));
            k.total_force(trial.grid(), v);
        });
    };
    expect_fields(run(kernels, t, r), run(baseline, u, s));
    EXPECT_EQ(r.strain, s.strain);
    EXPECT_EQ(r.stress_old, s.stress_old);
    EXPECT_EQ(r.flux, s.flux);
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryKernel,
                         testing::Combine(testing::Values(Isa::baseline, Isa::v3, Isa::v4),
                                          testing::Values(1, 2), testing::Bool()),
                         [](const auto& instance) {
                             std::string name = isa_name(std::get<0>(instance.param));
                             std::erase(name, '-');
                             name += std::get<1>(instance.param) == 1 ? "Linear" : "Quadratic";
                             return name + (std::get<2>(instance.param) ? "Axisymmetric" : "Plane");
                         });

TEST(SelectKernels, ObeysTheWantedInstructionSet) {
    setenv("GAULT_ISA", "baseline", 1);
    EXPECT_STREQ(select_kernels({1, 1, true}).isa, "baseline");
    unsetenv("GAULT_ISA");
    EXPECT_STREQ(select_kernels({1, 1, true}).isa, isa_name(best_isa()));
}

} // namespace
} // namespace gault::core
