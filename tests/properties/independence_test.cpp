// What a computation must not depend on: how points are laid out in memory, and how many threads share the work.
#include "tests/properties/bodies.hpp"

#include <cstring>
#include <map>

namespace {
using namespace properties;

using Bits = std::map<uint32_t, std::array<double, 10>>; // by point: stress, position, velocity

template <class Body>
Bits bits_of(Body& body, Motion& motion) {
    Bits all;
    body.model.points[0].each_point([&](std::size_t slot) {
        auto& one = all[body.model.points[0].identity(slot)];
        for (int k = 0; k < 6; ++k)
            one[k] = body.model.points[0].columns().stress[k][slot];
        const PointRecord r = motion.record(0, slot);
        one[6] = r.position[0], one[7] = r.position[1], one[8] = r.velocity[0], one[9] = r.velocity[1];
    });
    return all;
}
bool same(const Bits& a, const Bits& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
               return x.first == y.first && std::memcmp(&x.second, &y.second, sizeof x.second) == 0;
           });
}

// The same points in another order, in batches of another length.
Points rearranged(const Points& points, const Grid& grid, bool roaming, mohr_coulomb_test::Random& random) {
    std::vector<std::size_t> slots;
    points.each_point([&](std::size_t slot) { slots.push_back(slot); });
    std::vector<int32_t> cell;
    std::vector<uint32_t> identity;
    const auto order = shuffled(slots.size(), random);
    std::vector<int> row_of_page(points.layout().page_column.size());
    for (const gault::core::Batch& batch : points.layout().batches)
        std::fill_n(row_of_page.begin() + batch.first_page, batch.capacity, batch.cell_row);
    PointColumns columns = points.columns();
    columns.each([&](Column& column) {
        if (column.empty()) return;
        Column moved;
        for (const std::size_t from : order)
            moved.push_back(column[slots[from]]);
        column = std::move(moved);
    });
    for (const std::size_t from : order) {
        const std::size_t page = slots[from] / page_slots;
        cell.push_back(row_of_page[page] * grid.axis(0).cells() + points.layout().page_column[page]);
        identity.push_back(points.identity(slots[from]));
    }
    LayoutRequest request{grid.axis(0).cells(), grid.axis(1).cells(), grid.degree(0), roaming};
    request.pages_per_batch = 1 + static_cast<int>(random.engine() % 8);
    return Points(std::move(columns), cell, std::move(identity), request);
}

// Strains and stresses of a point to the bit; sums over points to rounding, since they are taken in another order.
RC_GTEST_PROP(Layout, OfPointsInMemoryChangesNoStress, ()) {
    const Shape shape = random_shape(random_symmetry());
    RandomBody first(shape, 1e5);
    mohr_coulomb_test::Random random = many();
    Body &one = *first.body, two(first.scene.scene);
    two.model.points[0] = rearranged(one.model.points[0], one.model.grid, !first.total(), random);
    const auto make =
        first.total() ? make_total_motion(two.model.grid, two.model.materials, two.model.points, 1)
                      : make_updated_motion(two.model.grid, two.model.materials, two.model.points, 1, true);
    VectorField v(one.layout()), f(v), g(v);
    for (int n = 0; n < 3; ++n) {
        for (int k = 0; k < 2; ++k)
            for (double& value : v.c[k])
                value = 1e-3 * first.smallest_cell() * random.uniform(-1.0, 1.0);
        for (Motion* motion : {one.motion.get(), make.get()})
            motion->deform(v, {1.0, 1.0});
    }
    RC_ASSERT(same(bits_of(one, *one.motion), bits_of(two, *make)));
    one.motion->forces(f);
    make->forces(g);
    double size = 0.0, off = 0.0;
    for (int k = 0; k < 2; ++k)
        for (std::size_t n = 0; n < f.c[k].size(); ++n) {
            size = std::max(size, std::abs(f.c[k][n]));
            off = std::max(off, std::abs(f.c[k][n] - g.c[k][n]));
        }
    RC_ASSERT(size > 0.0);
    RC_ASSERT(off <= 100 * rounding * size);
}

// A run: random stresses released, between rollers that keep the walls straight. The stable step is not looked for, which
// would take most of the time.
Bits run(const SmallScene& scene, int threads, double viscosity) {
    struct Run {
        Model model;
        ExplicitSolver solver;
        Run(const Scene& s, int n) : model(build_model(s)), solver(s, model, n) {}
    } run(scene.scene, threads);
    mohr_coulomb_test::Random random; // the same stresses for every number of threads
    std::map<uint32_t, std::size_t> slot_of;
    Points& points = run.model.points[0];
    points.each_point([&](std::size_t slot) { slot_of[points.identity(slot)] = slot; });
    for (const auto& [identity, slot] : slot_of)
        for (int k = 0; k < 4; ++k)
            points.columns().stress[k][slot] = 1e5 * random.uniform(-1.0, 1.0);
    double h = HUGE_VAL;
    for (int k = 0; k < 2; ++k)
        for (const double length : run.model.grid.axis(k).length())
            h = std::min(h, length);
    Motion& motion = run.solver.motion();
    motion.set_viscosity({{viscosity * lame, viscosity * shear}});
    for (int n = 0; n < 4; ++n)
        run.solver.step(0.2 * h / std::sqrt((lame + 2.0 * shear) / 1600.0));
    return bits_of(run, motion);
}

RC_GTEST_PROP(Threads, ChangeNoBit, ()) {
    Shape shape = random_shape(random_symmetry());
    shape.axes = {{{whole(3, 40), 1.0}, {whole(3, 6), 1.0}}}; // up to several batches a row of cells
    TestMaterial soil{lame, shear};
    SmallScene scene(shape);
    scene.add(soil, 1600.0);
    scene.roll({0, 1, 2, 3});
    scene.scene.solver.stress_update = coin() ? StressUpdate::usl : StressUpdate::usf;
    scene.scene.solver.viscosity = coin() ? 0.1 : 0.0; // the updated frame keeps strains for it
    scene.scene.solver.damping = coin() ? 0.5 : 0.0;
    const double viscosity = scene.scene.solver.viscosity;
    RC_ASSERT(same(run(scene, 1, viscosity), run(scene, whole(2, 3), viscosity)));
}

} // namespace
