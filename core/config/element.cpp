#include "core/config/element.hpp"

#include "core/config/overrides.hpp"
#include "core/config/reader.hpp"
#include "core/config/sections.hpp"
#include "core/registry/declared.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gault::core {
namespace config {
namespace {

enum Component6 { xx, yy, zz, xy, yz, zx };
const std::vector<std::string> component_names = {"xx", "yy", "zz", "xy", "yz", "zx"};
constexpr int deepest_cycle = 8;
constexpr Bounds strain_bounds{.min = -10.0, .max = 10.0};

using Constraints = std::array<Constraint, 6>;
using NamedNumbers = std::map<std::string, std::vector<double>>;

std::array<double, 6> unit(int component, double value = 1.0) {
    std::array<double, 6> e{};
    e[static_cast<std::size_t>(component)] = value;
    return e;
}
Constraint strain(int component, double end) {
    return {unit(component), {}, end};
}
Constraint stress(int component, std::optional<double> end = {}) {
    return {{}, unit(component), end};
}
Constraint volume(double end) {
    return {{1.0, 1.0, 1.0, 0.0, 0.0, 0.0}, {}, end};
}
Constraint difference(int a, int b, std::optional<double> end = {}) { // of two stresses
    Constraint c{{}, unit(a), end};
    c.stress[static_cast<std::size_t>(b)] = -1.0;
    return c;
}
// The three shear strains stay: rows xy, yz, zx.
Constraints with_still_shear(const Constraint& a, const Constraint& b, const Constraint& c) {
    return {a, b, c, strain(xy, 0.0), strain(yz, 0.0), strain(zx, 0.0)};
}

// The one of `keys` that is there.
std::string exactly_one(const Fields& fields, const std::vector<std::string>& keys) {
    std::string found, all;
    for (const std::string& key : keys) {
        all += (all.empty() ? "" : ", ") + key;
        if (fields.find(key) == nullptr) continue;
        if (!found.empty())
            throw InputError(fields.find(key)->where(),
                             fields.path(key) + " contradicts " + fields.path(found) + "; write one of them");
        found = key;
    }
    if (found.empty())
        throw InputError(fields.where(),
                         (fields.path().empty() ? "the file" : fields.path()) + " needs one of: " + all);
    return found;
}

// A person writes compression positive.
double pressure(const Fields& fields, const std::string& key) {
    return -fields.quantity(key, "Pa", {});
}
double shortening(const Fields& fields, const std::string& key) {
    return -fields.quantity(key, "1", strain_bounds);
}

bool is_undrained(const Fields& fields) {
    const Node* node = fields.find("drainage");
    return node && read_choice(*node, fields.path("drainage"), {"drained", "undrained"}) == 1;
}

void read_isotropic(const Fields& fields, ElementStage& stage) {
    if (exactly_one(fields, {"stress", "volumetric_strain"}) == "stress") {
        const double end = pressure(fields, "stress");
        stage.constraints = with_still_shear(stress(xx, end), stress(yy, end), stress(zz, end));
    } else {
        stage.constraints = with_still_shear(volume(shortening(fields, "volumetric_strain")),
                                             difference(xx, yy), difference(yy, zz));
    }
}

// The axis is y. Drained: lateral stresses stay, or go to radial_stress; undrained: volume and total stress stay.
void read_triaxial(const Fields& fields, ElementStage& stage) {
    const bool undrained = is_undrained(fields);
    const std::string drive = exactly_one(fields, {"axial_strain", "axial_stress", "deviator_stress"});
    for (const char* key : {"axial_stress", "radial_stress"})
        if (const Node* node = fields.find(key); node && undrained)
            throw InputError(node->where(), fields.path(key) +
                                                " is an effective stress, which an undrained test does not "
                                                "prescribe; write axial_strain or deviator_stress");
    const Constraint axial = drive == "axial_strain"   ? strain(yy, shortening(fields, drive))
                             : drive == "axial_stress" ? stress(yy, pressure(fields, drive))
                                                       : difference(yy, xx, pressure(fields, drive));
    std::optional<double> radial;
    if (fields.find("radial_stress")) radial = pressure(fields, "radial_stress");
    stage.constraints = undrained ? with_still_shear(axial, volume(0.0), difference(xx, zz))
                                  : with_still_shear(axial, stress(xx, radial), stress(zz, radial));
    if (undrained) stage.undrained = {1.0, 0.0, 0.0};
}

void read_oedometer(const Fields& fields, ElementStage& stage) {
    const std::string drive = exactly_one(fields, {"axial_strain", "axial_stress"});
    stage.constraints = with_still_shear(drive == "axial_strain" ? strain(yy, shortening(fields, drive))
                                                                 : stress(yy, pressure(fields, drive)),
                                         strain(xx, 0.0), strain(zz, 0.0));
}

// Axial y, lateral x, none along z.
void read_plane_strain(const Fields& fields, ElementStage& stage) {
    const bool undrained = is_undrained(fields);
    const std::string drive = exactly_one(fields, {"axial_strain", "deviator_stress"});
    const Constraint axial = drive == "axial_strain" ? strain(yy, shortening(fields, drive))
                                                     : difference(yy, xx, pressure(fields, drive));
    stage.constraints = with_still_shear(axial, undrained ? volume(0.0) : stress(xx), strain(zz, 0.0));
    if (undrained) stage.undrained = {1.0, 0.0, 0.0};
}

// Of the plane xy; engineering shear strain. No strain along x and z; along y the stress stays, or nothing moves.
void read_simple_shear(const Fields& fields, ElementStage& stage) {
    const bool undrained = is_undrained(fields);
    const std::string drive = exactly_one(fields, {"shear_strain", "shear_stress"});
    stage.constraints =
        with_still_shear(strain(xx, 0.0), undrained ? strain(yy, 0.0) : stress(yy), strain(zz, 0.0));
    stage.constraints[xy] = drive == "shear_strain" ? strain(xy, 0.5 * shortening(fields, drive))
                                                    : stress(xy, pressure(fields, drive));
    if (undrained) stage.undrained = {0.0, 1.0, 0.0};
}

// Principal stresses along y (major), z, x (minor): z - x = b (y - x). Undrained, it is a total stress that is held.
void read_true_triaxial(const Fields& fields, ElementStage& stage) {
    const double b = fields.quantity("b", "1", {.min = 0.0, .max = 1.0});
    const Node* node = fields.find("hold");
    const bool minor = node && read_choice(*node, fields.path("hold"), {"mean_stress", "minor_stress"}) == 1;
    Constraint intermediate{{}, {b - 1.0, -b, 1.0, 0.0, 0.0, 0.0}, 0.0};
    const std::array<double, 3> held =
        minor ? std::array{1.0, 0.0, 0.0} : std::array{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    const bool undrained = is_undrained(fields);
    stage.constraints = with_still_shear(
        strain(yy, shortening(fields, "axial_strain")), intermediate,
        undrained ? volume(0.0) : Constraint{{}, {held[0], held[1], held[2], 0.0, 0.0, 0.0}, {}});
    if (undrained) stage.undrained = held;
}

// {strain: {yy: 5 %}, stress: {xx: 100 kPa, zz: held}}; shear strains that are not named stay.
void read_mixed(const Fields& fields, ElementStage& stage) {
    std::array<bool, 6> given{};
    const auto read = [&](const char* key, const std::string& dimension, const Bounds& bounds, auto make) {
        const Fields part = fields.section(key, component_names);
        for (std::size_t k = 0; k < 6; ++k) {
            const Node* node = part.find(component_names[k]);
            if (node == nullptr) continue;
            if (given[k])
                throw InputError(node->where(), part.path(component_names[k]) +
                                                    " is prescribed already: strain or stress, not both");
            given[k] = true;
            const bool held = node->kind == NodeKind::scalar && node->text == "held";
            std::optional<double> end;
            if (!held) end = -read_quantity(*node, part.path(component_names[k]), dimension, bounds);
            stage.constraints[k] = make(static_cast<int>(k), end);
        }
    };
    read("strain", "1", strain_bounds,
         [](int k, std::optional<double> end) { return strain(k, end.value_or(0.0)); });
    read("stress", "Pa", {}, [](int k, std::optional<double> end) { return stress(k, end); });
    for (std::size_t k = 0; k < 6; ++k) {
        if (given[k]) continue;
        if (k < 3)
            throw InputError(fields.where(), fmt::format("{}: {} has neither a strain nor a stress",
                                                         fields.path(), component_names[k]));
        stage.constraints[k] = strain(static_cast<int>(k), 0.0);
    }
}

struct Kind {
    const char* name;
    std::vector<std::string> keys;
    void (*read)(const Fields&, ElementStage&);
};
const std::vector<Kind> kinds = {
    {"isotropic", {"stress", "volumetric_strain"}, read_isotropic},
    {"triaxial",
     {"axial_strain", "axial_stress", "deviator_stress", "radial_stress", "drainage"},
     read_triaxial},
    {"oedometer", {"axial_strain", "axial_stress"}, read_oedometer},
    {"plane_strain", {"axial_strain", "deviator_stress", "drainage"}, read_plane_strain},
    {"simple_shear", {"shear_strain", "shear_stress", "drainage"}, read_simple_shear},
    {"true_triaxial", {"axial_strain", "b", "hold", "drainage"}, read_true_triaxial},
    {"mixed", {"strain", "stress"}, read_mixed},
};

class StageReader {
  public:
    explicit StageReader(std::vector<ElementStage>& stages) : stages_(stages) {}

    void read_list(const Node& list, const std::string& path, const std::string& label, int depth) {
        const auto nodes = one_or_more(list);
        if (nodes.empty()) throw InputError(list.where(), path + " is empty");
        for (std::size_t i = 0; i < nodes.size(); ++i)
            read_one(*nodes[i], list.kind == NodeKind::list ? path + "." + std::to_string(i) : path,
                     label + std::to_string(i + 1), depth);
    }

  private:
    std::vector<ElementStage>& stages_;
    int64_t steps_ = 0;

    void read_one(const Node& node, const std::string& path, const std::string& label, int depth) {
        std::vector<std::string> names;
        for (const Kind& kind : kinds)
            names.emplace_back(kind.name);
        names.emplace_back("cycle");
        if (node.kind != NodeKind::map || node.keys.size() != 1)
            throw InputError(node.where(), path + " must be a single {kind: {...}}; found " +
                                               described(node) + did_you_mean("", names));
        const std::string& name = node.keys[0].text;
        if (name == "cycle") return read_cycle(node.items[0], path + ".cycle", label, depth);
        const auto kind =
            std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return name == k.name; });
        if (kind == kinds.end())
            throw InputError(node.keys[0].place.location(),
                             path + ": unknown kind " + in_quotes(name) + did_you_mean(name, names));
        std::vector<std::string> keys = kind->keys;
        keys.insert(keys.end(), {"steps", "duration"});
        const Fields fields(node.items[0], path + "." + name, keys);
        ElementStage stage{name, label, {}, 100, 1.0, {}};
        if (const Node* steps = fields.find("steps"))
            stage.steps = static_cast<int>(
                read_integer(*steps, fields.path("steps"), {.min = 1, .max = most_element_steps}));
        stage.duration = fields.quantity("duration", "s", positive, stage.duration);
        kind->read(fields, stage);
        add(std::move(stage), node.where());
    }

    void read_cycle(const Node& node, const std::string& path, const std::string& label, int depth) {
        if (depth == deepest_cycle)
            throw InputError(node.where(),
                             fmt::format("{}: cycles within cycles, more than {} deep", path, depth));
        const Fields fields(node, path, {"count", "stages"});
        const auto count = read_integer(fields.require("count", "how often"), fields.path("count"),
                                        {.min = 1, .max = most_element_steps});
        const std::size_t first = stages_.size();
        read_list(fields.require("stages", "a list of stages"), fields.path("stages"), label + ".",
                  depth + 1);
        const std::vector<ElementStage> once(stages_.begin() + static_cast<std::ptrdiff_t>(first),
                                             stages_.end());
        for (std::int64_t turn = 1; turn < count; ++turn)
            for (const ElementStage& stage : once)
                add(stage, fields.where());
    }

    void add(ElementStage stage, const Location& where) {
        steps_ += stage.steps;
        if (steps_ > most_element_steps)
            throw InputError(where, fmt::format("more than {} steps in all", most_element_steps));
        if (stages_.size() == most_element_stages)
            throw InputError(where,
                             fmt::format("more than {} stages, cycles written out", most_element_stages));
        stages_.push_back(std::move(stage));
    }
};

// `count` numbers, a single one without brackets.
std::vector<double> read_numbers(const Node& node, const std::string& path, std::size_t count,
                                 const std::string& unit = "1", const Bounds& bounds = {}) {
    const auto items = one_or_more(node);
    if (items.size() != count)
        throw InputError(node.where(),
                         fmt::format("{} has {} values; it must have {}", path, items.size(), count));
    std::vector<double> values;
    for (const Node* item : items)
        values.push_back(read_quantity(*item, path, unit, bounds));
    return values;
}

template <std::size_t N>
std::array<double, N> read_array(const Fields& fields, const std::string& key, const std::string& meaning) {
    const std::vector<double> values = read_numbers(fields.require(key, meaning), fields.path(key), N);
    std::array<double, N> array;
    std::copy(values.begin(), values.end(), array.begin());
    return array;
}

// Of a person, within the bounds of the state and with its unit; of a machine, bare numbers, whatever they were.
NamedNumbers read_states(const Fields& parent, const MaterialUse& soil, bool of_a_person) {
    if (parent.find("states") == nullptr) return {};
    const Instance instance(*soil.model.component, soil.model.parameters);
    const auto states = material_states(instance);
    std::vector<std::string> names;
    for (const gault_state& state : states)
        names.emplace_back(state.name);
    const Fields fields = parent.section("states", names);
    NamedNumbers all;
    for (const gault_state& state : states)
        if (const Node* node = fields.find(state.name))
            all[state.name] =
                read_numbers(*node, fields.path(state.name), state.shape, of_a_person ? state.unit : "1",
                             of_a_person ? Bounds{.min = state.min, .max = state.max} : Bounds{});
    return all;
}

NamedNumbers read_inputs(const Fields& parent, const char* const* asked_for) {
    std::vector<std::string> names;
    for (; asked_for && *asked_for; ++asked_for)
        names.emplace_back(*asked_for);
    const Fields fields = parent.section("inputs", names);
    NamedNumbers all;
    for (const std::string& name : names)
        if (const Node* node = fields.find(name)) all[name] = read_numbers(*node, fields.path(name), 1);
    return all;
}

ElementReplay read_replay(const Node& node, const MaterialUse& soil) {
    const auto& api = *static_cast<const gault_material_api*>(soil.model.component->declaration->api);
    std::vector<std::string> keys = {"stress", "strain", "states", "inputs", "time", "dt"};
    if (api.flags & GAULT_FINITE_STRAIN) keys.insert(keys.end(), {"F_old", "F_new"});
    const Fields fields(node, "replay", keys);
    ElementReplay replay;
    replay.stress = read_array<6>(fields, "stress", "six numbers, Pa, tension positive");
    replay.strain = read_array<6>(fields, "strain", "six increments, tension positive");
    replay.states = read_states(fields, soil, false);
    replay.inputs = read_inputs(fields, api.inputs);
    if (api.flags & GAULT_FINITE_STRAIN) {
        replay.F_old = read_array<9>(fields, "F_old", "the deformation gradient before, row by row");
        replay.F_new = read_array<9>(fields, "F_new", "the deformation gradient after, row by row");
    }
    replay.time = fields.quantity("time", "s", {}, replay.time);
    replay.dt = fields.quantity("dt", "s", not_negative, replay.dt);
    return replay;
}

// Compression positive: {isotropic: 100 kPa} or {xx: ..., yy: ..., ...}, zero where nothing is said.
std::array<double, 6> read_stress(const Fields& initial) {
    std::vector<std::string> keys = component_names;
    keys.emplace_back("isotropic");
    const Fields fields = initial.section("stress", keys);
    std::array<double, 6> tensor;
    for (std::size_t k = 0; k < 6; ++k)
        tensor[k] = -fields.quantity(component_names[k], "Pa", {}, 0.0);
    const Node* isotropic = fields.find("isotropic");
    for (std::size_t k = 0; k < 3 && isotropic; ++k) {
        if (fields.find(component_names[k]))
            throw InputError(isotropic->where(),
                             fields.path("isotropic") + " contradicts " + fields.path(component_names[k]));
        tensor[k] = pressure(fields, "isotropic");
    }
    return tensor;
}

void read_test(const Fields& root, ElementTest& test) {
    if (test.material.water)
        throw InputError(root.require("material").find("pore_water")->where(),
                         "material.pore_water has no place here: the stages of a test say `drainage: "
                         "undrained`, and their stress is effective");
    const Fields initial = root.section("initial", {"stress", "states"});
    test.stress = read_stress(initial);
    test.states = read_states(initial, test.material, true);
    test.characteristic_length =
        root.quantity("characteristic_length", "m", positive, test.characteristic_length);
    StageReader(test.stages).read_list(root.require("test"), "test", "", 0);
}

void read_call(const Fields& root, ElementTest& test) {
    for (const char* key : {"initial", "characteristic_length"})
        if (const Node* node = root.find(key))
            throw InputError(node->where(),
                             std::string(key) + " has no place beside replay, which has its own");
    test.replay = read_replay(root.require("replay"), test.material);
    test.material.water.reset(); // the call has the effective stress
}

} // namespace

ElementTest read_element_text(std::string text, const std::filesystem::path& file,
                              const std::vector<Override>& overrides, const Registry& registry) {
    const Node document = parse_with_overrides(std::move(text), file, overrides);
    if (const Node* geometry = document.find("geometry"))
        throw InputError(geometry->where(),
                         "a test of one point has no geometry; a scene is for `gault run`");
    const Fields root(
        document, "",
        {"gault", "title", "plugins", "material", "characteristic_length", "initial", "test", "replay"});
    check_version(root);
    ElementTest test;
    test.file = file;
    test.title = root.find("title") ? read_text_value(*root.find("title"), "title") : file.stem().string();
    const Node& material = root.require("material", "the soil: {model: NAME, ...}");
    test.material = read_material(material, "", "material", registry, 2000.0);
    test.material.name = test.material.model.component->declaration->name;
    (exactly_one(root, {"test", "replay"}) == "test" ? read_test : read_call)(root, test);
    test.yaml = emit(document);
    return test;
}

} // namespace config

namespace {

std::string indented(const std::string& block) {
    std::string text;
    for (std::size_t begin = 0; begin < block.size();) {
        const std::size_t end = std::min(block.find('\n', begin), block.size());
        text += "  " + block.substr(begin, end - begin) + "\n";
        begin = end + 1;
    }
    return text;
}

std::string named_numbers(const std::string& key, const std::map<std::string, std::vector<double>>& all) {
    std::string text;
    for (const auto& [name, values] : all)
        text += fmt::format("    {}: [{}]\n", name, fmt::join(values, ", "));
    return all.empty() ? "" : "  " + key + ":\n" + text;
}

} // namespace

std::string replay_yaml(const std::string& title, const MaterialUse& material, const ElementReplay& call) {
    config::Node heading;
    heading.kind = config::NodeKind::scalar;
    heading.quoted = true;
    heading.text = title;
    std::string text =
        "gault: 1\ntitle: " + config::emit(heading) + "material:\n" + indented(material.yaml) +
        "replay: # one call of the model, as the run made it: SI, tension positive, tensor shear\n";
    text += fmt::format("  stress: [{}]\n  strain: [{}]\n", fmt::join(call.stress, ", "),
                        fmt::join(call.strain, ", "));
    text += named_numbers("states", call.states) + named_numbers("inputs", call.inputs);
    if (call.F_old && call.F_new)
        text += fmt::format("  F_old: [{}]\n  F_new: [{}]\n", fmt::join(*call.F_old, ", "),
                            fmt::join(*call.F_new, ", "));
    return text + fmt::format("  time: {} s\n  dt: {} s\n", call.time, call.dt);
}

ElementTest read_element_test(const std::filesystem::path& file, const std::vector<Override>& overrides,
                              const Registry& registry) {
    return config::read_element_text(config::read_text(file), file, overrides, registry);
}

} // namespace gault::core
