// The file of a test: what is read, and every mistake in one line that says where, what, and what is allowed.
#include "tests/unit/laboratory/element.hpp"

namespace gault::core::test {
namespace {

const std::string soil = "material: {model: linear_elastic, young_modulus: 1 MPa, poisson_ratio: 0.2}\n";
const std::string start = "gault: 1\n" + soil + "initial: {stress: {isotropic: 1 kPa}}\n";

std::string answer(const std::string& text) {
    try {
        config::read_element_text(text, "t.yaml", {}, soils());
    } catch (const InputError& error) {
        return error.what();
    }
    return "read";
}
std::string answer_to_stage(const std::string& stage) {
    return answer(start + "test:\n- " + stage + "\n");
}

struct Mistake {
    const char *text, *answer; // the answer begins so
};
std::ostream& operator<<(std::ostream& stream, const Mistake& mistake) {
    return stream << mistake.text;
}
class StageMistake : public testing::TestWithParam<Mistake> {};
TEST_P(StageMistake, IsAnsweredWhereItStands) {
    const std::string found = answer_to_stage(GetParam().text),
                      wanted = std::string("t.yaml:5:") + GetParam().answer;
    EXPECT_TRUE(found.starts_with(wanted)) << "found:    " << found << "\nexpected: " << wanted;
    EXPECT_EQ(found.find('\n'), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(
    Element, StageMistake,
    testing::Values(
        Mistake{"triaxal: {axial_strain: 1 %}",
                "3: test.0: unknown kind 'triaxal'; did you mean 'triaxial'?"},
        Mistake{"triaxial",
                "3: test.0 must be a single {kind: {...}}; found 'triaxial'; allowed: isotropic, "},
        Mistake{"{oedometer: {axial_strain: 1 %}, cycle: {}}",
                "3: test.0 must be a single {kind: {...}}; found a map"},
        Mistake{"triaxial: {}",
                "13: test.0.triaxial needs one of: axial_strain, axial_stress, deviator_stress"},
        Mistake{"triaxial:", "3: test.0.triaxial has no value"},
        Mistake{
            "triaxial: {axial_strain: 1 %, axial_stress: 9 kPa}",
            "47: test.0.triaxial.axial_stress contradicts test.0.triaxial.axial_strain; write one of them"},
        Mistake{"triaxial: {axial_strian: 1 %}",
                "14: unknown key 'axial_strian' in test.0.triaxial; did you mean 'axial_strain'?"},
        Mistake{"triaxial: {axial_strain: 1 mm}", "28: test.0.triaxial.axial_strain: '1 mm'"},
        Mistake{"triaxial: {axial_strain: 2000 %}",
                "28: test.0.triaxial.axial_strain is '2000 %'; it must be at least -10 and at most 10"},
        Mistake{"triaxial: {axial_stress: 100}", "28: test.0.triaxial.axial_stress: '100' has no unit"},
        Mistake{"triaxial: {axial_stress: 9 kPa, drainage: undrained}",
                "28: test.0.triaxial.axial_stress is an effective stress, which an undrained test does not "
                "prescribe; "
                "write axial_strain or deviator_stress"},
        Mistake{"triaxial: {axial_strain: 1 %, radial_stress: 9 kPa, drainage: undrained}",
                "48: test.0.triaxial.radial_stress is an effective stress"},
        Mistake{"triaxial: {axial_strain: 1 %, drainage: undrianed}",
                "43: test.0.triaxial.drainage cannot be 'undrianed'; did you mean 'undrained'?"},
        Mistake{"oedometer: {axial_strain: 1 %, drainage: undrained}",
                "34: unknown key 'drainage' in test.0.oedometer"},
        Mistake{"isotropic: {stress: 9 kPa, volumetric_strain: 1 %}",
                "49: test.0.isotropic.volumetric_strain contradicts"},
        Mistake{"simple_shear: {shear_strain: held}",
                "32: test.0.simple_shear.shear_strain: 'held' is not a number"},
        Mistake{"true_triaxial: {axial_strain: 1 %}", "18: test.0.true_triaxial.b is missing"},
        Mistake{"true_triaxial: {b: 0.5}", "18: test.0.true_triaxial.axial_strain is missing"},
        Mistake{"true_triaxial: {axial_strain: 1 %, b: 1.5}",
                "41: test.0.true_triaxial.b is '1.5'; it must be at least 0"},
        Mistake{"true_triaxial: {axial_strain: 1 %, b: 0, hold: major_stress}",
                "50: test.0.true_triaxial.hold cannot be 'major_stress'; did you mean 'minor_stress'?"},
        Mistake{"mixed: {strain: {yy: 1 %}, stress: {xx: held}}",
                "10: test.0.mixed: zz has neither a strain nor a stress"},
        Mistake{"mixed: {strain: {yy: 1 %, xx: 0}, stress: {xx: held, zz: held}}",
                "50: test.0.mixed.stress.xx is prescribed already: strain or stress, not both"},
        Mistake{"mixed: {strain: {yx: 1 %}, stress: {xx: held}}",
                "20: unknown key 'yx' in test.0.mixed.strain; allowed: xx, yy, zz, xy, yz, zx"},
        Mistake{"mixed: {strain: {yy: 2000 %}, stress: {xx: held, zz: held}}",
                "24: test.0.mixed.strain.yy is '2000 %'"},
        Mistake{"mixed: {strain: {yy: keep}, stress: {xx: held, zz: held}}",
                "24: test.0.mixed.strain.yy: 'keep' is not"},
        Mistake{"oedometer: {axial_strain: 1 %, steps: 0}",
                "41: test.0.oedometer.steps is '0'; it must be at least 1"},
        Mistake{"oedometer: {axial_strain: 1 %, steps: 1.5}",
                "41: test.0.oedometer.steps must be a whole number"},
        Mistake{"oedometer: {axial_strain: 1 %, steps: 10000001}",
                "41: test.0.oedometer.steps is '10000001'"},
        Mistake{"oedometer: {axial_strain: 1 %, duration: 0 s}",
                "44: test.0.oedometer.duration is '0 s'; it must be more than 0 s"},
        Mistake{"cycle: {count: 0, stages: [oedometer: {axial_strain: 1 %}]}",
                "18: test.0.cycle.count is '0'; it must be at least 1"},
        Mistake{"cycle: {stages: [oedometer: {axial_strain: 1 %}]}",
                "10: test.0.cycle.count is missing (how often)"},
        Mistake{"cycle: {count: 3}", "10: test.0.cycle.stages is missing (a list of stages)"},
        Mistake{"cycle: {count: 3, stages: []}", "29: test.0.cycle.stages is empty"},
        Mistake{"cycle: {count: 3, stages: [odometer: {axial_strain: 1 %}]}",
                "30: test.0.cycle.stages.0: unknown kind 'odometer'; did you mean 'oedometer'?"},
        Mistake{"cycle: {count: 100001, stages: [oedometer: {axial_strain: 1 %, steps: 1}]}",
                "10: more than 100000 stages, cycles written out"},
        Mistake{"cycle: {count: 100001, stages: [oedometer: {axial_strain: 1 %}]}",
                "10: more than 10000000 steps in all"}));

class FileMistake : public testing::TestWithParam<Mistake> {};
TEST_P(FileMistake, IsAnsweredWhereItStands) {
    const std::string found = answer(GetParam().text), wanted = std::string("t.yaml:") + GetParam().answer;
    EXPECT_TRUE(found.starts_with(wanted)) << "found:    " << found << "\nexpected: " << wanted;
    EXPECT_EQ(found.find('\n'), std::string::npos);
}
#define SOIL "material: {model: linear_elastic, young_modulus: 1 MPa, poisson_ratio: 0.2}\n"
#define CLAY                                                                                                 \
    "material: {model: modified_cam_clay, critical_state_ratio: 1.2, compression_index: 0.15, "              \
    "swelling_index: 0.03, poisson_ratio: 0.278, critical_state_volume: 2.74, overconsolidation_ratio: "     \
    "1.5}\n"
#define TEST_LINE "test: {oedometer: {axial_strain: 1 %}}\n"
INSTANTIATE_TEST_SUITE_P(
    Element, FileMistake,
    testing::Values(
        Mistake{"gault: 1\n" TEST_LINE, "1:1: material is missing (the soil: {model: NAME, ...})"},
        Mistake{SOIL TEST_LINE, "1:1: gault is missing"},
        Mistake{"gault: 2\n" SOIL TEST_LINE, "1:8: gault is '2'; this program reads version 1"},
        Mistake{"gault: 1\n" SOIL, "1:1: the file needs one of: test, replay"},
        Mistake{"gault: 1\n" SOIL "test: []\n", "3:7: test is empty"},
        Mistake{"gault: 1\n" SOIL "tests: []\n", "3:1: unknown key 'tests'"},
        Mistake{"gault: 1\ngeometry: {block: {}}\n",
                "2:11: a test of one point has no geometry; a scene is for `gault run`"},
        Mistake{"gault: 1\nmaterial: {model: linear_elastik}\n" TEST_LINE,
                "2:19: no material is named 'linear_elastik'; did you mean 'linear_elastic'?"},
        Mistake{"gault: 1\nmaterial: {model: linear_elastic, young_modulus: 1 MPa, poisson_ratio: "
                "0.7}\n" TEST_LINE,
                "2:72: material.poisson_ratio is '0.7'"},
        Mistake{
            "gault: 1\nmaterial: {model: linear_elastic, young_modulus: 1 MPa, poisson_ratio: 0.2, "
            "pore_water: {}}\n" TEST_LINE,
            "2:89: material.pore_water has no place here: the stages of a test say `drainage: undrained`"},
        Mistake{"gault: 1\n" SOIL "initial: {stress: {isotropic: 1 kPa, yy: 2 kPa}}\n" TEST_LINE,
                "3:31: initial.stress.isotropic contradicts initial.stress.yy"},
        Mistake{"gault: 1\n" SOIL "initial: {stress: {rr: 1 kPa}}\n" TEST_LINE,
                "3:20: unknown key 'rr' in initial.stress"},
        Mistake{"gault: 1\n" SOIL "initial: {stress: [1 kPa]}\n" TEST_LINE,
                "3:19: initial.stress must be a map of keys; found a list"},
        Mistake{"gault: 1\n" SOIL "initial: {states: {void_ratio: 1}}\n" TEST_LINE,
                "3:20: unknown key 'void_ratio' in initial.states"},
        Mistake{"gault: 1\n" CLAY "initial: {states: {specific_volum: 2}}\n" TEST_LINE,
                "3:20: unknown key 'specific_volum' in initial.states; did you mean 'specific_volume'?"},
        Mistake{"gault: 1\n" CLAY "initial: {states: {specific_volume: [2, 3]}}\n" TEST_LINE,
                "3:37: initial.states.specific_volume has 2 values; it must have 1"},
        Mistake{"gault: 1\n" CLAY "initial: {states: {specific_volume: 0.5}}\n" TEST_LINE,
                "3:37: initial.states.specific_volume is '0.5'; it must be at least 1"},
        Mistake{"gault: 1\n" CLAY "initial: {states: {preconsolidation_pressure: 300}}\n" TEST_LINE,
                "3:47: initial.states.preconsolidation_pressure: '300' has no unit"},
        Mistake{"gault: 1\n" SOIL "characteristic_length: 0 m\n" TEST_LINE,
                "3:24: characteristic_length is '0 m'; it must be more than 0 m"},
        Mistake{"gault: 1\n" SOIL TEST_LINE "replay: {}\n",
                "4:9: replay contradicts test; write one of them"},
        Mistake{"gault: 1\n" SOIL "initial: {}\nreplay: {}\n",
                "3:10: initial has no place beside replay, which has its own"},
        Mistake{"gault: 1\n" SOIL "characteristic_length: 1 m\nreplay: {}\n",
                "3:24: characteristic_length has no place beside replay"},
        Mistake{"gault: 1\n" SOIL "replay: {}\n",
                "3:9: replay.stress is missing (six numbers, Pa, tension positive)"},
        Mistake{"gault: 1\n" SOIL "replay: {stress: [1, 2, 3], strain: [0, 0, 0, 0, 0, 0]}\n",
                "3:18: replay.stress has 3 values; it must have 6"},
        Mistake{"gault: 1\n" SOIL "replay: {stress: [0, 0, 0, 0, 0, 0], strain: [0, 0, 0, 0, 0, x]}\n",
                "3:62: replay.strain: 'x' is not a number"},
        Mistake{"gault: 1\n" SOIL
                "replay: {stress: [0, 0, 0, 0, 0, 0], strain: [0, 0, 0, 0, 0, 0], F_old: 1}\n",
                "3:66: unknown key 'F_old' in replay"},
        Mistake{"gault: 1\n" SOIL
                "replay: {stress: [0, 0, 0, 0, 0, 0], strain: [0, 0, 0, 0, 0, 0], inputs: {density: 1}}\n",
                "3:75: unknown key 'density' in replay.inputs"},
        Mistake{"gault: 1\n" CLAY
                "replay: {stress: [0, 0, 0, 0, 0, 0], strain: [0, 0, 0, 0, 0, 0], states: {v: 1}}\n",
                "3:75: unknown key 'v' in replay.states"},
        Mistake{"gault: 1\n" SOIL
                "replay: {stress: [0, 0, 0, 0, 0, 0], strain: [0, 0, 0, 0, 0, 0], dt: -1 s}\n",
                "3:70: replay.dt is '-1 s'; it must be at least 0 s"}));
#undef SOIL
#undef CLAY
#undef TEST_LINE

TEST(ElementFile, OfCyclesWithinCyclesHasAnEnd) {
    std::string stages = "oedometer: {axial_strain: 1 %}";
    for (int depth = 0; depth < 8; ++depth)
        stages = "cycle: {count: 1, stages: [" + stages + "]}";
    EXPECT_EQ(answer_to_stage(stages), "read");
    EXPECT_NE(answer_to_stage("cycle: {count: 1, stages: [" + stages + "]}")
                  .find(": cycles within cycles, more than 8 deep"),
              std::string::npos);
}

TEST(ElementFile, WritesCyclesOut) {
    const ElementTest test = element("{model: linear_elastic, young_modulus: 1 MPa, poisson_ratio: 0}", "{}",
                                     "cycle: {count: 2, stages: [isotropic: {stress: 2 kPa}, {cycle: {count: "
                                     "2, stages: {oedometer: {axial_strain: 1 %}}}}]},"
                                     "triaxial: {axial_strain: 1 %}");
    std::string labels;
    for (const ElementStage& stage : test.stages)
        labels += stage.label + " ";
    EXPECT_EQ(labels, "1.1 1.2.1 1.2.1 1.1 1.2.1 1.2.1 2 ");
}

TEST(ElementFile, IsReadAgainFromItsOwnText) {
    const std::string text = start + "title: 'a: test'\ntest:\n- triaxial: {axial_strain: 1 %}\n";
    const ElementTest test =
        config::read_element_text(text, "t.yaml", {{"test.0.triaxial.steps", "7"}}, soils());
    EXPECT_EQ(config::read_element_text(test.yaml, "t.yaml", {}, soils()).stages.at(0).steps, 7);
    EXPECT_EQ(test.title, "a: test");
    EXPECT_EQ(
        config::read_element_text(start + "test: {triaxial: {axial_strain: 1 %}}\n", "a/t.yaml", {}, soils())
            .title,
        "t");
}

TEST(ElementFile, OfAReplayNeedsNoWater) {
    ElementTest test;
    test.material.yaml = "{model: linear_elastic, young_modulus: 1 MPa, poisson_ratio: 0.2, density: 1800 "
                         "kg/m^3, pore_water: {}}";
    const ElementReplay call{
        {-1e5, -2e5, -1.0 / 3, 4, 5, 6}, {1e-3, 0, 0, 0, 0, 1e-300}, {}, {}, {}, {}, 1.5, 0.25};
    const ElementTest read = config::read_element_text(
        replay_yaml("a \"title\"\nof two lines: #", test.material, call), "t.yaml", {}, soils());
    EXPECT_EQ(read.title, "a \"title\"\nof two lines: #");
    EXPECT_FALSE(read.material.water);
    EXPECT_EQ(read.replay->stress, call.stress);
    EXPECT_EQ(read.replay->strain, call.strain);
    EXPECT_EQ(read.replay->time, 1.5);
    EXPECT_EQ(read.replay->dt, 0.25);
}

// A file that is damaged anywhere is read, or answered in one line that names a place in it.
void expect_kept_promise(const std::string& text) {
    const std::string said = answer(text);
    const bool kept = said == "read" || (said.starts_with("t.yaml:") &&
                                         said.find('\n') == std::string::npos && said.size() < 2000);
    ASSERT_TRUE(kept) << said << "\n" << text;
}

TEST(ElementFile, ThatIsDamagedAnywhereIsReadOrRefusedInOneLine) {
    const std::string text = start + R"(characteristic_length: 2 cm
test:
- isotropic: {stress: 2 kPa, steps: 3}
- mixed: {strain: {yy: 1 %, xy: held}, stress: {xx: 1 kPa, zz: held}, duration: 1 h}
- cycle: {count: 2, stages: [simple_shear: {shear_strain: -1 %, drainage: undrained}]}
)";
    ASSERT_EQ(answer(text), "read");
    for (std::size_t at = 0; at < text.size(); ++at) {
        expect_kept_promise(text.substr(0, at));
        expect_kept_promise(text.substr(0, at) + text.substr(at + 1));
        for (const char* damage :
             {"-", "{", "]", ":", "\n", "\t", "~", "'", "nan", "1e999", "&a ", "*a", "\xff"})
            expect_kept_promise(text.substr(0, at) + damage + text.substr(at));
    }
}

} // namespace
} // namespace gault::core::test
