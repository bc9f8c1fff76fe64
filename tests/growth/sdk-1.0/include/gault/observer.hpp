// clang-format off
// An observer as one C++ struct: looks at all points when a result is due and answers with scalars for the summary.
// Called on the [main] thread.
//
//   struct Check { // name, version, doc, parameters, prepare(): see component.hpp
//       static constexpr std::array measures{gault::signal("radius", "m", "Of the cavity.")}; // names: see gault.h
//       static constexpr std::array fields{"plastic_strain"}; // scalar states of the scene's materials
//       static constexpr std::array results{gault::signal("error", "1", "Relative.")};
//
//       void evaluate(gault::Sample& sample) const; // measures, fields and results by index, in these orders
//   };
//   GAULT_MODULE("check", "1.0.0", "A. Author", "MIT", gault::Observer<Check>)
// clang-format on
#pragma once
#include <gault/component.hpp>

namespace gault {
inline namespace GAULT_ISA {

class Sample {
  public:
    explicit Sample(gault_sample* sample) : sample_(sample) {}

    int64_t count() const { return sample_->count; }
    double time() const { return sample_->time; }                                                         // s
    double position(int axis, int64_t i) const { return sample_->position[axis][i]; }                     // m
    double reference_position(int axis, int64_t i) const { return sample_->reference_position[axis][i]; } // m
    double stress(int component, int64_t i) const { // Pa, tension positive
        return sample_->stress[component][i];
    }
    double volume(int64_t i) const { return sample_->volume[i]; } // m^3, current
    bool has_field(int index) const { return sample_->field[index] != nullptr; } // some material has it
    double field(int index, int64_t i) const {
        return sample_->field[index][i];
    } // NaN where the point's material lacks it
    int material(int64_t i) const { return sample_->material[i]; }
    const char* material_name(int index) const { return sample_->material_name[index]; } // as in the scene
    double cell_size(int axis) const { return sample_->cell_size[axis]; } // m, of the largest cell
    double measure(int index) const { return sample_->measure[index]; }
    double& result(int index) { return sample_->result[index]; } // NaN, not applicable, until it is set

  private:
    gault_sample* sample_;
};

namespace detail {

template <class T, class = void>
struct has_measures : std::false_type {};
template <class T>
struct has_measures<T, std::void_t<decltype(T::measures)>> : std::true_type {};
template <class T, class = void>
struct has_fields : std::false_type {};
template <class T>
struct has_fields<T, std::void_t<decltype(T::fields)>> : std::true_type {};

template <class T>
struct FieldList {
    static constexpr auto names = terminated(T::fields, name_of);
};

template <class T>
gault_status evaluate(const void* self, gault_sample* raw, gault_error* error) noexcept {
    return guarded(error, [&]() -> gault_status {
        for (std::size_t i = 0; i < T::results.size(); ++i)
            raw->result[i] = std::numeric_limits<double>::quiet_NaN();
        Sample sample(raw);
        static_cast<const T*>(self)->evaluate(sample);
        return GAULT_OK;
    });
}

template <class T>
constexpr gault_observer_api observer_api() {
    gault_observer_api a{};
    a.size = sizeof a;
    a.results = T::results.data();
    a.result_count = static_cast<uint32_t>(T::results.size());
    if constexpr (has_measures<T>::value) {
        a.measures = T::measures.data();
        a.measure_count = static_cast<uint32_t>(T::measures.size());
    }
    if constexpr (has_fields<T>::value) a.fields = FieldList<T>::names.data();
    a.evaluate = &evaluate<T>;
    return a;
}

} // namespace detail

template <class T>
struct Observer {
    static constexpr gault_observer_api api = detail::observer_api<T>();
    static constexpr gault_component declaration = detail::component<T>(GAULT_OBSERVER, &api);
};

} // namespace GAULT_ISA
} // namespace gault
