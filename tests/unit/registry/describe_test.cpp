// The whole text that `gault describe` prints, one component of every kind.
#include "core/registry/registry.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

using namespace gault::core;

namespace {

gault_parameter parameter(gault_type type, const char* name, const char* unit, const char* doc) {
    gault_parameter p{};
    p.size = sizeof p;
    p.type = type;
    p.flags = GAULT_REQUIRED;
    p.name = name;
    p.symbol = "";
    p.unit = unit;
    p.doc = doc;
    p.min = -HUGE_VAL;
    p.max = HUGE_VAL;
    return p;
}

std::string described(gault_kind kind, const gault_parameter* const* parameters, const void* api) {
    gault_module m{};
    m.name = "kit";
    m.version = "0.3.0";
    m.author = "A. Author";
    m.license = "MIT";
    m.built_with = "";
    gault_component c{};
    c.kind = kind;
    c.name = "thing";
    c.version = "1.0.0";
    c.doc = "One sentence.";
    c.reference = "Author (2001)";
    c.parameters = parameters;
    c.api = api;
    return describe({&c, &m, "/plugins/kit.so"});
}

const gault_parameter* const no_parameters[] = {nullptr};

const std::string head = " thing 1.0.0\n"
                         "    One sentence.\n"
                         "    reference  Author (2001)\n"
                         "    module     kit 0.3.0, A. Author, MIT\n"
                         "    file       /plugins/kit.so\n";

} // namespace

TEST(Describe, ShowsEveryTypeOfParameterAndTheKindsOfRecords) {
    gault_parameter angle = parameter(GAULT_REAL, "angle", "rad", "An angle.");
    angle.symbol = "φ";
    angle.flags = GAULT_MAX_OPEN;
    angle.fallback = std::numbers::pi / 6.0;
    angle.min = 0.0;
    angle.max = std::numbers::pi / 2.0;
    const gault_parameter any = parameter(GAULT_REAL, "any", "1", "Any number.");
    gault_parameter cycles = parameter(GAULT_INTEGER, "cycles", nullptr, "How often.");
    cycles.flags = 0;
    cycles.fallback = 3.0;
    cycles.min = 1.0;
    gault_parameter smooth = parameter(GAULT_BOOLEAN, "smooth", "1", "Begins smoothly.");
    smooth.flags = 0;
    smooth.fallback = 1.0;
    gault_parameter side = parameter(GAULT_CHOICE, "side", "", "Which side.");
    const char* const sides[] = {"left", "right", nullptr};
    side.flags = 0;
    side.choices = sides;
    side.fallback = 1.0;
    gault_parameter label = parameter(GAULT_TEXT_VALUE, "label", "", "A label.");
    label.flags = GAULT_OPTIONAL;
    gault_parameter levels = parameter(GAULT_LIST, "levels", "Pa", "Levels.");
    levels.flags |= GAULT_MIN_OPEN;
    levels.min = 0.0;
    levels.min_count = 2;
    levels.max_count = 5;
    gault_parameter curve = parameter(GAULT_TABLE, "curve", "Pa", "A curve.");
    curve.x_unit = "s";
    curve.min_count = 2;
    gault_parameter phases = parameter(GAULT_RECORDS, "phases", nullptr, "In order.");
    const gault_parameter duration = parameter(GAULT_REAL, "duration", "s", "How long.");
    const gault_parameter pace = parameter(GAULT_REAL, "pace", "m/s", "How fast.");
    const gault_parameter* const move_parameters[] = {&duration, &pace, nullptr};
    const gault_record_kind move{sizeof(gault_record_kind), 0, "move", "Goes.", move_parameters};
    const gault_parameter* const hold_parameters[] = {&duration, nullptr};
    const gault_record_kind hold{sizeof(gault_record_kind), 0, "hold", "Waits.", hold_parameters};
    const gault_record_kind stop{sizeof(gault_record_kind), 0, "stop", "Ends.", no_parameters};
    const gault_record_kind* const kinds[] = {&move, &hold, &stop, nullptr};
    phases.kinds = kinds;
    phases.min_count = phases.max_count = 1;
    gault_parameter last = phases;
    last.name = "last";

    const gault_parameter* const all[] = {&angle,  &any,   &cycles, &smooth, &side,  &label,
                                          &levels, &curve, &phases, &last,   nullptr};
    const gault_boundary_api api{};
    const std::string text = described(GAULT_BOUNDARY, all, &api);
    const std::string expected = R"(
parameters
    name          symbol  unit  default   allowed                             meaning
    angle         φ       rad   30 deg    >= 0, < 90 deg                      An angle.
    any                   1     required  any number                          Any number.
    cycles                      3         whole number, >= 1                  How often.
    smooth                      true      true | false                        Begins smoothly.
    side                        right     left | right                        Which side.
    label                       optional  text                                A label.
    levels                Pa    required  list of numbers, > 0, 2 to 5        Levels.
    curve                 Pa    required  table [x in s, y], at least 2       A curve.
    phases                      required  list of the records below, exactly 1  In order.
      move:                                                                   Goes.
        duration          s     required  any number                          How long.
        pace              m/s   required  any number                          How fast.
      hold                s               any number                          Waits.
      stop:                                                                   Ends.
    last                        required  as `phases` above, exactly 1        In order.
)";
    // The widest cell sets the column: compare line by line, blank runs as one.
    const auto squeezed = [](std::string s) {
        std::string out;
        for (const char c : s)
            if (c != ' ' || out.empty() || out.back() != ' ') out += c;
        return out;
    };
    EXPECT_NE(squeezed(text).find(squeezed(expected)), std::string::npos) << text;
}

TEST(Describe, AlignsColumnsByCharactersAndLeavesEmptyOnesOut) {
    gault_parameter phi = parameter(GAULT_REAL, "phi", "rad", "An angle.");
    phi.symbol = "φ";
    gault_parameter a = parameter(GAULT_REAL, "a", "1", "A number.");
    a.symbol = "A";
    const gault_parameter* const both[] = {&phi, &a, nullptr};
    const gault_boundary_api api{};
    EXPECT_NE(described(GAULT_BOUNDARY, both, &api)
                  .find("\nparameters\n"
                        "    name  symbol  unit  default   allowed     meaning\n"
                        "    phi   φ       rad   required  any number  An angle.\n"
                        "    a     A       1     required  any number  A number.\n"),
              std::string::npos);
    phi.symbol = a.symbol = "";
    EXPECT_NE(described(GAULT_BOUNDARY, both, &api).find("    name  unit  default "), std::string::npos);
}

TEST(Describe, ShowsTheStatesAndWishesOfAMaterial) {
    const gault_state states[] = {
        {"wear", "1", "Wear.", GAULT_SCALAR, 0, 0.0, 0.0, 1.0},
        {"back_stress", "Pa", "Back stress.", GAULT_SYMMETRIC, 0, 0.0, -HUGE_VAL, HUGE_VAL}};
    const char* const inputs[] = {"density", "volume_ratio", nullptr};
    gault_material_api api{};
    api.states = states;
    api.state_count = 2;
    api.inputs = inputs;
    api.flags = GAULT_FINITE_STRAIN | GAULT_ONE_AT_A_TIME;
    EXPECT_EQ(described(GAULT_MATERIAL, no_parameters, &api),
              "material" + head +
                  "\nparameters: none\n"
                  "\nstates\n"
                  "    name         unit  shape             initial  from  to   meaning\n"
                  "    wear         1     scalar            0        0     1    Wear.\n"
                  "    back_stress  Pa    symmetric tensor  0        -inf  inf  Back stress.\n"
                  "\nasks the host for: density, volume_ratio\n"
                  "\ntangent: differentiated numerically by the host\n"
                  "\nkinematics: wants the deformation gradient\n"
                  "\nthreads: one call at a time\n");
}

TEST(Describe, ShowsTheControlsOfABoundary) {
    const gault_signal controls[] = {{"pressure", "Pa", "Pressure on the soil.", 100.0},
                                     {"velocity", "m/s", "Velocity.", std::nan("")}};
    gault_boundary_api api{};
    api.controls = controls;
    api.control_count = 2;
    api.load = [](const void*, gault_facets*, gault_error*) noexcept -> gault_status { return GAULT_OK; };
    EXPECT_EQ(described(GAULT_BOUNDARY, no_parameters, &api),
              "boundary" + head +
                  "\nparameters: none\n"
                  "\ncontrols\n"
                  "    name      unit  uncommanded  meaning\n"
                  "    pressure  Pa    100          Pressure on the soil.\n"
                  "    velocity  m/s   none         Velocity.\n"
                  "\nimposes: loads\n");
}

TEST(Describe, ShowsTheSignalsOfAProgram) {
    const gault_signal measures[] = {{"radius", "m", "Mean radius.", 0.0}};
    const gault_signal records[] = {{"strain", "1", "Strain.", 0.0}, {"force", "N", "Force.", 0.0}};
    gault_program_signals signals{};
    signals.measures = measures;
    signals.measure_count = 1;
    signals.records = records;
    signals.record_count = 2;
    gault_program_api api{};
    api.signals = &signals;
    EXPECT_EQ(described(GAULT_PROGRAM, no_parameters, &api), "program" + head +
                                                                 "\nparameters: none\n"
                                                                 "\nmeasures\n"
                                                                 "    name    unit  meaning\n"
                                                                 "    radius  m     Mean radius.\n"
                                                                 "\ncontrols: none\n"
                                                                 "\nrecords\n"
                                                                 "    name    unit  meaning\n"
                                                                 "    strain  1     Strain.\n"
                                                                 "    force   N     Force.\n");
}

TEST(Describe, ShowsTheResultsOfAnObserver) {
    const gault_signal results[] = {{"error", "1", "Relative error.", 0.0}};
    gault_observer_api api{};
    api.results = results;
    api.result_count = 1;
    EXPECT_EQ(described(GAULT_OBSERVER, no_parameters, &api), "observer" + head +
                                                                  "\nparameters: none\n"
                                                                  "\nmeasures: none\n"
                                                                  "\nresults\n"
                                                                  "    name   unit  meaning\n"
                                                                  "    error  1     Relative error.\n");
}
