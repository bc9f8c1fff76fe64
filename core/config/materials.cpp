#include "core/config/component.hpp"
#include "core/config/sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace gault::core::config {
namespace {

constexpr std::size_t most_regions = 1000;
const std::vector<std::string> host_keys = {"model", "density", "pore_water"};

PoreWater read_water(const Node& node, const std::string& path) {
    const Fields fields(node, path, {"bulk_modulus", "porosity", "initial_pressure"});
    const double bulk = fields.quantity("bulk_modulus", "Pa", positive, 2.2e9);
    const double porosity = fields.quantity("porosity", "1", {.min = 0.0, .max = 1.0, .min_open = true}, 0.4);
    return {bulk / porosity, fields.quantity("initial_pressure", "Pa", not_negative, 0.0)};
}

std::vector<std::string> names_of(const std::vector<MaterialUse>& materials, std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i)
        names.push_back(materials[i].name);
    return names;
}

// The material's own map with some values replaced; every error stands where the override does.
Node with_overrides(const Node& base, const Node& overrides, const std::string& path,
                    const Component& component) {
    auto keys = parameter_names(component.declaration->parameters);
    keys.insert(keys.end(), host_keys.begin() + 1, host_keys.end()); // the model stays
    const Fields fields(overrides, path, keys);
    if (overrides.keys.empty()) throw InputError(overrides.where(), path + " changes nothing");
    Node merged = base;
    for (std::size_t i = 0; i < overrides.keys.size(); ++i) {
        const auto same = std::find_if(merged.keys.begin(), merged.keys.end(),
                                       [&](const Key& key) { return key.text == overrides.keys[i].text; });
        if (same != merged.keys.end()) {
            merged.items[static_cast<std::size_t>(same - merged.keys.begin())] = *fields.find(same->text);
        } else {
            merged.keys.push_back(overrides.keys[i]);
            merged.items.push_back(*fields.find(overrides.keys[i].text));
        }
    }
    return merged;
}

class RegionReader {
  public:
    RegionReader(const Source& source, Scene& scene, const Node& materials, const Node* soil)
        : source_(source), scene_(scene), materials_(materials), soil_(soil),
          declared_(scene.materials.size()), centres_{cell_centres(scene, 0), cell_centres(scene, 1)} {}

    void read(const Node& regions);
    bool covers_all_cells() const;

  private:
    const Source& source_;
    Scene& scene_;
    const Node& materials_;
    const Node* soil_;
    std::size_t declared_; // materials under `materials`; those of regions follow
    std::array<std::vector<double>, 2> centres_;
    std::size_t copied_ = 0; // nodes of materials that overrides repeat

    void read_one(const Node& node, const std::string& path);
    int material_of(const Fields& fields, const std::string& name);
    void read_cells(const Fields& fields, Region& region) const;
    std::array<double, 2> read_extent(const Fields& fields, std::size_t axis) const;
    bool cells_are_open() const {
        return std::any_of(scene_.chosen.begin(), scene_.chosen.end(),
                           [](const Choice& choice) { return choice.key == "grid.cells"; });
    }
};

void RegionReader::read(const Node& regions) {
    require_kind(regions, NodeKind::list, "regions");
    if (regions.items.size() > most_regions)
        throw InputError(regions.where(),
                         fmt::format("{} regions; allowed: {}", regions.items.size(), most_regions));
    for (std::size_t i = 0; i < regions.items.size(); ++i)
        read_one(regions.items[i], "regions." + std::to_string(i));
}

void RegionReader::read_one(const Node& node, const std::string& path) {
    const auto axes = axis_names(scene_.geometry);
    const Fields fields(node, path, {"name", "material", "overrides", axes[0], axes[1]});
    Region region;
    const Node& name = fields.require("name");
    region.name = read_name(name, fields.path("name"));
    region.where = node.where();
    for (const auto& other : scene_.regions)
        if (other.name == region.name)
            throw InputError(name.where(), path + ": the region " + in_quotes(region.name) +
                                               " is there already, at " + other.where.text());
    region.material = material_of(fields, region.name);
    read_cells(fields, region);
    scene_.regions.push_back(std::move(region));
}

int RegionReader::material_of(const Fields& fields, const std::string& name) {
    const auto names = names_of(scene_.materials, declared_);
    const Node* material = fields.find("material");
    const Node* overrides = fields.find("overrides");
    if (material == nullptr && overrides == nullptr)
        throw InputError(fields.where(), fields.path() + " needs a material, or overrides of the soil's");
    if (material == nullptr && soil_ == nullptr && declared_ != 1)
        throw InputError(overrides->where(),
                         fields.path("overrides") +
                             ": of which material? name it in `material`, or the soil's in `soil`");
    const int base = material ? index_of_name(*material, fields.path("material"), names, "material")
                     : soil_  ? index_of_name(*soil_, "soil", names, "material")
                              : 0;
    if (overrides == nullptr) return base;
    if (std::find(names.begin(), names.end(), name) != names.end())
        throw InputError(fields.require("name").where(), fields.path() +
                                                             ": its overrides make a material named " +
                                                             in_quotes(name) + ", which is there already");
    const auto index = static_cast<std::size_t>(base);
    const Node merged = with_overrides(materials_.items[index], *overrides, fields.path("overrides"),
                                       *scene_.materials[index].model.component);
    copied_ += size_of(merged);
    if (copied_ > most_nodes)
        throw InputError(overrides->where(),
                         fmt::format("more than {} values once overrides are applied", most_nodes));
    scene_.materials.push_back(read_material(merged, name, fields.path("overrides"), source_.registry));
    return static_cast<int>(scene_.materials.size()) - 1;
}

void RegionReader::read_cells(const Fields& fields, Region& region) const {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto& centres = centres_[axis];
        const auto [low, high] = read_extent(fields, axis);
        auto first = std::lower_bound(centres.begin(), centres.end(), low);
        auto last = std::upper_bound(first, centres.end(), high);
        if (first == last && cells_are_open()) { // the plan has yet to choose finer ones
            if (first == centres.end()) --first;
            last = first + 1;
        }
        if (first == last)
            throw InputError(
                fields.where(),
                fmt::format("the region {} takes hold of nothing: no cell has its centre between {:g} m and "
                            "{:g} m along {}; widen it or refine the grid",
                            in_quotes(region.name), low, high, axis_names(scene_.geometry)[axis]));
        region.cells.first[axis] = static_cast<int>(first - centres.begin());
        region.cells.last[axis] = static_cast<int>(last - centres.begin());
        region.extent[axis] = {std::max(low, scene_.geometry.lower[axis]),
                               std::min(high, scene_.geometry.upper[axis])};
    }
}

std::array<double, 2> RegionReader::read_extent(const Fields& fields, std::size_t axis) const {
    const double lower = scene_.geometry.lower[axis], upper = scene_.geometry.upper[axis];
    const std::string name = axis_names(scene_.geometry)[axis];
    const Node* node = fields.find(name);
    if (node == nullptr) return {lower, upper};
    const auto range = read_range(*node, fields.path(name), "m");
    if (axis == 1 && scene_.symmetry == Symmetry::radial) {
        if (range[0] <= scene_.height[0] && range[1] >= scene_.height[1]) return {lower, upper};
        throw InputError(node->where(), fields.path(name) +
                                            ": in radial symmetry nothing ends along the height; "
                                            "leave it out, or write `symmetry: axisymmetric`");
    }
    if (range[1] <= lower || range[0] >= upper)
        throw InputError(node->where(),
                         fmt::format("{} lies outside of the grid, which goes from {:g} m to {:g} m",
                                     fields.path(name), lower, upper));
    return range;
}

// Rows between two neighbouring edges of regions are alike: one of each suffices.
bool RegionReader::covers_all_cells() const {
    std::vector<int> rows{0};
    std::vector<CellRange> by_first;
    for (const Region& region : scene_.regions) {
        by_first.push_back(region.cells);
        for (const int row : {region.cells.first[1], region.cells.last[1]})
            if (row < scene_.axes[1].cells) rows.push_back(row);
    }
    std::sort(by_first.begin(), by_first.end(),
              [](const CellRange& a, const CellRange& b) { return a.first[0] < b.first[0]; });
    return std::all_of(rows.begin(), rows.end(), [&](int row) {
        int covered = 0;
        for (const auto& [first, last] : by_first)
            if (first[1] <= row && row < last[1] && first[0] <= covered) covered = std::max(covered, last[0]);
        return covered == scene_.axes[0].cells;
    });
}

int base_material(const Node* soil, const RegionReader& regions, std::size_t declared, const Node& materials,
                  Scene& scene) {
    if (soil != nullptr) return index_of_name(*soil, "soil", names_of(scene.materials, declared), "material");
    if (declared == 1) return 0;
    if (!regions.covers_all_cells())
        throw InputError(materials.where(), "there are " + std::to_string(declared) +
                                                " materials; name the one outside of the regions: `soil: " +
                                                scene.materials.front().name + "`");
    note_choice(scene, "soil", scene.materials.front().name, "the regions cover every cell");
    return 0;
}

} // namespace

MaterialUse read_material(const Node& node, const std::string& name, const std::string& path,
                          const Registry& registry, std::optional<double> density) {
    require_kind(node, NodeKind::map, path);
    const Node* model = node.find("model");
    if (model == nullptr)
        throw InputError(node.where(), path + ".model is missing: the name of a material model");
    const Component& component =
        registry.find(GAULT_MATERIAL, read_name(*model, path + ".model"), model->where());
    MaterialUse material{name,
                         {&component, read_parameters(node, path, host_keys, component)},
                         density.value_or(0.0),
                         {},
                         emit(node)};
    if (const Node* written = node.find("density"))
        material.density = read_quantity(*written, path + ".density", "kg/m^3", positive);
    else if (!density)
        throw InputError(node.where(), path + ".density is missing (of the soil at the start, kg/m^3)");
    if (const Node* water = node.find("pore_water"))
        material.water = read_water(*water, path + ".pore_water");
    return material;
}

void read_materials(const Source& source, Scene& scene) {
    const Node& materials =
        source.root.require("materials", "a map of names: {sand: {model: ..., density: ...}}");
    require_kind(materials, NodeKind::map, "materials");
    if (materials.items.empty())
        throw InputError(materials.where(), "materials is empty; a scene has at least one");
    for (std::size_t i = 0; i < materials.items.size(); ++i) {
        const std::string path = "materials." + materials.keys[i].text;
        if (materials.items[i].kind == NodeKind::null)
            throw InputError(materials.items[i].where(), path + " has no value");
        scene.materials.push_back(
            read_material(materials.items[i], materials.keys[i].text, path, source.registry));
    }
    const std::size_t declared = scene.materials.size();
    const Node* soil = source.root.find("soil");
    RegionReader regions(source, scene, materials, soil);
    if (const Node* node = source.root.find("regions")) regions.read(*node);
    scene.base_material = base_material(soil, regions, declared, materials, scene);
}

} // namespace gault::core::config
