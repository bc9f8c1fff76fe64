// The sections of a scene, in the order in which they are read: each may use what the ones before it have
// filled in. All throw InputError.
#pragma once
#include "core/config/fields.hpp"
#include "core/config/scene.hpp"

#include <optional>

namespace gault::core::config {

struct Source { // what every section reads from
    const Fields& root;
    const Registry& registry;
    std::filesystem::path folder; // that file names are relative to
};

void read_geometry(const Source& source, Scene& scene);
void read_model(const Source& source, Scene& scene); // model: symmetry, frame, solver
void read_grid(const Source& source, Scene& scene);
void read_parts(const Source& source, Scene& scene); // geometry.parts, which lie on the grid
void read_points(const Source& source, Scene& scene);
void read_materials(const Source& source, Scene& scene); // materials, regions, soil
// {model: NAME, ...}. `density`: of a soil that names none; nothing: it must.
MaterialUse read_material(const Node& node, const std::string& name, const std::string& path,
                          const Registry& registry, std::optional<double> density = {});
void read_gravity(const Source& source, Scene& scene);
void read_initial(const Source& source, Scene& scene);
void read_boundaries(const Source& source, Scene& scene);
void read_program(const Source& source, Scene& scene);
void read_solver(const Source& source, Scene& scene);
void read_output(const Source& source, Scene& scene);
void read_reference(const Source& source, Scene& scene);

// Notes what was left to the program: "model.frame: total (material stays in place)".
void note_choice(Scene& scene, const std::string& key, const std::string& value, const std::string& reason);

// The place among `words` of the one at `key`; that of `fallback`, noted with the reason, where the scene
// leaves it to the program.
std::size_t choose(Scene& scene, const Fields& fields, std::string_view key,
                   const std::vector<std::string>& words, std::size_t fallback, const std::string& reason);

// The same for an enumeration whose values are in the order of the words.
template <class Enum>
Enum choose(Scene& scene, const Fields& fields, std::string_view key, const std::vector<std::string>& words,
            Enum fallback, const std::string& reason) {
    return static_cast<Enum>(choose(scene, fields, key, words, static_cast<std::size_t>(fallback), reason));
}

// "r" or "x", and "y".
std::array<std::string, 2> axis_names(const Geometry& geometry);

// Centres of the cells along one axis, m.
std::vector<double> cell_centres(const Scene& scene, int axis);

// Knots of the grid along one axis, m.
std::vector<double> knots_along(const Scene& scene, int axis);

std::vector<std::string> surface_names(const Scene& scene);
int surface_index(const Node& node, const std::string& path, const Scene& scene);
double read_gauge(const Node& node, const Scene& scene); // of the program, once its surface is known

// An existing file, named relative to the scene's folder.
std::filesystem::path existing_file(const Node& node, const std::string& path,
                                    const std::filesystem::path& folder);

} // namespace gault::core::config
