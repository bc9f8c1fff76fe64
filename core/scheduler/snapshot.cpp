#include "core/scheduler/snapshot.hpp"

#include <fmt/format.h>

#include <cstring>
#include <limits>

namespace gault::core {
namespace {

template <class F>
void each(const Motion& motion, F f) { // f(material, slot, identity)
    for (int m = 0; m < static_cast<int>(motion.points().size()); ++m) {
        const Points& points = motion.points()[m];
        points.each_point([&](std::size_t slot) { f(m, slot, points.identity(slot)); });
    }
}

template <class Field>
Dataset vector_of(const Motion& motion, ColumnInfo info, Field field) {
    return {std::move(info), 3, [&motion, field](double* out) {
                each(motion, [&](int m, std::size_t slot, uint32_t id) {
                    const std::array<double, 2> v = field(motion.record(m, slot));
                    out[3 * id] = v[0];
                    out[3 * id + 1] = v[1];
                    out[3 * id + 2] = 0.0;
                });
            }};
}

const StateInfo* find_state(const Material& material, const std::string& name) {
    for (const StateInfo& info : material.states())
        if (name == info.declared.name) return &info;
    return nullptr;
}

Dataset state_of(const Motion& motion, const gault_state& declared) {
    const int components = static_cast<int>(declared.shape);
    return {{declared.name, declared.unit,
             std::string(declared.doc) + " 0 where the material has no such state."},
            components,
            [&motion, components, name = std::string(declared.name)](double* out) {
                each(motion, [&](int m, std::size_t slot, uint32_t id) {
                    const StateInfo* info = find_state(motion.materials()[m], name);
                    for (int k = 0; k < components; ++k)
                        out[static_cast<std::size_t>(components) * id + k] =
                            info ? motion.points()[m].columns().state[info->first + k][slot] : 0.0;
                });
            }};
}

std::vector<Dataset> common_datasets(const Motion& motion) {
    const bool ring = motion.grid().axisymmetric();
    const char* axes = ring ? "(r, y, 0)" : "(x, y, 0)";
    std::vector<Dataset> sets;
    sets.push_back(vector_of(motion, {"position", "m", std::string("Current, ") + axes},
                             [](const PointRecord& r) { return r.position; }));
    sets.push_back(vector_of(motion, {"reference_position", "m", std::string("Initial, ") + axes},
                             [](const PointRecord& r) { return r.reference; }));
    sets.push_back(vector_of(
        motion, {"displacement", "m", "Position less reference position"}, [](const PointRecord& r) {
            return std::array<double, 2>{r.position[0] - r.reference[0], r.position[1] - r.reference[1]};
        }));
    sets.push_back(
        vector_of(motion, {"velocity", "m/s", axes}, [](const PointRecord& r) { return r.velocity; }));
    sets.push_back({{"stress", "Pa",
                     "Cauchy, tension positive, xx yy zz xy yz zx; axisymmetric: x = r, y axial, z hoop"},
                    6,
                    [&motion](double* out) {
                        each(motion, [&](int m, std::size_t slot, uint32_t id) {
                            for (int k = 0; k < 6; ++k)
                                out[6 * id + k] = motion.points()[m].columns().stress[k][slot];
                        });
                    }});
    sets.push_back({{"volume", "m^3", ring ? "Current, of the whole ring" : "Current, for 1 m of thickness"},
                    1,
                    [&motion](double* out) {
                        each(motion, [&](int m, std::size_t slot, uint32_t id) {
                            out[id] = motion.record(m, slot).volume;
                        });
                    }});
    sets.push_back(
        {{"material", "1", "Index into the scene's materials, in their order"}, 1, [&motion](double* out) {
             each(motion, [&](int m, std::size_t, uint32_t id) { out[id] = m; });
         }});
    return sets;
}

} // namespace

void check_states(const Scene& scene, const Motion& motion) {
    const std::vector<Dataset> common = common_datasets(motion);
    const std::vector<Material>& all = motion.materials();
    for (std::size_t m = 0; m < all.size(); ++m)
        for (const StateInfo& info : all[m].states()) {
            const auto refuse = [&](const std::string& why) {
                throw InputError(scene.materials[m].model.parameters.where,
                                 fmt::format("material '{}' has the state '{}'{}", all[m].name(),
                                             info.declared.name, why));
            };
            for (const Dataset& set : common)
                if (set.info.name == info.declared.name) refuse(", a dataset that every frame has already");
            for (std::size_t before = 0; before < m; ++before)
                if (const StateInfo* other = find_state(all[before], info.declared.name);
                    other && other->declared.shape != info.declared.shape)
                    refuse(fmt::format(" with {} components, material '{}' with {}", info.declared.shape,
                                       all[before].name(), other->declared.shape));
        }
}

std::vector<Dataset> frame_datasets(const Motion& motion) {
    std::vector<Dataset> sets = common_datasets(motion);
    for (std::size_t m = 0; m < motion.materials().size(); ++m)
        for (const StateInfo& info : motion.materials()[m].states()) {
            bool known = false;
            for (std::size_t before = 0; before < m; ++before)
                known |= find_state(motion.materials()[before], info.declared.name) != nullptr;
            if (!known) sets.push_back(state_of(motion, info.declared));
        }
    return sets;
}

PointArrays collect(const Motion& motion) {
    PointArrays a;
    const std::size_t n = motion.point_count();
    for (auto* group : {&a.position, &a.reference})
        for (auto& c : *group)
            c.resize(n);
    for (auto& c : a.stress)
        c.resize(n);
    a.volume.resize(n);
    a.material.resize(n);
    each(motion, [&](int m, std::size_t slot, uint32_t id) {
        const PointRecord r = motion.record(m, slot);
        for (int k = 0; k < 2; ++k) {
            a.position[k][id] = r.position[k];
            a.reference[k][id] = r.reference[k];
        }
        for (int k = 0; k < 6; ++k)
            a.stress[k][id] = motion.points()[m].columns().stress[k][slot];
        a.volume[id] = r.volume;
        a.material[id] = m;
    });
    return a;
}

std::vector<double> collect_state(const Motion& motion, const std::string& name) {
    bool found = false;
    for (const Material& material : motion.materials()) {
        const StateInfo* info = find_state(material, name);
        found |= info && info->declared.shape == GAULT_SCALAR;
    }
    if (!found) return {};
    std::vector<double> values(motion.point_count(), std::numeric_limits<double>::quiet_NaN());
    each(motion, [&](int m, std::size_t slot, uint32_t id) {
        const StateInfo* info = find_state(motion.materials()[m], name);
        if (info && info->declared.shape == GAULT_SCALAR)
            values[id] = motion.points()[m].columns().state[info->first][slot];
    });
    return values;
}

} // namespace gault::core
