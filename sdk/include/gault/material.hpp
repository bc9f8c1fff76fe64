// clang-format off
// A soil as one C++ struct: parameters and states declared once, and the update of one pack of material points.
// The wrapper walks the batch, loads, calls, stores; nothing is allocated, no call is virtual, no exception
// leaves. Called by [worker] threads, concurrently on the same const object.
//
//   struct Soil { // name, version, doc, parameters, prepare(): see component.hpp
//       void update(gault::Point& p) const; // required; the rest may be left out
//
//       static constexpr std::array states{
//           gault::scalar_state("plastic_strain", "1", "Accumulated.", 0.0, 0.0)}; // initial, least, largest
//       static constexpr int plastic_strain = gault::state_index(states, "plastic_strain");
//       static constexpr std::array inputs{"density"}; // host fields wanted, see gault.h
//       static constexpr bool has_tangent = true;      // update() sets the tangent when p.wants_tangent()
//       static constexpr bool finite_strain = true;    // wants p.F_old(), p.F_new()
//       static constexpr bool one_at_a_time = true;    // never called concurrently
//       static constexpr bool rate_dependent = true;   // answers differently at another rate: creeps
//
//       void start(gault::Point& p) const; // before the first step: p.stress is the initial stress
//       const std::vector<gault_state>& instance_states() const; // replaces `states`: they depend on parameters
//   };
//   GAULT_MODULE("soil", "1.0.0", "A. Author", "MIT", gault::Material<Soil>)
// clang-format on
#pragma once
#include <gault/component.hpp>

namespace gault {
inline namespace GAULT_ISA {

using Components = std::array<Pack, 6>; // xx yy zz xy yz zx, tensor shear, tension positive

constexpr gault_state state(gault_shape shape, const char* name, const char* unit, const char* doc,
                            double initial, double min, double max) {
    return {name, unit, doc, shape, 0, initial, min, max};
}
constexpr gault_state scalar_state(const char* name, const char* unit, const char* doc, double initial = 0.0,
                                   double min = -infinity, double max = infinity) {
    return state(GAULT_SCALAR, name, unit, doc, initial, min, max);
}
constexpr gault_state vector_state(const char* name, const char* unit, const char* doc, double initial = 0.0,
                                   double min = -infinity, double max = infinity) {
    return state(GAULT_VECTOR, name, unit, doc, initial, min, max);
}
constexpr gault_state symmetric_state(const char* name, const char* unit, const char* doc,
                                      double initial = 0.0, double min = -infinity, double max = infinity) {
    return state(GAULT_SYMMETRIC, name, unit, doc, initial, min, max);
}

// Index of a state's first component, for p.state_old(), p.set_state(). An unknown name does not compile.
template <std::size_t N>
constexpr int state_index(const std::array<gault_state, N>& states, const char* name) {
    int component = 0;
    for (const gault_state& s : states) {
        const char *a = s.name, *b = name;
        while (*a && *a == *b)
            ++a, ++b;
        if (*a == *b) return component;
        component += static_cast<int>(s.shape);
    }
    throw "no state of this name";
}

// One pack of material points. Increments, signs and units as in gault_points.
class Point {
  public:
    Components strain;     // increment of the step (start: 0)
    Components stress_old; // Pa
    Components stress;     // out; on entry stress_old
    Pack modulus;          // out: an upper bound of the P-wave modulus, in soil that yields too, Pa; required
    Pack shear_modulus;    // out: elastic G, Pa; required

    double time() const { return batch_->time; } // s, at the end of the step
    double dt() const { return batch_->dt; }

    // States, by index of component: a scalar counts 1, a vector 3, a tensor 6 (gault::state_index finds it by
    // name). One that is never set keeps its value. An index beyond the states fails the update.
    GAULT_INLINE Pack state_old(int component) const {
        if (!has_states(component, 1)) return std::numeric_limits<double>::quiet_NaN();
        return Pack::load(batch_->state_old[component] + first_);
    }
    GAULT_INLINE void set_state(int component, Pack value) {
        if (has_states(component, 1)) value.store(batch_->state[component] + first_);
    }
    GAULT_INLINE Components symmetric_state_old(int component) const {
        return has_states(component, 6) ? load6(batch_->state_old + component, first_) : Components{};
    }
    GAULT_INLINE void set_symmetric_state(int component, const Components& value) {
        if (has_states(component, 6)) store6(value, batch_->state + component, first_);
    }

    GAULT_INLINE Pack input(int index) const { return Pack::load(batch_->input[index] + first_); }
    GAULT_INLINE Pack F_old(int i, int j) const { return Pack::load(batch_->F_old[3 * i + j] + first_); }
    GAULT_INLINE Pack F_new(int i, int j) const { return Pack::load(batch_->F_new[3 * i + j] + first_); }

    // d stress[row] / d strain[column], where a unit of column xy means strain xy and yx together: in a shear column
    // C_..xy + C_..yx, so isotropic elasticity has 2G on the whole diagonal but for lame, and a product n (x) n of
    // directions 2 n_row n_column there. All 36 are due. With finite_strain: see gault_points.
    GAULT_INLINE bool wants_tangent() const { return batch_->tangent[0] != nullptr; }
    GAULT_INLINE void set_tangent(int row, int column, Pack value) {
        value.store(batch_->tangent[6 * row + column] + first_);
    }
    // Isotropic elasticity; the shear columns hold 2G.
    GAULT_INLINE void set_elastic_tangent(Pack lame, Pack shear) {
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) {
                const Pack direct = i < 3 && j < 3 ? lame : Pack(0.0);
                set_tangent(i, j, i == j ? direct + 2.0 * shear : direct);
            }
    }

    // The points of `where` have no result. The host reports the first of them, with this text.
    GAULT_INLINE void fail(Mask where, const char* text) {
        if (any(where)) note_failure(where, text);
    }
    // The increment was too large for the points of `where`: try this fraction of the step, above 0 and below 1.
    GAULT_INLINE void retry(Mask where, double fraction) {
        if (any(where)) note_retry(where, fraction);
    }

    struct Outcome { // of a whole batch
        const char* text = nullptr;
        int64_t point = -1;
        double fraction = 1.0;
    };
    GAULT_INLINE Point(const gault_points* batch, int64_t first, Outcome* outcome, int state_components)
        : batch_(batch), first_(first), outcome_(outcome), state_components_(state_components) {
        strain = load6(batch->strain, first);
        stress = stress_old = load6(batch->stress_old, first);
        modulus = shear_modulus = Pack(std::numeric_limits<double>::quiet_NaN());
    }
    GAULT_INLINE void store() const {
        store6(stress, batch_->stress, first_);
        if (batch_->modulus) modulus.store(batch_->modulus + first_);
        if (batch_->shear_modulus) shear_modulus.store(batch_->shear_modulus + first_);
    }

  private:
    GAULT_INLINE bool has_states(int component, int count) const {
        if (component >= 0 && component + count <= state_components_) return true;
        outcome_->text = "the model reads or writes a state beyond those that it declares: indices count "
                         "components, 6 for a tensor; see gault::state_index";
        outcome_->point = first_;
        return false;
    }
    static GAULT_INLINE Components load6(const double* const* arrays, int64_t first) {
        Components c;
        for (int i = 0; i < 6; ++i)
            c[i] = Pack::load(arrays[i] + first);
        return c;
    }
    static GAULT_INLINE void store6(const Components& c, double* const* arrays, int64_t first) {
        for (int i = 0; i < 6; ++i)
            c[i].store(arrays[i] + first);
    }
    // Lanes beyond `count` are not the host's points.
    void note_failure(Mask where, const char* text) {
        for (int i = 0; i < pack_lanes && !outcome_->text; ++i)
            if (lane(where, i) && first_ + i < batch_->count) {
                outcome_->text = text;
                outcome_->point = first_ + i;
            }
    }
    void note_retry(Mask where, double fraction) {
        if (!(fraction > 0.0 && fraction < 1.0)) fraction = 0.5;
        for (int i = 0; i < pack_lanes; ++i)
            if (lane(where, i) && first_ + i < batch_->count && fraction < outcome_->fraction)
                outcome_->fraction = fraction;
    }

    const gault_points* batch_;
    int64_t first_;
    Outcome* outcome_;
    int state_components_;
};

namespace detail {

template <class T, class = void>
struct has_states : std::false_type {};
template <class T>
struct has_states<T, std::void_t<decltype(T::states)>> : std::true_type {};
template <class T, class = void>
struct has_inputs : std::false_type {};
template <class T>
struct has_inputs<T, std::void_t<decltype(T::inputs)>> : std::true_type {};
template <class T, class = void>
struct has_start : std::false_type {};
template <class T>
struct has_start<T, std::void_t<decltype(std::declval<const T&>().start(std::declval<Point&>()))>>
    : std::true_type {};
template <class T, class = void>
struct has_instance_states : std::false_type {};
template <class T>
struct has_instance_states<T, std::void_t<decltype(std::declval<const T&>().instance_states())>>
    : std::true_type {};
template <class T, class = void>
struct tangent_flag : std::integral_constant<uint32_t, 0> {};
template <class T>
struct tangent_flag<T, std::enable_if_t<T::has_tangent>>
    : std::integral_constant<uint32_t, GAULT_HAS_TANGENT> {};
template <class T, class = void>
struct finite_flag : std::integral_constant<uint32_t, 0> {};
template <class T>
struct finite_flag<T, std::enable_if_t<T::finite_strain>>
    : std::integral_constant<uint32_t, GAULT_FINITE_STRAIN> {};
template <class T, class = void>
struct single_flag : std::integral_constant<uint32_t, 0> {};
template <class T>
struct single_flag<T, std::enable_if_t<T::one_at_a_time>>
    : std::integral_constant<uint32_t, GAULT_ONE_AT_A_TIME> {};

template <class T, class = void>
struct rate_flag : std::integral_constant<uint32_t, 0> {};
template <class T>
struct rate_flag<T, std::enable_if_t<T::rate_dependent>>
    : std::integral_constant<uint32_t, GAULT_RATE_DEPENDENT> {};

template <class T>
int state_components(const T& model) {
    int n = 0;
    if constexpr (has_instance_states<T>::value)
        for (const gault_state& s : model.instance_states())
            n += static_cast<int>(s.shape);
    else if constexpr (has_states<T>::value)
        for (const gault_state& s : T::states)
            n += static_cast<int>(s.shape);
    return n;
}

inline gault_status conclude(const Point::Outcome& outcome, gault_points* batch, gault_error* error) {
    if (outcome.text) {
        report(error, -1, outcome.point, outcome.text);
        return GAULT_FAILED;
    }
    if (outcome.fraction < 1.0) {
        batch->suggest = outcome.fraction;
        return GAULT_RETRY;
    }
    return GAULT_OK;
}

// A small model is copied, so that the compiler knows that no store changes its parameters.
template <class T>
using Local = std::conditional_t<std::is_trivially_copyable_v<T>, const T, const T&>;

template <class T>
gault_status update(const void* self, gault_points* batch, gault_error* error) noexcept {
    return guarded(error, [&] {
        Local<T> model = *static_cast<const T*>(self);
        Point::Outcome outcome;
        const auto bytes = sizeof(double) * static_cast<std::size_t>(batch->padded);
        const int components = state_components(model);
        for (int i = 0; i < components; ++i)
            std::memcpy(batch->state[i], batch->state_old[i], bytes);
        for (int64_t first = 0; first < batch->padded; first += pack_lanes) {
            Point p(batch, first, &outcome, components);
            model.update(p);
            p.store();
        }
        return conclude(outcome, batch, error);
    });
}

template <class T>
gault_status start(const void* self, gault_points* batch, gault_error* error) noexcept {
    return guarded(error, [&] {
        const T& model = *static_cast<const T*>(self);
        const int components = state_components(model);
        Point::Outcome outcome;
        for (int64_t first = 0; first < batch->padded; first += pack_lanes) {
            Point p(batch, first, &outcome, components);
            model.start(p);
        }
        return conclude(outcome, batch, error);
    });
}

template <class T>
const gault_state* instance_states(const void* self, uint32_t* count) noexcept {
    const auto& states = static_cast<const T*>(self)->instance_states();
    *count = static_cast<uint32_t>(states.size());
    return states.data();
}

template <class T>
struct InputList {
    static constexpr auto names = terminated(T::inputs, name_of);
};

template <class T>
constexpr gault_material_api material_api() {
    gault_material_api a{};
    a.size = sizeof a;
    a.flags = tangent_flag<T>::value | finite_flag<T>::value | single_flag<T>::value | rate_flag<T>::value;
    if constexpr (has_states<T>::value) {
        a.states = T::states.data();
        a.state_count = static_cast<uint32_t>(T::states.size());
    }
    if constexpr (has_inputs<T>::value) a.inputs = InputList<T>::names.data();
    a.update = &update<T>;
    if constexpr (has_start<T>::value) a.start = &start<T>;
    if constexpr (has_instance_states<T>::value) a.instance_states = &instance_states<T>;
    return a;
}

} // namespace detail

template <class T>
struct Material {
    static constexpr gault_material_api api = detail::material_api<T>();
    static constexpr gault_component declaration = detail::component<T>(GAULT_MATERIAL, &api);
};

} // namespace GAULT_ISA
} // namespace gault
