// A scene as the program sees it: every value in SI, every name resolved, every default filled in.
#pragma once
#include "core/base/error.hpp"
#include "core/registry/parameters.hpp"
#include "core/registry/registry.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

// Radial: a metre of height, nothing varies along it.
enum class Symmetry { radial, axisymmetric, plane_strain };
enum class Frame { total, updated };
enum class Basis { linear, quadratic };
enum class Placement { uniform, gauss };
enum class StressUpdate { usl, usf };
enum class SolverKind { explicit_dynamics, quasi_static };
enum class VolumetricStrain { pointwise, cell_mean };

// An axis-aligned rectangle in (r, y) or (x, y).
struct Geometry {
    std::string kind;                   // annulus | cylinder | block
    std::array<double, 2> lower, upper; // m
    bool open_ended = false;            // the outer radius was left open
    Location where;
};

// A side, or the part of one that lies between two knots of the grid.
struct SurfaceUse {
    std::string name;
    int side;
    std::optional<std::array<int, 2>> cells; // of a part: [first, last) along the side
};
constexpr std::size_t most_parts = 48; // in a scene

struct GridAxis {
    int cells;
    double ratio; // of neighbouring cells, high side over low side; 1 is uniform
};

struct ComponentUse { // a component named in the scene, with its parameters
    const Component* component;
    Parameters parameters;
};

struct PoreWater {          // that neither leaves nor enters
    double stiffness = 0.0; // bulk modulus over porosity, Pa
    double pressure = 0.0;  // at the start, Pa, compression positive
};

struct MaterialUse {
    std::string name;
    ComponentUse model;
    double density;                 // kg/m^3, initial
    std::optional<PoreWater> water; // the soil is undrained; its model bears the effective stress
    std::string yaml;               // as written, with what a region overrides
};

struct CellRange { // cells [first, last) along each axis
    std::array<int, 2> first, last;
};

struct Region { // later regions win
    std::string name;
    int material;                                // index into Scene::materials
    CellRange cells;                             // whose centres it holds; at least one
    std::array<std::array<double, 2>, 2> extent; // as written, within the grid: of x or r, of y; m
    Location where;
};

// Compression positive, as written: isotropic, or vertical and k0, horizontal = k0 * vertical. With gravity
// the vertical stress grows with depth:
//     vertical(y) = vertical + density * g * depth + sum of density * g over the soil between y and the top
struct InitialStress {
    double vertical = 0.0; // Pa, at `depth` above the top surface (a surcharge)
    double k0 = 1.0;
    double depth = 0.0;   // m, of the top surface below the ground
    bool gravity = false; // the stress follows the weight of the soil
    Location where;
};

struct Choice {                     // of a value that the scene left open
    std::string key, value, reason; // "model.frame", "total", "material stays in place"
};

struct BoundaryUse {
    std::vector<int> surfaces; // indices into Scene::surfaces
    ComponentUse model;
    bool chosen = false; // not in the scene: it stands for the soil beyond a radius that was left open
};

struct SolverSettings {
    SolverKind kind = SolverKind::explicit_dynamics;
    std::string dynamic_key; // a key of the scene that only the explicit solver heeds; empty: there is none
    // quasi-static
    double strain_step = 0.005; // largest strain component of a step that is aimed at
    double tolerance = 1e-6;    // forces out of balance over their change in a step
    double uneven = 1e-3;       // of the way so far: how far a step may miss the motion of the one before it,
                                // where the soil's answer depends on the rate
    // explicit
    double time_step_factor = 0.9; // of the true limit 2 / omega_max
    double damping = 0.0;          // Cundall's local coefficient, 0 <= alpha < 1
    double viscosity = 0.1;        // viscous stress over the elastic stress, both of a step's strain
    double mass_scaling = 1.0;
    StressUpdate stress_update = StressUpdate::usl;
};

// Frames are written when `measure` (a column of the history, or "time") reaches each value.
struct FrameRequest {
    std::string measure; // "" : only the last state
    std::vector<double> values;
};

struct CurveReference { // the history against a file of two columns
    std::string x, y;   // columns of the history, without the unit
    std::filesystem::path file;
    double from, to; // range of x compared
    // Range of x for the RMS about a cubic fit of the run's own curve.
    std::optional<std::array<double, 2>> noise;
    Location where;
};

struct ProfileReference { // radial profiles of the raw point stress at frames
    std::string measure;
    struct At {
        double value;
        std::filesystem::path file;
    };
    std::vector<At> at;
};

struct PalmerReference {    // the history and profiles of a cavity in a soil that keeps its volume
    std::string x, y;       // columns of the history: cavity strain, true pressure
    double from, to;        // range of x compared
    std::vector<double> at; // values of x whose profiles are compared
    Location where;
};

struct Scene {
    std::string title;
    std::string yaml; // as run, with every --set applied
    std::filesystem::path file;

    Symmetry symmetry;
    bool symmetry_open; // left open: `symmetry` is what is taken for the time being
    Frame frame;
    VolumetricStrain volumetric_strain;
    Basis basis;
    Geometry geometry;
    // The sides, low x, high x, low y, high y, then the parts. annulus: inner outer bottom top; cylinder: axis
    // outer bottom top; block: left right bottom top.
    std::vector<SurfaceUse> surfaces;
    std::array<double, 2>
        height; // of the body as written, from and to, m; in radial symmetry the grid has one of 1 m
    std::array<GridAxis, 2> axes;
    int points_per_cell; // a square number; in radial symmetry any, along the radius
    Placement placement;
    std::size_t points() const {
        return static_cast<std::size_t>(axes[0].cells) * static_cast<std::size_t>(axes[1].cells) *
               static_cast<std::size_t>(points_per_cell);
    }

    std::vector<MaterialUse> materials;
    int base_material; // of the soil outside every region
    std::vector<Region> regions;
    std::array<double, 2> gravity; // m/s^2
    InitialStress initial_stress;
    std::vector<BoundaryUse> boundaries;
    std::optional<int> program_surface;
    std::optional<double> program_gauge; // m, along that surface: where it is measured instead of in the mean
    ComponentUse program;
    SolverSettings solver;

    FrameRequest frames;
    std::vector<CurveReference> curves;
    std::vector<ProfileReference> profiles;
    std::optional<PalmerReference> palmer;
    struct ObserverUse {
        std::optional<int> surface;
        ComponentUse model;
    };
    std::vector<ObserverUse> observers;

    double accuracy = 0.005; // relative, that what is left open is chosen for

    std::vector<Choice> chosen; // what was left open, and what it was taken for
};

struct Override { // --set KEY=VALUE: dots for maps, numbers for list items
    std::string key, value;
};

// The `plugins:` of a scene, relative to its folder, read first so that the registry can be made.
std::vector<std::filesystem::path> scene_plugins(const std::filesystem::path& file,
                                                 const std::vector<Override>& overrides);

// Throws InputError (file:line:column: what, what is allowed, the nearest right name).
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 const Registry& registry);

} // namespace gault::core
