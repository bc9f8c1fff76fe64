// Soils that are wrong in one way each. Where nothing else is said, linear elasticity.
#include "tests/certificate/base_soils.hpp"

#include <cstdlib>
#include <thread>

namespace {

using gault::Components;
using gault::Mask;
using gault::Pack;

// ---- declaration ----

struct Undocumented : Elastic {
    static constexpr const char* name = "undocumented";
    static constexpr std::array states{gault::scalar_state("work", "kJo/m^3", "Of the past")};
};

// ---- effect ----

struct ForgetsAState : Cone {
    static constexpr const char* name = "forgets_a_state";
    static constexpr std::array states{gault::scalar_state("plastic_strain", "1", "Never written.", 0, 0)};
};

// ---- bounds ----

// What becomes of it where `extra` is 1, the largest that it allows.
template <int kind>
struct AtItsBound : Elastic {
    static constexpr const char* names[] = {"crashes_at_bound", "fails_at_bound", "silent_at_bound",
                                            "nan_at_bound"};
    static constexpr const char* name = names[kind];
    double extra;
    static constexpr std::array parameters{
        Elastic::parameters[0], Elastic::parameters[1],
        gault::parameter<&AtItsBound::extra>("extra", "", "1", "Of no use.")
            .at_least(0)
            .at_most(1)
            .fallback(0.5)};
    void prepare() {
        Elastic::prepare();
        if (extra < 1.0) return;
        if (kind == 0) std::abort();
        if (kind == 1) throw std::runtime_error("has no result");
        if (kind == 2) throw gault::Invalid("nobody", "is refused under no name");
    }
    void update(gault::Point& p) const {
        elastic(p);
        if (kind == 3) p.stress[0] += (1.0 - extra) / (1.0 - extra) - 1.0;
    }
};

struct OneForAll : Elastic { // parameters in a static: the last instance's hold for all
    static constexpr const char* name = "one_for_all";
    static inline double lame_of_all, shear_of_all;
    void prepare() {
        Elastic::prepare();
        lame_of_all = lame, shear_of_all = shear;
    }
    void update(gault::Point& p) const {
        elastic(p);
        p.stress = gault::add_elastic(p.stress_old, p.strain, lame_of_all, 2.0 * shear_of_all);
    }
};

// ---- batches ----

struct ByPosition : Elastic {
    static constexpr const char* name = "by_position";
    static gault_status spoil(gault_points& p) {
        for (int64_t i = 0; i < p.count; ++i)
            p.stress[0][i] *= 1.0 + 1e-13 * static_cast<double>(i);
        return GAULT_OK;
    }
};
struct ByNeighbour : Elastic { // an iteration that all lanes of a pack go on with until the last is done
    static constexpr const char* name = "by_neighbour";
    void update(gault::Point& p) const {
        elastic(p);
        p.stress[0] += 1e-3 * sum(norm(p.strain));
    }
};
struct ByPadding : Elastic {
    static constexpr const char* name = "by_padding";
    static gault_status spoil(gault_points& p) {
        if (p.count < p.padded) p.stress[0][p.count - 1] += p.strain[0][p.count] - p.strain[0][p.count - 1];
        return GAULT_OK;
    }
};
struct ByOrder : Elastic { // begins to look for a point's stress where that of the one before it was
    static constexpr const char* name = "by_order";
    static gault_status spoil(gault_points& p) {
        for (int64_t i = 1; i < p.count; ++i)
            p.stress[0][i] += 1e-12 * p.strain[0][i - 1] * p.stress[0][i - 1];
        return GAULT_OK;
    }
};
struct ByCalls : Elastic { // remembers that it was called
    static constexpr const char* name = "by_calls";
    static constexpr bool one_at_a_time = true;
    static gault_status spoil(gault_points& p) {
        static int64_t calls = 0;
        p.stress[0][0] += 1e-9 * static_cast<double>(++calls);
        return GAULT_OK;
    }
};
struct LeavesStates : Elastic { // writes no state, since none changes
    static constexpr const char* name = "leaves_states";
    static constexpr std::array states{gault::scalar_state("cementation", "1", "Of the grains.", 0)};
};
struct WithoutStates {
    static gault_status update(const void* self, gault_points* points, gault_error* error) noexcept {
        alignas(64) double aside[1024];
        double* states[] = {aside};
        gault_points changed = *points;
        changed.state = states;
        return gault::detail::update<LeavesStates>(self, &changed, error);
    }
    static constexpr gault_material_api api = answered_by<LeavesStates>(&update);
    static constexpr gault_component declaration =
        gault::detail::component<LeavesStates>(GAULT_MATERIAL, &api);
};
struct WantsModuli : Elastic { // writes them to a host that did not ask
    static constexpr const char* name = "wants_moduli";
    static gault_status spoil(gault_points& p) {
        for (int64_t i = 0; i < p.count; ++i)
            p.modulus[i] *= 1.001;
        return GAULT_OK;
    }
};
struct TangentOnTheWay : Cone { // forgets to flow where it is asked for the tangent
    static constexpr const char* name = "tangent_on_the_way";
    void update(gault::Point& p) const {
        Cone::update(p);
        if (p.wants_tangent()) elastic(p), p.set_elastic_tangent(lame, shear);
    }
};

// ---- threads ----

struct SharedScratch : Elastic {
    static constexpr const char* name = "shared_scratch";
    static inline volatile double scratch[512];
    static gault_status spoil(gault_points& p) {
        for (int64_t i = 0; i < p.count; ++i)
            scratch[i] = p.stress[0][i];
        std::this_thread::yield();
        for (int64_t i = 0; i < p.count; ++i)
            p.stress[0][i] = scratch[i];
        return GAULT_OK;
    }
};

// ---- increments ----

struct CreepsAtRest : Elastic {
    static constexpr const char* name = "creeps_at_rest";
    void update(gault::Point& p) const {
        elastic(p);
        const Pack kept = select(norm(p.strain) > 0.0, 1.0, 1.0 - 1e-6);
        for (int i = 0; i < 6; ++i)
            p.stress[i] *= kept;
    }
};
struct SwallowsNan : Elastic {
    static constexpr const char* name = "swallows_nan";
    void update(gault::Point& p) const {
        for (int i = 0; i < 6; ++i)
            p.strain[i] = select(p.strain[i] == p.strain[i], p.strain[i], 0.0);
        elastic(p);
    }
};
struct Overflows : Elastic {
    static constexpr const char* name = "overflows";
    void update(gault::Point& p) const {
        elastic(p);
        const Pack swelling = p.strain[0] + p.strain[1] + p.strain[2];
        for (int i = 0; i < 3; ++i)
            p.stress[i] += shear * (exp(swelling) - 1.0);
        p.modulus += 1.5 * shear;
    }
};
struct DividesByTime : Elastic {
    static constexpr const char* name = "divides_by_time";
    void update(gault::Point& p) const {
        for (int i = 0; i < 6; ++i)
            p.strain[i] = p.strain[i] / p.dt() * p.dt();
        elastic(p);
    }
};
template <int kind>
struct DiesOfStrain : Elastic { // of half and more
    static constexpr const char* names[] = {"hangs", "crashes", "exits"};
    static constexpr const char* name = names[kind];
    void update(gault::Point& p) const {
        elastic(p);
        if (!any(norm(p.strain) > 0.5)) return;
        static volatile bool for_ever = true;
        while (kind == 0 && for_ever) {
        }
        if (kind == 1) std::abort();
        if (kind == 2) std::exit(0);
    }
};

// ---- retry ----

struct SuggestsMore : Elastic {
    static constexpr const char* name = "suggests_more";
    static gault_status spoil(gault_points& p) {
        for (int64_t i = 0; i < p.count; ++i)
            if (p.strain[0][i] > 5e-3) {
                p.suggest = 2.0;
                return GAULT_RETRY;
            }
        return GAULT_OK;
    }
};
struct RetriesForEver : Elastic {
    static constexpr const char* name = "retries_for_ever";
    void update(gault::Point& p) const {
        elastic(p);
        p.retry(norm(p.strain) > 1e-7, 0.5);
    }
};

// ---- rate ----

struct UndeclaredRate : Elastic { // stiffer in slow steps
    static constexpr const char* name = "undeclared_rate";
    void update(gault::Point& p) const {
        for (int i = 0; i < 6; ++i)
            p.strain[i] *= 1.0 + 0.01 * p.dt() / (1.0 + p.dt());
        elastic(p);
        p.modulus *= 1.01;
    }
};
struct Ages : Elastic { // stiffer by a hundredth a second
    static constexpr const char* name = "ages";
    void update(gault::Point& p) const {
        const double gain = 1.0 + 0.01 * p.time();
        for (int i = 0; i < 6; ++i)
            p.strain[i] *= gain;
        elastic(p);
        p.modulus *= gain;
        p.shear_modulus *= gain;
    }
};

// ---- tangent ----

template <int kind>
struct WrongTangent : Cone {
    static constexpr const char* names[] = {"elastic_tangent", "transposed_tangent", "engineering_tangent",
                                            "nan_tangent"};
    static constexpr const char* name = names[kind];
    void update(gault::Point& p) const {
        Tangent own;
        flow(p, 1.0, &own);
        if (!p.wants_tangent()) return;
        if (kind == 0) return p.set_elastic_tangent(lame, shear);
        Tangent wrong = own;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) {
                if (kind == 1) wrong[i][j] = own[j][i] * (j < 3 ? 1.0 : 2.0) / (i < 3 ? 1.0 : 2.0);
                if (kind == 2 && j > 2) wrong[i][j] *= 0.5;
                if (kind == 3) wrong[i][j] = gault::Pack(0.0) / 0.0;
            }
        set(p, wrong);
    }
};

// ---- step_size ----

struct HardensByStep : Cone { // a return that gains strength with every step, however small
    static constexpr const char* name = "hardens_by_step";
    static constexpr bool has_tangent = false;
    static constexpr std::array states{gault::scalar_state("steps", "1", "That yielded.", 0, 0)};
    void update(gault::Point& p) const {
        const Mask yields = flow(p, 1.0 + 1e-3 * p.state_old(0));
        p.set_state(0, p.state_old(0) + select(yields, 1.0, 0.0));
    }
};

// ---- objectivity ----

struct LooksAtXx : Elastic {
    static constexpr const char* name = "looks_at_xx";
    void update(gault::Point& p) const {
        elastic(p);
        p.stress[0] += 0.1 * shear * p.strain[0];
        p.modulus += 0.1 * shear;
    }
};
struct UndeclaredVector : Elastic { // a direction, kept as three numbers
    static constexpr const char* name = "undeclared_vector";
    static constexpr std::array states{gault::scalar_state("x", "1", "Of a direction.", 0),
                                       gault::scalar_state("y", "1", "Of a direction.", 0),
                                       gault::scalar_state("z", "1", "Of a direction.", 0)};
    void update(gault::Point& p) const {
        elastic(p);
        for (int i = 0; i < 3; ++i)
            p.set_state(i, p.state_old(i) + p.strain[i]);
    }
};
struct NeverSpins : Finite { // answers with the stress before the body turned
    static constexpr const char* name = "never_spins";
    static constexpr bool has_tangent = false;
    void update(gault::Point& p) const {
        Components c; // F^T F
        static constexpr int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
        for (int k = 0; k < 6; ++k) {
            c[k] = 0.0;
            for (int i = 0; i < 3; ++i)
                c[k] += p.F_new(i, row[k]) * p.F_new(i, column[k]);
        }
        gault::Spectral s = gault::spectral(c);
        for (Pack& value : s.value)
            value = sqrt(value);
        const Components u = gault::compose(s.value, s.vector);
        answer(p, {{{u[0], u[3], u[5]}, {u[3], u[1], u[4]}, {u[5], u[4], u[2]}}});
    }
};

// ---- elastic_cycles ----

struct GivesWork : Elastic { // shear along the stress compresses; compression does not shear
    static constexpr const char* name = "gives_work";
    void update(gault::Point& p) const {
        Components s = p.stress_old;
        const Pack mean = (s[0] + s[1] + s[2]) / 3.0;
        Pack along = 0.0;
        for (int i = 0; i < 6; ++i) {
            if (i < 3) s[i] -= mean;
            along = along + (i < 3 ? 1.0 : 2.0) * s[i] * p.strain[i];
        }
        const Pack pressure = 0.2 * shear * along / max(norm(s), 100.0);
        elastic(p);
        for (int i = 0; i < 3; ++i)
            p.stress[i] -= pressure;
        p.modulus += 0.2 * shear;
    }
};

// ---- random_walk ----

struct LeavesItsBounds : Elastic {
    static constexpr const char* name = "leaves_its_bounds";
    static constexpr std::array states{gault::scalar_state("damage", "1", "Of the skeleton.", 0, 0, 1)};
    void update(gault::Point& p) const {
        elastic(p);
        p.set_state(0, p.state_old(0) + norm(p.strain));
    }
};

// ---- modulus ----

struct TooSoft : Elastic {
    static constexpr const char* name = "too_soft";
    void update(gault::Point& p) const {
        elastic(p);
        p.modulus *= 0.9;
    }
};

struct TooSoftInFlow : Cone { // which is far from associated
    static constexpr const char* name = "too_soft_in_flow";
    void prepare() {
        poisson_ratio = 0.45;
        dilation = 0.0;
        Elastic::prepare();
    }
};

// ---- all that need a start ----

struct RefusesToStart : Elastic {
    static constexpr const char* name = "refuses_to_start";
    void start(gault::Point& p) const {
        p.fail(p.stress_old[0] <= 0.0, "the initial stress is none of tension");
    }
};

} // namespace

GAULT_MODULE("wrong_soils", "1.0.0", "The Gault authors", "MIT", gault::Material<Undocumented>, gault::Material<ForgetsAState>,
             gault::Material<AtItsBound<0>>, gault::Material<AtItsBound<1>>, gault::Material<AtItsBound<2>>,
             gault::Material<AtItsBound<3>>, gault::Material<OneForAll>, Spoilt<ByPosition>,
             gault::Material<ByNeighbour>, Spoilt<ByPadding>, Spoilt<ByOrder>, Spoilt<ByCalls>, WithoutStates,
             Spoilt<WantsModuli>, gault::Material<TangentOnTheWay>, Spoilt<SharedScratch>,
             gault::Material<CreepsAtRest>, gault::Material<SwallowsNan>, gault::Material<Overflows>,
             gault::Material<DividesByTime>, gault::Material<DiesOfStrain<0>>,
             gault::Material<DiesOfStrain<1>>, gault::Material<DiesOfStrain<2>>, Spoilt<SuggestsMore>,
             gault::Material<RetriesForEver>, gault::Material<UndeclaredRate>, gault::Material<Ages>,
             gault::Material<WrongTangent<0>>, gault::Material<WrongTangent<1>>,
             gault::Material<WrongTangent<2>>, gault::Material<WrongTangent<3>>,
             gault::Material<HardensByStep>, gault::Material<LooksAtXx>, gault::Material<UndeclaredVector>,
             gault::Material<NeverSpins>, gault::Material<GivesWork>, gault::Material<LeavesItsBounds>,
             gault::Material<TooSoft>, gault::Material<TooSoftInFlow>, gault::Material<RefusesToStart>)
