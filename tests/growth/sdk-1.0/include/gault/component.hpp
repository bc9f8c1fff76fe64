// clang-format off
// What the wrappers of every kind share: parameters declared once, as constant data bound to members; creation
// and destruction; errors; the exported module.
//
//   struct Spring {
//       static constexpr const char* name = "spring";
//       static constexpr const char* version = "1.0.0";
//       static constexpr const char* doc = "An elastic support.";
//       static constexpr const char* reference = "Winkler (1867)"; // may be left out
//
//       double stiffness;
//       std::optional<double> limit; // may be absent from the scene
//
//       static constexpr std::array parameters{
//           gault::parameter<&Spring::stiffness>("stiffness", "k", "Pa/m", "Of the support.").above(0),
//           gault::parameter<&Spring::limit>("limit", "", "Pa", "Largest pressure.").above(0)};
//
//       void prepare(); // may be left out: checks what bounds cannot say, computes what follows; throws Invalid
//   };
//   GAULT_MODULE("spring", "1.0.0", "A. Author", "MIT", gault::Boundary<Spring>)
//
// A parameter is required unless it says fallback() or optional(). The member's type says what it is: double, int,
// bool, an enum with choices(), a std::optional of these (absent from the scene: empty), std::string,
// std::vector<double>, gault::Table, or gault::Records<Kind...>, each Kind being a struct with its own name, doc
// and parameters.
// clang-format on
#pragma once
#include <gault/gault.h>
#include <gault/pack.hpp>
#include <gault/table.hpp>

#include <array>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace gault {
inline namespace GAULT_ISA {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846; // angles are in rad: below(0.5 * gault::pi) is less than 90 deg

// Thrown by prepare(): the user is shown the text at the parameter's line of the scene.
struct Invalid : std::runtime_error {
    std::string parameter;
    Invalid(std::string parameter_name, const std::string& text)
        : std::runtime_error(text), parameter(std::move(parameter_name)) {}
};

template <class... Kinds>
using Records = std::vector<std::variant<Kinds...>>; // in the order of the scene

struct Parameter {
    gault_parameter declaration;
    void (*assign)(void* owner, const gault_value&);
    std::string_view member; // names it, for the compiler's eyes alone

    constexpr Parameter fallback(double value) const {
        Parameter p = *this;
        p.declaration.flags &= ~uint32_t{GAULT_REQUIRED};
        p.declaration.fallback = value;
        return p;
    }
    constexpr Parameter optional() const {
        Parameter p = *this;
        p.declaration.flags = (p.declaration.flags & ~uint32_t{GAULT_REQUIRED}) | GAULT_OPTIONAL;
        return p;
    }
    constexpr Parameter above(double bound) const { return at_least(bound).with(GAULT_MIN_OPEN); }
    constexpr Parameter below(double bound) const { return at_most(bound).with(GAULT_MAX_OPEN); }
    constexpr Parameter at_least(double bound) const {
        Parameter p = *this;
        p.declaration.min = bound < p.declaration.min ? p.declaration.min : bound;
        return p;
    }
    constexpr Parameter at_most(double bound) const {
        Parameter p = *this;
        p.declaration.max = bound > p.declaration.max ? p.declaration.max : bound;
        return p;
    }
    constexpr Parameter count(int64_t least,
                              int64_t most) const { // entries of a list, table or records; most 0: no limit
        Parameter p = *this;
        p.declaration.min_count = least;
        p.declaration.max_count = most;
        return p;
    }
    constexpr Parameter choices(const char* const* words) const { // NULL-terminated
        Parameter p = *this;
        p.declaration.type = GAULT_CHOICE;
        p.declaration.choices = words;
        return p;
    }
    constexpr Parameter with(uint32_t flag) const {
        Parameter p = *this;
        p.declaration.flags |= flag;
        return p;
    }
};

namespace detail {

template <class T>
struct member;
template <class Owner, class Value>
struct member<Value Owner::*> {
    using owner = Owner;
    using value = Value;
};

template <class T, class = void>
struct has_parameters : std::false_type {};
template <class T>
struct has_parameters<T, std::void_t<decltype(T::parameters)>> : std::true_type {};
template <class T, class = void>
struct has_prepare : std::false_type {};
template <class T>
struct has_prepare<T, std::void_t<decltype(std::declval<T&>().prepare())>> : std::true_type {};
template <class T, class = void>
struct has_reference : std::false_type {};
template <class T>
struct has_reference<T, std::void_t<decltype(T::reference)>> : std::true_type {};

// Arrays of constant data become the NULL-terminated lists of pointers that the contract wants.
template <class Array, class Get, std::size_t... I>
constexpr auto terminated(const Array& array, Get get, std::index_sequence<I...>) {
    return std::array<decltype(get(array[0])), sizeof...(I) + 1>{get(array[I])..., nullptr};
}
template <class Array, class Get>
constexpr auto terminated(const Array& array, Get get) {
    return terminated(array, get, std::make_index_sequence<std::tuple_size<Array>::value>());
}

constexpr const char* name_of(const char* name) {
    return name;
}
constexpr const gault_parameter* declaration_of(const Parameter& p) {
    return &p.declaration;
}

template <class T, bool = has_parameters<T>::value>
struct ParameterList {
    static constexpr std::array<const gault_parameter*, 1> pointers{nullptr};
    static void assign(T&, const gault_value*) {}
    static int32_t index(const std::string&) { return -1; }
};
template <class Array>
constexpr bool have_members_of_their_own(const Array& parameters) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (parameters[i].member == parameters[j].member) return false;
    return true;
}
template <class T>
struct ParameterList<T, true> {
    static_assert(have_members_of_their_own(T::parameters), "two parameters are read into the same member");
    static constexpr auto pointers = terminated(T::parameters, declaration_of);
    static void assign(T& owner, const gault_value* values) {
        for (std::size_t i = 0; i < T::parameters.size(); ++i)
            if (values[i].count > 0) T::parameters[i].assign(&owner, values[i]);
    }
    static int32_t index(const std::string& name) {
        for (std::size_t i = 0; i < T::parameters.size(); ++i)
            if (name == T::parameters[i].declaration.name) return static_cast<int32_t>(i);
        return -1;
    }
};

template <class Kind>
struct RecordKind {
    static constexpr gault_record_kind declaration{sizeof(gault_record_kind), 0, Kind::name, Kind::doc,
                                                   ParameterList<Kind>::pointers.data()};
};
template <class... Kinds>
struct RecordKinds {
    static constexpr const gault_record_kind* list[] = {&RecordKind<Kinds>::declaration..., nullptr};
};
template <class Record, class Kind>
Record read_record(const gault_item& item) {
    Kind kind{};
    ParameterList<Kind>::assign(kind, item.values);
    return kind;
}

template <class V>
struct is_optional : std::false_type {};
template <class V>
struct is_optional<std::optional<V>> : std::true_type {};

template <class V, class = void>
struct Binding; // type of a parameter, and how its value is read
template <>
struct Binding<double> {
    static constexpr gault_type type = GAULT_REAL;
    static void read(const gault_value& v, double& out) { out = v.real; }
};
template <>
struct Binding<bool> {
    static constexpr gault_type type = GAULT_BOOLEAN;
    static void read(const gault_value& v, bool& out) { out = v.integer != 0; }
};
template <class V>
struct Binding<V, std::enable_if_t<std::is_enum_v<V> || std::is_integral_v<V>>> {
    static constexpr gault_type type = std::is_enum_v<V> ? GAULT_CHOICE : GAULT_INTEGER;
    static void read(const gault_value& v, V& out) { out = static_cast<V>(v.integer); }
};
template <class V>
struct Binding<std::optional<V>> {
    static constexpr gault_type type = Binding<V>::type;
    static void read(const gault_value& v, std::optional<V>& out) { Binding<V>::read(v, out.emplace()); }
};
template <>
struct Binding<std::string> {
    static constexpr gault_type type = GAULT_TEXT_VALUE;
    static void read(const gault_value& v, std::string& out) { out = v.text; }
};
template <>
struct Binding<std::vector<double>> {
    static constexpr gault_type type = GAULT_LIST;
    static void read(const gault_value& v, std::vector<double>& out) { out.assign(v.y, v.y + v.count); }
};
template <>
struct Binding<Table> {
    static constexpr gault_type type = GAULT_TABLE;
    static void read(const gault_value& v, Table& out) {
        out.x.assign(v.x, v.x + v.count);
        out.y.assign(v.y, v.y + v.count);
    }
};
template <class... Kinds>
struct Binding<Records<Kinds...>> {
    static constexpr gault_type type = GAULT_RECORDS;
    static constexpr const gault_record_kind* const* kinds = RecordKinds<Kinds...>::list;
    static void read(const gault_value& v, Records<Kinds...>& out) {
        using Record = std::variant<Kinds...>;
        constexpr Record (*make[])(const gault_item&) = {&read_record<Record, Kinds>...};
        for (int64_t i = 0; i < v.count; ++i)
            out.push_back(make[v.items[i].kind](v.items[i]));
    }
};

template <auto Member>
void assign(void* owner, const gault_value& value) {
    using M = member<decltype(Member)>;
    Binding<typename M::value>::read(value, static_cast<typename M::owner*>(owner)->*Member);
}

template <class V>
struct without_optional {
    using type = V;
};
template <class V>
struct without_optional<std::optional<V>> {
    using type = V;
};

// What a member of the type V can hold of the integers that a scene can write.
template <class V>
constexpr void limit(gault_parameter& p) {
    using Limits = std::numeric_limits<V>;
    if constexpr (sizeof(V) < sizeof(int64_t)) p.max = static_cast<double>(Limits::max());
    if constexpr (sizeof(V) < sizeof(int64_t) || std::is_unsigned<V>::value)
        p.min = static_cast<double>(Limits::min());
}

// Not its address: with -fsanitize=undefined gcc does not compare addresses when it compiles.
template <auto Member>
constexpr std::string_view spelled() {
    return __PRETTY_FUNCTION__;
}

template <auto Member>
constexpr Parameter declare(const char* name, const char* symbol, const char* x_unit, const char* unit,
                            const char* doc) {
    using Value = typename member<decltype(Member)>::value;
    gault_parameter p{};
    p.size = sizeof p;
    p.type = Binding<Value>::type;
    p.flags = is_optional<Value>::value ? GAULT_OPTIONAL : GAULT_REQUIRED;
    p.name = name;
    p.symbol = symbol;
    p.unit = unit;
    p.x_unit = x_unit;
    p.doc = doc;
    p.min = -infinity;
    p.max = infinity;
    if constexpr (Binding<Value>::type == GAULT_INTEGER) limit<typename without_optional<Value>::type>(p);
    if constexpr (Binding<Value>::type == GAULT_RECORDS) p.kinds = Binding<Value>::kinds;
    return {p, &assign<Member>, spelled<Member>()};
}

inline void report(gault_error* error, int32_t parameter, int64_t point, const char* text) {
    error->parameter = parameter;
    error->point = point;
    std::snprintf(error->text, sizeof error->text, "%s", text);
}

// Runs `body`; whatever it throws becomes a status and a text.
template <class Body>
gault_status guarded(gault_error* error, Body body) noexcept {
    try {
        return body();
    } catch (const std::exception& e) {
        report(error, -1, -1, e.what());
    } catch (...) {
        report(error, -1, -1, "unknown exception");
    }
    return GAULT_FAILED;
}

template <class T>
gault_status create(const gault_host*, const gault_value* values, void** self, gault_error* error) noexcept {
    return guarded(error, [&]() -> gault_status {
        try {
            auto made = std::make_unique<T>();
            ParameterList<T>::assign(*made, values);
            if constexpr (has_prepare<T>::value) made->prepare();
            *self = made.release();
            return GAULT_OK;
        } catch (const Invalid& e) {
            report(error, ParameterList<T>::index(e.parameter), -1, e.what());
            return GAULT_INVALID;
        }
    });
}
template <class T>
void destroy(void* self) noexcept {
    delete static_cast<T*>(self);
}

template <class T>
constexpr gault_component component(gault_kind kind, const void* api) {
    gault_component c{};
    c.size = sizeof c;
    c.kind = kind;
    c.name = T::name;
    c.version = T::version;
    c.doc = T::doc;
    c.reference = "";
    if constexpr (has_reference<T>::value) c.reference = T::reference;
    c.parameters = ParameterList<T>::pointers.data();
    c.api = api;
    c.create = &create<T>;
    c.destroy = &destroy<T>;
    return c;
}

template <class... Wrapped>
struct ComponentList {
    static constexpr const gault_component* list[] = {&Wrapped::declaration..., nullptr};
};

template <class... Wrapped>
constexpr gault_module module(const char* name, const char* version, const char* author,
                              const char* license) {
    gault_module m{};
    m.magic = GAULT_MAGIC;
    m.abi_major = GAULT_ABI_MAJOR;
    m.abi_minor = GAULT_ABI_MINOR;
    m.size = sizeof m;
    m.needs_minor = 0;
    m.pointer_bytes = sizeof(void*);
    m.real_bytes = sizeof(double);
    m.name = name;
    m.version = version;
    m.author = author;
    m.license = license;
#if defined(__clang__)
    m.built_with = __VERSION__;
#else
    m.built_with = "gcc " __VERSION__;
#endif
    m.components = ComponentList<Wrapped...>::list;
    return m;
}

} // namespace detail

template <auto Member>
constexpr Parameter parameter(const char* name, const char* symbol, const char* unit, const char* doc) {
    return detail::declare<Member>(name, symbol, nullptr, unit, doc);
}
template <auto Member>
constexpr Parameter table(const char* name, const char* x_unit, const char* unit, const char* doc) {
    return detail::declare<Member>(name, "", x_unit, unit, doc);
}

// A named scalar that is measured, commanded, remembered or recorded.
constexpr gault_signal signal(const char* name, const char* unit, const char* doc, double initial = 0.0) {
    return {name, unit, doc, initial, 0, 0};
}

} // namespace GAULT_ISA
} // namespace gault

// The one exported symbol: constant data, readable before anything of the module has run.
#define GAULT_MODULE(name, version, author, license, ...)                                                    \
    constexpr gault_module GAULT_ENTRY = ::gault::detail::module<__VA_ARGS__>(name, version, author, license);
