// Scenes made in memory, with materials and boundaries that are functions in the test: no YAML, no plugin
// files.
#pragma once
#include "core/config/scene.hpp"
#include "core/solver/explicit.hpp"
#include "core/solver/model.hpp"

#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gault::core::test {

// A component whose `self` is an object of the test: its address travels through the only parameter.
class TestComponent {
  public:
    TestComponent(gault_kind kind, const char* name) {
        declaration_.size = sizeof declaration_;
        declaration_.kind = kind;
        declaration_.name = name;
        declaration_.version = "1.0.0";
        declaration_.doc = declaration_.reference = "";
        declaration_.parameters = parameters_;
        declaration_.create = [](const gault_host*, const gault_value* v, void** self,
                                 gault_error*) noexcept {
            *self = reinterpret_cast<void*>(v[0].integer);
            return gault_status(GAULT_OK);
        };
        declaration_.destroy = [](void*) noexcept {};
    }
    virtual ~TestComponent() = default;
    TestComponent(const TestComponent&) = delete;

    ComponentUse use(const void* api) {
        declaration_.api = api;
        component_ = {&declaration_, nullptr, GAULT_SOURCE_DIR "/CMakeLists.txt"};
        ComponentUse use{&component_, {}};
        gault_value address{};
        address.integer = reinterpret_cast<int64_t>(this);
        address.text = "";
        address.count = 1;
        use.parameters.values.push_back(address);
        use.parameters.where = {"scene.yaml", 7, 3};
        use.parameters.locations.push_back(use.parameters.where);
        return use;
    }

  private:
    static const gault_parameter* const* parameter_list() {
        static const gault_parameter self{sizeof(gault_parameter),
                                          GAULT_INTEGER,
                                          GAULT_REQUIRED,
                                          0,
                                          "self",
                                          "",
                                          "1",
                                          nullptr,
                                          "",
                                          0.0,
                                          -HUGE_VAL,
                                          HUGE_VAL,
                                          nullptr,
                                          nullptr,
                                          0,
                                          0};
        static const gault_parameter* const list[] = {&self, nullptr};
        return list;
    }
    const gault_parameter* const* parameters_ = parameter_list();
    gault_component declaration_{};
    Component component_{};
};

class TestMaterial : public TestComponent {
  public:
    double lame, shear;
    uint32_t flags = 0;
    std::vector<gault_state> states;
    std::vector<const char*> inputs;
    // Replace these to do something else than isotropic elasticity with states that stay as they are.
    std::function<gault_status(gault_points&, gault_error&)> update, start;

    TestMaterial(double lame_, double shear_)
        : TestComponent(GAULT_MATERIAL, "test_material"), lame(lame_), shear(shear_) {}

    ComponentUse use() {
        inputs.push_back(nullptr);
        api_ = {sizeof api_, flags,   states.data(), inputs.data(), static_cast<uint32_t>(states.size()),
                0,           nullptr, nullptr,       nullptr};
        api_.update = [](const void* self, gault_points* p, gault_error* e) noexcept {
            const auto& m = *static_cast<const TestMaterial*>(self);
            return m.update ? m.update(*p, *e) : m.elastic(*p);
        };
        if (start)
            api_.start = [](const void* self, gault_points* p, gault_error* e) noexcept {
                return static_cast<const TestMaterial*>(self)->start(*p, *e);
            };
        return TestComponent::use(&api_);
    }

    gault_status elastic(gault_points& p) const {
        for (int64_t i = 0; i < p.count; ++i) {
            const double volumetric = lame * (p.strain[0][i] + p.strain[1][i] + p.strain[2][i]);
            for (int k = 0; k < 6; ++k)
                p.stress[k][i] =
                    p.stress_old[k][i] + (k < 3 ? volumetric : 0.0) + 2.0 * shear * p.strain[k][i];
            if (p.modulus) p.modulus[i] = lame + 2.0 * shear;
            if (p.shear_modulus) p.shear_modulus[i] = shear;
        }
        int component = 0;
        for (const gault_state& state : states)
            for (uint32_t k = 0; k < state.shape; ++k, ++component)
                for (int64_t i = 0; i < p.count; ++i)
                    p.state[component][i] = p.state_old[component][i];
        return GAULT_OK;
    }

  private:
    gault_material_api api_{};
};

class TestBoundary : public TestComponent {
  public:
    std::function<void(gault_nodes&)> constrain;
    std::function<void(gault_facets&)> load;
    std::vector<gault_signal> controls;
    gault_status answer = GAULT_OK;

    TestBoundary() : TestComponent(GAULT_BOUNDARY, "test_boundary") {}

    ComponentUse use() {
        api_ = {sizeof api_, 0, controls.data(), static_cast<uint32_t>(controls.size()), 0, nullptr, nullptr};
        if (constrain)
            api_.constrain = [](const void* self, gault_nodes* n, gault_error*) noexcept {
                const auto& b = *static_cast<const TestBoundary*>(self);
                b.constrain(*n);
                return b.answer;
            };
        if (load)
            api_.load = [](const void* self, gault_facets* f, gault_error*) noexcept {
                const auto& b = *static_cast<const TestBoundary*>(self);
                b.load(*f);
                return b.answer;
            };
        return TestComponent::use(&api_);
    }

  private:
    gault_boundary_api api_{};
};

class TestProgram : public TestComponent {
  public:
    std::vector<gault_signal> measures, controls, memories, records;
    std::function<gault_status(gault_step&, gault_error&)> advance;
    std::function<gault_status(const gault_history&, gault_report&, gault_error&)> evaluate; // may be empty

    TestProgram() : TestComponent(GAULT_PROGRAM, "test_program") {}

    ComponentUse use() {
        const auto count = [](const auto& signals) { return static_cast<uint32_t>(signals.size()); };
        signals_ = {sizeof signals_, 0,
                    measures.data(), controls.data(),
                    memories.data(), records.data(),
                    count(measures), count(controls),
                    count(memories), count(records)};
        api_ = {};
        api_.size = sizeof api_;
        api_.signals = &signals_;
        api_.advance = [](const void* self, gault_step* s, gault_error* e) noexcept {
            return static_cast<const TestProgram*>(self)->advance(*s, *e);
        };
        if (evaluate)
            api_.evaluate = [](const void* self, const gault_history* h, gault_report* r,
                               gault_error* e) noexcept {
                return static_cast<const TestProgram*>(self)->evaluate(*h, *r, *e);
            };
        return TestComponent::use(&api_);
    }

  private:
    gault_program_signals signals_{};
    gault_program_api api_{};
};

class TestObserver : public TestComponent {
  public:
    std::vector<gault_signal> measures, results;
    std::vector<const char*> fields;
    std::function<gault_status(gault_sample&, gault_error&)> evaluate;

    TestObserver() : TestComponent(GAULT_OBSERVER, "test_observer") {}

    ComponentUse use() {
        fields.push_back(nullptr);
        api_ = {sizeof api_,
                0,
                measures.data(),
                results.data(),
                fields.data(),
                static_cast<uint32_t>(measures.size()),
                static_cast<uint32_t>(results.size()),
                nullptr};
        api_.evaluate = [](const void* self, gault_sample* s, gault_error* e) noexcept {
            return static_cast<const TestObserver*>(self)->evaluate(*s, *e);
        };
        return TestComponent::use(&api_);
    }

  private:
    gault_observer_api api_{};
};

struct Shape {
    Symmetry symmetry = Symmetry::plane_strain;
    Frame frame = Frame::total;
    Basis basis = Basis::quadratic;
    std::array<double, 2> lower{0.0, 0.0}, upper{1.0, 1.0};
    std::array<GridAxis, 2> axes{{{4, 1.2}, {3, 0.9}}};
    int per_cell = 16;
    Placement placement = Placement::gauss;
};

class SmallScene {
  public:
    Scene scene{};

    explicit SmallScene(const Shape& shape) {
        scene.title = "small";
        scene.file = GAULT_SOURCE_DIR "/CMakeLists.txt";
        scene.symmetry = shape.symmetry;
        scene.frame = shape.frame;
        scene.basis = shape.basis;
        scene.geometry = {"block", shape.lower, shape.upper, {}};
        scene.surfaces = {
            {"left", low_x, {}}, {"right", high_x, {}}, {"bottom", low_y, {}}, {"top", high_y, {}}};
        scene.axes = shape.axes;
        scene.points_per_cell = shape.per_cell;
        scene.placement = shape.placement;
        scene.solver.viscosity = 0.0;
    }

    // Cells [first, last) of a side, as a surface of its own.
    int part(int side, int first, int last) {
        const int index = static_cast<int>(scene.surfaces.size());
        scene.surfaces.push_back({"part " + std::to_string(index), side, std::array{first, last}});
        return index;
    }

    // Called after the material is complete.
    void add(TestMaterial& material, double density, const std::string& name = "soil") {
        scene.materials.push_back({name, material.use(), density});
    }
    void add(TestBoundary& boundary, std::vector<int> sides) {
        scene.boundaries.push_back({std::move(sides), boundary.use()});
    }

    void add(TestProgram& program, std::optional<int> side = std::nullopt) {
        scene.program = program.use();
        scene.program_surface = side;
    }

    // Rollers on sides, a uniform follower pressure on others.
    void roll(std::vector<int> sides) {
        TestBoundary& b = boundaries_.emplace_back();
        b.constrain = [](gault_nodes& nodes) {
            for (int64_t i = 0; i < nodes.count; ++i)
                for (int k = 0; k < 2; ++k)
                    if (nodes.normal[k][i] != 0.0) nodes.fixed[k][i] = 1.0;
        };
        add(b, std::move(sides));
    }
    void press(std::vector<int> sides, double pressure) {
        TestBoundary& b = boundaries_.emplace_back();
        b.load = [pressure](gault_facets& f) {
            for (int64_t i = 0; i < f.count; ++i)
                f.pressure[i] = pressure;
        };
        add(b, std::move(sides));
    }

  private:
    std::deque<TestBoundary> boundaries_;
};

// The model of a scene and its motion, without a solver.
struct Body {
    Model model;
    std::unique_ptr<Motion> motion;
    Body(const Scene& scene, int threads = 1)
        : model(build_model(scene)),
          motion(scene.frame == Frame::total
                     ? make_total_motion(model.grid, model.materials, model.points, threads)
                     : make_updated_motion(model.grid, model.materials, model.points, threads,
                                           scene.solver.stress_update == StressUpdate::usf)) {}

    const NodeLayout& layout() const { return model.grid.layout(); }
    // A nodal field f(reference position of the node) -> {x, y}: exact in the body where f is linear.
    template <class F>
    VectorField field(F f) const {
        VectorField values(layout());
        for (int j = 0; j < layout().ny; ++j)
            for (int i = 0; i < layout().nx; ++i) {
                const std::array<double, 2> v = f(model.grid.axis(0).node(i), model.grid.axis(1).node(j));
                for (int k = 0; k < 2; ++k)
                    values.c[k][layout().index(i, j)] = v[k];
            }
        return values;
    }
    template <class F>
    void each_point(F f) { // f(columns, slot, record)
        for (int m = 0; m < static_cast<int>(model.points.size()); ++m)
            model.points[m].each_point(
                [&](std::size_t slot) { f(model.points[m].columns(), slot, motion->record(m, slot)); });
    }
};

} // namespace gault::core::test
