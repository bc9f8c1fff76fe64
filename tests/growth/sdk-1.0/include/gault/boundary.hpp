// clang-format off
// A boundary condition as one C++ struct. It says what it wants, node by node or facet by facet; the host imposes
// it, under every solver. Normals point out of the soil. Asked on the [main] thread, any number of times a step, also at
// trial states: the answer depends on the node or facet alone.
//
//   struct Support { // name, version, doc, parameters, prepare(): see component.hpp
//       static constexpr std::array controls{gault::signal("pressure", "Pa", "Commanded by a program.", 0.0)};
//
//       static constexpr uint32_t flags = gault::uniform; // may be left out; see gault.h
//
//       void constrain(gault::Node& node) const; // prescribes velocities at a grid node
//       void load(gault::Facet& facet) const;    // pushes or pulls at a quadrature point; one of the two is enough
//   };
//   GAULT_MODULE("support", "1.0.0", "A. Author", "MIT", gault::Boundary<Support>)
// clang-format on
#pragma once
#include <gault/component.hpp>

namespace gault {
inline namespace GAULT_ISA {

constexpr uint32_t uniform = GAULT_BOUNDARY_UNIFORM, holds_normal = GAULT_BOUNDARY_HOLDS_NORMAL,
                   elastic_behind = GAULT_BOUNDARY_ELASTIC_BEHIND;

class Node {
  public:
    Node(const gault_nodes* nodes, int64_t index) : nodes_(nodes), i_(index) {}

    double time() const { return nodes_->time; } // s, at the end of the step
    double dt() const { return nodes_->dt; }
    double control(int index) const { return nodes_->control[index]; }
    double position(int axis) const { return nodes_->position[axis][i_]; }         // m
    double normal(int axis) const { return nodes_->normal[axis][i_]; }             // unit vector
    double displacement(int axis) const { return nodes_->displacement[axis][i_]; } // m

    void prescribe(int axis, double velocity) { // m/s, constant over the step
        nodes_->fixed[axis][i_] = 1.0;
        nodes_->velocity[axis][i_] = velocity;
    }

  private:
    const gault_nodes* nodes_;
    int64_t i_;
};

class Facet {
  public:
    Facet(const gault_facets* facets, int64_t index) : facets_(facets), i_(index) {}

    double time() const { return facets_->time; } // s, at the end of the step
    double dt() const { return facets_->dt; }
    double control(int index) const { return facets_->control[index]; }
    double position(int axis) const { return facets_->position[axis][i_]; }         // m
    double normal(int axis) const { return facets_->normal[axis][i_]; }             // unit vector
    double displacement(int axis) const { return facets_->displacement[axis][i_]; } // m
    double velocity(int axis) const { return facets_->velocity[axis][i_]; }         // m/s; see gault.h
    // Of the soil behind, at the start of the run.
    double p_impedance() const { return facets_->impedance[0][i_]; }                        // Pa s/m
    double s_impedance() const { return facets_->impedance[1][i_]; }                        // Pa s/m
    double shear_modulus() const { return facets_->shear_modulus[i_]; }                     // Pa
    double initial_traction(int axis) const { return facets_->initial_traction[axis][i_]; } // Pa

    void set_pressure(double pressure) { facets_->pressure[i_] = pressure; } // Pa, along -normal, follows it
    void set_traction(int axis, double traction) {                           // Pa, current area
        facets_->traction[axis][i_] = traction;
    }
    bool wants_slope() const { return facets_->slope[0] != nullptr; }
    // -d traction[i] / d displacement[j] at fixed time, Pa/m, 0 unless it is set. A load that depends on the
    // velocity counts, too: a displacement moves the velocity by 1 / dt.
    void set_slope(int i, int j, double slope) { facets_->slope[3 * i + j][i_] = slope; }

  private:
    const gault_facets* facets_;
    int64_t i_;
};

namespace detail {

template <class T, class = void>
struct has_constrain : std::false_type {};
template <class T>
struct has_constrain<T, std::void_t<decltype(std::declval<const T&>().constrain(std::declval<Node&>()))>>
    : std::true_type {};
template <class T, class = void>
struct has_load : std::false_type {};
template <class T>
struct has_load<T, std::void_t<decltype(std::declval<const T&>().load(std::declval<Facet&>()))>>
    : std::true_type {};
template <class T, class = void>
struct has_controls : std::false_type {};
template <class T>
struct has_controls<T, std::void_t<decltype(T::controls)>> : std::true_type {};

template <class T, class = void>
struct has_flags : std::false_type {};
template <class T>
struct has_flags<T, std::void_t<decltype(T::flags)>> : std::true_type {};

template <class T>
gault_status constrain(const void* self, gault_nodes* nodes, gault_error* error) noexcept {
    return guarded(error, [&]() -> gault_status {
        for (int64_t i = 0; i < nodes->count; ++i) {
            Node node(nodes, i);
            static_cast<const T*>(self)->constrain(node);
        }
        return GAULT_OK;
    });
}

template <class T>
gault_status load(const void* self, gault_facets* facets, gault_error* error) noexcept {
    return guarded(error, [&]() -> gault_status {
        for (int64_t i = 0; i < facets->count; ++i) {
            Facet facet(facets, i);
            static_cast<const T*>(self)->load(facet);
        }
        return GAULT_OK;
    });
}

template <class T>
constexpr gault_boundary_api boundary_api() {
    static_assert(has_constrain<T>::value || has_load<T>::value,
                  "a boundary has constrain() const or load() const");
    gault_boundary_api a{};
    a.size = sizeof a;
    if constexpr (has_flags<T>::value) a.flags = T::flags;
    if constexpr (has_controls<T>::value) {
        a.controls = T::controls.data();
        a.control_count = static_cast<uint32_t>(T::controls.size());
    }
    if constexpr (has_constrain<T>::value) a.constrain = &constrain<T>;
    if constexpr (has_load<T>::value) a.load = &load<T>;
    return a;
}

} // namespace detail

template <class T>
struct Boundary {
    static constexpr gault_boundary_api api = detail::boundary_api<T>();
    static constexpr gault_component declaration = detail::component<T>(GAULT_BOUNDARY, &api);
};

} // namespace GAULT_ISA
} // namespace gault
