// A test of one material point, for `gault element`.
#pragma once
#include "core/config/scene.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

// strain . (strain since the stage began) + stress . (stress now) goes in equal parts from what it is when the stage
// begins to `end`; nothing: it stays. Components xx yy zz xy yz zx, tension positive, tensor shear; Pa.
struct Constraint {
    std::array<double, 6> strain{}, stress{};
    std::optional<double> end;
};

struct ElementStage {
    std::string kind, label; // "triaxial"; "2", or "3.1" within a cycle, as counted in the file
    std::array<Constraint, 6> constraints;
    int steps = 100;
    double duration = 1.0; // s
    // No water leaves or enters: the sum of normal stresses, with weights of sum 1, that stays as total stress. The
    // pore pressure follows from it.
    std::optional<std::array<double, 3>> undrained;
};

// One call of the model as a run made it, SI, tension positive, tensor shear.
struct ElementReplay {
    std::array<double, 6> stress{}, strain{}; // at the start; increment
    std::map<std::string, std::vector<double>> states, inputs;
    std::optional<std::array<double, 9>> F_old, F_new; // row-major
    double time = 0.0, dt = 1.0;                       // at the end of the step
};

struct ElementTest {
    std::string title, yaml; // as run
    std::filesystem::path file;
    MaterialUse material;
    std::array<double, 6> stress{};                    // initial, tension positive
    std::map<std::string, std::vector<double>> states; // instead of what the soil starts with; SI
    double characteristic_length = 0.01;               // m, of a cell, for soils that ask for it
    std::vector<ElementStage> stages;                  // cycles written out
    std::optional<ElementReplay> replay;               // instead of stages
};

// The file that asks the model again, for read_element_test.
std::string replay_yaml(const std::string& title, const MaterialUse& material, const ElementReplay& call);

constexpr int most_element_steps = 10'000'000, most_element_stages = 100'000; // in a test

// Throws InputError (file:line:column: what, what is allowed, the nearest right name).
ElementTest read_element_test(const std::filesystem::path& file, const std::vector<Override>& overrides,
                              const Registry& registry);

} // namespace gault::core
