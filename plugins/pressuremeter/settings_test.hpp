// What the tests of this folder share: the plugin as a scene sets it.
#pragma once
#include "program_fixture.hpp"

namespace plugin_test {

inline std::vector<Record> until(double cavity_strain) {
    return {{"cavity_strain", {{"value", cavity_strain}}}};
}

inline Component program(Settings settings) {
    settings.try_emplace("until", until(0.1));
    return {"pressuremeter", GAULT_PROGRAM, "pressuremeter", settings};
}

constexpr double a0 = 0.02, height = 0.2; // m

} // namespace plugin_test
