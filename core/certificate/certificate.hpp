// Runs a soil model through the contract and through physics: what a modeller, or whoever relies on the model, wants to
// know before the first scene.
#pragma once
#include "core/config/scene.hpp"
#include "core/laboratory/point_batch.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gault::core {

struct Subject {              // of a certificate
    const Registry& registry; // with what the cavity needs beside the soil
    const MaterialUse& use;
    Tensor stress;                     // initial, Pa, tension positive
    std::filesystem::path cavity = {}; // a scene of one, whose material `soil` the model takes the place of
    const MaterialUse* yardstick = nullptr; // linear elasticity, for the cost of a point
    double time_limit = 300.0;              // of a check, s
};

struct Finding {
    enum class Verdict { passed, failed, left_out };
    Verdict verdict = Verdict::passed;
    std::string figure; // what was measured, in a line
};

struct Check {
    const char* name;
    const char* statement; // what holds where it is passed
    Finding (*run)(const Subject&);
};

const std::vector<Check>& all_checks();

struct CheckResult {
    const Check* check;
    Finding finding;
    double seconds;
};

// Each check in a process of its own, so that one that crashes or never ends is a failed one. `only`: names; empty: all.
std::vector<CheckResult> certify(const Subject& subject, const std::vector<std::string>& only);

bool passed(const std::vector<CheckResult>& results);
std::string certificate_table(const std::vector<CheckResult>& results);
nlohmann::json certificate_json(const Subject& subject, const std::vector<CheckResult>& results);

} // namespace gault::core
