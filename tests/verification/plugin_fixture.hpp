// A plugin opened as the host opens it, for tests: components created from parameters by name, batches of
// points run through the contract. Everything here throws std::runtime_error with a text when it cannot.
#pragma once
#include <gault/gault.h>

#include <dlfcn.h>

#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace plugin_test {

constexpr double degree = M_PI / 180.0;

struct Setting;
using Settings = std::map<std::string, Setting>;
using Points = std::vector<std::array<double, 2>>; // of a table
struct Record {
    std::string kind;
    Settings settings;
};
struct Setting : std::variant<double, std::string, Points, std::vector<Record>> {
    using variant::variant;
    Setting(const char* text) : variant(std::string(text)) {}
    Setting(int number) : variant(static_cast<double>(number)) {}
    Setting(bool flag) : variant(flag ? 1.0 : 0.0) {}
};

// The values of parameters in declared order, as the host would pass them, and what they point into.
class Values {
  public:
    Values(const gault_parameter* const* declared, const Settings& settings) {
        for (const auto& [name, setting] : settings)
            if (!is_declared(declared, name)) throw std::runtime_error("no parameter " + name);
        for (; *declared; ++declared) {
            const auto found = settings.find((*declared)->name);
            values_.push_back(found == settings.end() ? absent(**declared)
                                                      : given(**declared, found->second));
        }
    }
    const gault_value* data() const { return values_.data(); }

  private:
    static bool is_declared(const gault_parameter* const* declared, const std::string& name) {
        for (; *declared; ++declared)
            if (name == (*declared)->name) return true;
        return false;
    }
    static gault_value number(double value) {
        return {value, static_cast<int64_t>(value), "", nullptr, nullptr, nullptr, 1};
    }
    static gault_value absent(const gault_parameter& p) {
        if (p.flags & GAULT_REQUIRED) throw std::runtime_error(std::string(p.name) + " is required");
        if (!(p.flags & GAULT_OPTIONAL)) return number(p.fallback);
        return {0.0, 0, "", nullptr, nullptr, nullptr, 0};
    }
    gault_value given(const gault_parameter& p, const Setting& setting) {
        if (const double* real = std::get_if<double>(&setting)) return number(*real);
        gault_value v = number(0.0);
        if (const auto* text = std::get_if<std::string>(&setting)) {
            v.text = texts_.emplace_back(*text).c_str();
        } else if (const auto* points = std::get_if<Points>(&setting)) {
            auto &x = numbers_.emplace_back(), &y = numbers_.emplace_back();
            for (const auto& point : *points)
                x.push_back(point[0]), y.push_back(point[1]);
            v.x = x.data(), v.y = y.data(), v.count = static_cast<int64_t>(x.size());
        } else {
            const auto& records = std::get<std::vector<Record>>(setting);
            auto& items = items_.emplace_back();
            for (const Record& record : records)
                items.push_back(item(p, record));
            v.items = items.data(), v.count = static_cast<int64_t>(items.size());
        }
        return v;
    }
    gault_item item(const gault_parameter& p, const Record& record) {
        for (int64_t kind = 0; p.kinds[kind]; ++kind)
            if (record.kind == p.kinds[kind]->name)
                return {kind, nested_.emplace_back(p.kinds[kind]->parameters, record.settings).data()};
        throw std::runtime_error("no kind " + record.kind);
    }

    std::vector<gault_value> values_;
    std::deque<std::string> texts_;
    std::deque<std::vector<double>> numbers_;
    std::deque<std::vector<gault_item>> items_;
    std::deque<Values> nested_;
};

// "" is the variant for any processor; the others exist where this processor can run them.
inline std::vector<std::string> variants() {
    std::vector<std::string> all{""};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        all.push_back("glibc-hwcaps/x86-64-v3/");
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        all.push_back("glibc-hwcaps/x86-64-v4/");
#endif
    return all;
}

struct Invalid : std::runtime_error { // what create() answered
    std::string parameter;
    Invalid(std::string name, const char* text) : std::runtime_error(text), parameter(std::move(name)) {}
};

class Component { // and one instance of it
  public:
    Component(const std::string& plugin, gault_kind kind, const std::string& name, const Settings& settings,
              const std::string& variant = "")
        : Component(open(GAULT_BINARY_DIR "/lib/gault/plugins/" + variant + plugin + ".so"), kind, name,
                    settings) {}
    Component(const gault_module& module, gault_kind kind, const std::string& name, const Settings& settings)
        : declaration_(find(module, kind, name)) {
        const Values values(declaration_->parameters, settings);
        gault_error error{-1, 0, -1, ""};
        void* self = nullptr;
        const gault_status status = declaration_->create(nullptr, values.data(), &self, &error);
        if (status != GAULT_OK)
            throw Invalid(error.parameter < 0 ? "" : declaration_->parameters[error.parameter]->name,
                          error.text);
        self_ = {self, declaration_->destroy};
    }
    const void* self() const { return self_.get(); }
    const gault_component& declaration() const { return *declaration_; }
    template <class Api>
    const Api& api() const {
        return *static_cast<const Api*>(declaration_->api);
    }

  private:
    static const gault_module& open(const std::string& file) {
        void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); // stays open, as in the host
        if (!library) throw std::runtime_error(dlerror());
        const auto* module = static_cast<const gault_module*>(dlsym(library, GAULT_ENTRY_SYMBOL));
        if (!module) throw std::runtime_error(file + " does not export " GAULT_ENTRY_SYMBOL);
        return *module;
    }
    static const gault_component* find(const gault_module& module, gault_kind kind, const std::string& name) {
        for (const gault_component* const* c = module.components; *c; ++c)
            if ((*c)->kind == kind && name == (*c)->name) return *c;
        throw std::runtime_error("no component " + name);
    }
    const gault_component* declaration_;
    std::unique_ptr<void, void (*)(void*) noexcept> self_{nullptr, nullptr};
};

// `count` doubles, padded and aligned as the contract says.
class Column {
  public:
    explicit Column(int64_t count, double value = 0.0) : lines_(static_cast<std::size_t>(count + 7) / 8) {
        for (std::size_t i = 0; i < 8 * lines_.size(); ++i)
            data()[i] = value;
    }
    double* data() { return lines_.data()->value; }
    const double* data() const { return lines_.data()->value; }
    double& operator[](int64_t i) { return data()[i]; }
    double operator[](int64_t i) const { return data()[i]; }

  private:
    struct alignas(64) Line {
        double value[8];
    };
    std::vector<Line> lines_;
};
using Columns = std::deque<Column>;

using Tensor = std::array<double, 6>; // xx yy zz xy yz zx

class Batch {
  public:
    Batch(const Component& material, int64_t count, bool with_tangent = false)
        : modulus(count), shear_modulus(count), material_(material) {
        points_.size = sizeof points_;
        points_.count = count;
        points_.padded = (count + 7) / 8 * 8;
        points_.dt = 1.0;
        for (int i = 0; i < 6; ++i) {
            points_.strain[i] = add(strain, count);
            points_.stress_old[i] = add(stress_old, count);
            points_.stress[i] = add(stress, count);
        }
        const auto& api = material.api<gault_material_api>();
        for (uint32_t s = 0; s < api.state_count; ++s)
            for (uint32_t i = 0; i < api.states[s].shape; ++i) {
                old_states_.push_back(add(state_old, count, api.states[s].initial));
                states_.push_back(add(state, count));
            }
        points_.state_old = old_states_.data();
        points_.state = states_.data();
        for (const char* const* name = api.inputs; name && *name; ++name)
            inputs_.push_back(add(input, count, 1.0));
        points_.input = inputs_.data();
        points_.modulus = modulus.data();
        points_.shear_modulus = shear_modulus.data();
        for (int i = 0; with_tangent && i < 36; ++i)
            points_.tangent[i] = add(tangent, count);
    }
    Batch(const Batch&) = delete;

    gault_status update() {
        return material_.api<gault_material_api>().update(material_.self(), &points_, &error);
    }
    // Before the first step: stress_old is the initial stress; the model may set its states from it.
    gault_status start() {
        const auto& api = material_.api<gault_material_api>();
        for (int i = 0; i < 6; ++i)
            copy(stress_old[i], stress[i]);
        for (std::size_t i = 0; i < state.size(); ++i)
            copy(state_old[i], state[i]);
        gault_status status = GAULT_OK;
        if (api.start) status = api.start(material_.self(), &points_, &error);
        if (status == GAULT_OK) advance();
        return status;
    }
    // The end of a step becomes the start of the next.
    void advance() {
        for (int i = 0; i < 6; ++i)
            copy(stress[i], stress_old[i]);
        for (std::size_t i = 0; i < state.size(); ++i)
            copy(state[i], state_old[i]);
    }
    void set_dt(double dt) { points_.dt = dt; } // 1 s unless told
    void set_strain(int64_t point, const Tensor& value) { set(strain, point, value); }
    void set_stress_old(int64_t point, const Tensor& value) { set(stress_old, point, value); }
    Tensor stress_at(int64_t point) const {
        Tensor t;
        for (int i = 0; i < 6; ++i)
            t[i] = stress[i][point];
        return t;
    }
    int64_t count() const { return points_.count; }
    double suggested() const { return points_.suggest; } // fraction of the step, after GAULT_RETRY

    Columns strain, stress_old, stress, state_old, state, tangent, input; // inputs are 1 until set
    Column modulus, shear_modulus;
    gault_error error{-1, 0, -1, ""};

  private:
    static double* add(Columns& columns, int64_t count, double value = 0.0) {
        return columns.emplace_back(count, value).data();
    }
    void copy(const Column& from, Column& to) const { // in place: the contract's arrays stay where they are
        std::memcpy(to.data(), from.data(), sizeof(double) * static_cast<std::size_t>(points_.padded));
    }
    static void set(Columns& columns, int64_t point, const Tensor& value) {
        for (int i = 0; i < 6; ++i)
            columns[i][point] = value[i];
    }
    const Component& material_;
    std::vector<double*> old_states_, states_, inputs_;
    gault_points points_{};
};

} // namespace plugin_test
