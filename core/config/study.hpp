// A study: one scene, run with families of settings, for `gault frontier`.
#pragma once
#include "core/config/scene.hpp"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

struct Study {
    struct Measure { // of a run: JSON pointers (RFC 6901) into its results; of several the largest counts
        std::string name;
        std::vector<std::string> places;
    };
    struct Member {
        std::string label; // what distinguishes it in its family: "cells [72, 1]"
        std::vector<Override> set;
        int threads = 0; // 0: as many as pay
        // The number that is varied, of several the first; NaN where there is none. Orders are those of an
        // error over it.
        double size = std::numeric_limits<double>::quiet_NaN();
    };
    struct Family {
        std::string name;
        std::vector<Override> set; // of all its members, beside their own
        std::vector<Member> members;
    };

    std::string title;
    std::filesystem::path scene;
    int repeat = 3;
    std::optional<std::vector<Measure>> errors;      // not given: all that the scene's reference gives
    std::vector<Measure> values;                     // beside the errors
    std::optional<std::array<std::string, 2>> curve; // columns x, y of the history, kept for drawing
    std::vector<Family> families;
};

// Whether the file has the keys of a study; else it may be a scene. InputError: it is not a YAML map.
bool is_study(const std::filesystem::path& file);

Study read_study(const std::filesystem::path& file); // InputError

} // namespace gault::core
