// A test of one point, written as a file would be, and the table that it gives.
#pragma once
#include "core/config/reader.hpp"
#include "core/laboratory/element_test.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>

namespace gault::core::test {

inline const Registry& soils() {
    static const Registry registry = [] {
        std::vector<std::filesystem::path> files;
        for (const char* name :
             {"linear_elastic", "mohr_coulomb", "drucker_prager", "modified_cam_clay", "viscoelastic"})
            files.push_back(std::string(GAULT_BINARY_DIR "/lib/gault/plugins/") + name + ".so");
        return Registry(files);
    }();
    return registry;
}

// "{model: ...}", "{isotropic: 100 kPa}", and the list of stages; SI numbers out, compression positive.
inline ElementTest element(const std::string& soil, const std::string& stress, const std::string& stages,
                           const std::string& more = "") {
    return config::read_element_text("gault: 1\nmaterial: " + soil + "\ninitial: {stress: " + stress + more +
                                         "}\ntest: [" + stages + "]\n",
                                     "element.yaml", {}, soils());
}

struct Table {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
    std::vector<int64_t> iterations; // of each row
    int64_t updates = 0;
    std::optional<double> undrained_strength;
    std::string failure;

    std::size_t index(const std::string& name) const {
        for (std::size_t k = 0; k < names.size(); ++k)
            if (names[k] == name) return k;
        throw std::out_of_range("no column " + name);
    }
    std::vector<double> column(const std::string& name) const {
        std::vector<double> values;
        for (const auto& row : rows)
            values.push_back(row[index(name)]);
        return values;
    }
    double end(const std::string& name) const { return rows.back()[index(name)]; }
    double at_end_of(int stage, const std::string& name) const {
        double value = NAN;
        for (const auto& row : rows)
            if (row[index("stage")] == stage) value = row[index(name)];
        return value;
    }
    int64_t most_iterations() const { return *std::max_element(iterations.begin(), iterations.end()); }
};

inline Table carried_out(const ElementTest& test) {
    ElementRun run(test);
    Table table;
    for (const ColumnInfo& column : run.columns())
        table.names.push_back(column.name);
    int64_t before = 0;
    try {
        run.go([&](const std::vector<double>& row) {
            table.rows.push_back(row);
            table.iterations.push_back(run.iterations() - before);
            before = run.iterations();
        });
    } catch (const RunError& error) {
        table.failure = error.what();
    }
    table.updates = run.point().updates();
    table.undrained_strength = run.undrained_strength();
    return table;
}

inline Table carried_out(const std::string& soil, const std::string& stress, const std::string& stages) {
    return carried_out(element(soil, stress, stages));
}

constexpr double degree = std::numbers::pi / 180.0;

} // namespace gault::core::test
