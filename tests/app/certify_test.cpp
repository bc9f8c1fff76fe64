// `gault certify`: verdicts and exit status, what it takes and what it refuses; and that every shipped soil keeps its
// certificate.
#include "tests/app/child.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gault::test {
namespace {

const std::string wrong_soils = (build / "tests/certificate/wrong_soils.so").string(),
                  right_soils = (build / "tests/certificate/right_soils.so").string();

class Certify : public App {
  protected:
    Outcome certify(const std::string& plugin, Words more = {}) const {
        more.insert(more.begin(), {"certify", plugin});
        return gault(more);
    }
    void write(const std::string& file, const std::string& text) const { std::ofstream(work / file) << text; }
    nlohmann::json certificate(const std::string& file = "c.json") const {
        return nlohmann::json::parse(core::test::text_of(work / file));
    }
};

TEST_F(Certify, PrintsALineACheckAndTheVerdict) {
    const Outcome outcome =
        certify(right_soils, {"--model", "plain", "--only", "declaration", "--only", "rate"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const auto said = lines(outcome.out);
    ASSERT_EQ(said.size(), 4u) << outcome.out;
    EXPECT_EQ(said[0], "plain 1.0.0, " + right_soils);
    EXPECT_EQ(said[1], "pass  declaration  every unit is one, and every parameter and state has a sentence  "
                       "2 parameters and states");
    EXPECT_EQ(said[2],
              "pass  rate         the rate matters where that is declared                          none");
    EXPECT_EQ(said[3], "certified");
}

TEST_F(Certify, EndsWithThreeWhereACheckFails) {
    const Outcome outcome =
        certify(wrong_soils, {"--model", "too_soft", "--only", "modulus", "--json", "c.json"});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(outcome.out.ends_with("not certified\n")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "FAIL  modulus")) << outcome.out;
    EXPECT_EQ(certificate()["passed"], false);
    EXPECT_EQ(certificate()["checks"][0]["verdict"], "failed");
}

TEST_F(Certify, SurvivesASoilThatEndsTheProcessOrNeverDoes) {
    const Words increments = {"--only", "increments", "--time-limit", "0.5", "--model"};
    for (const auto& [model, figure] : {std::pair{"crashes", "crashed: "},
                                        {"exits", "ended the process with status 0"},
                                        {"hangs", "no end within 0.5 s"}}) {
        Words words = increments;
        words.emplace_back(model);
        const Outcome outcome = certify(wrong_soils, words);
        EXPECT_EQ(outcome.status, 3) << model;
        EXPECT_TRUE(has(outcome.out, figure)) << outcome.out;
    }
}

TEST_F(Certify, HasNoVerdictOnAnAxisOfItsOwnAlongY) {
    const Outcome outcome = certify(right_soils, {"--model", "fixed_axis", "--only", "objectivity"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(
        has(outcome.out,
            "\n-     objectivity  a rotated path gives the rotated result  has a fixed axis, y: off by 0."))
        << outcome.out;
    EXPECT_TRUE(has(outcome.out, "\ncertified\n")) << outcome.out;
}

TEST_F(Certify, LeavesACertificateInJson) {
    const Outcome outcome =
        certify("linear_elastic", {"--set", "young_modulus=20 MPa", "--set", "poisson_ratio=0.2", "--only",
                                   "bounds", "--json", "c.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto c = certificate();
    EXPECT_EQ(c["model"], "linear_elastic");
    EXPECT_TRUE(has(c["parameters"], "young_modulus: 20 MPa")) << c["parameters"];
    EXPECT_EQ(c["sha256"].get<std::string>().size(), 64u);
    EXPECT_EQ(c["initial_stress_Pa"][1], -100e3);
    EXPECT_EQ(c["passed"], true);
    EXPECT_EQ(c["checks"][0]["name"], "bounds");
    EXPECT_EQ(c["checks"][0]["verdict"], "passed");
}

TEST_F(Certify, TakesTheSoilAndItsStressFromAScene) {
    write("scene.yaml", R"(gault: 1
geometry: {annulus: {inner_radius: 20 mm, outer_radius: 200 mm, height: 20 mm}}
materials:
  soil: {model: linear_elastic, density: 1900 kg/m^3, young_modulus: 30 MPa, poisson_ratio: 0.3,
         pore_water: {initial_pressure: 40 kPa}}
initial: {stress: {isotropic: 150 kPa}}
boundaries: [{on: outer, type: pressure, value: 150 kPa}, {on: [top, bottom], type: roller}, {on: inner, type: wall}]
program: {type: pressuremeter, on: inner, rate: 1 mm/s, until: {cavity_strain: 1 %}}
)");
    const Words what = {"--with", "scene.yaml", "--only", "cavity", "--only", "batches", "--json", "c.json"};
    const Outcome outcome = certify("linear_elastic", what);
    EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    EXPECT_EQ(certificate()["initial_stress_Pa"][0], -110e3) << "effective";
    EXPECT_TRUE(has(certificate()["parameters"], "30 MPa"));
    Words set = what;
    set.insert(set.end(), {"--set", "materials.soil.young_modulus=60 MPa"});
    EXPECT_EQ(certify("linear_elastic", set).status, 0);
    EXPECT_TRUE(has(certificate()["parameters"], "60 MPa"));
    EXPECT_EQ(refusal(certify("tresca", what)), "no material of 'scene.yaml' has the model 'tresca'\n");
}

TEST_F(Certify, TakesTheSoilFromATestOfOnePoint) {
    write("test.yaml", "gault: 1\n"
                       "material: {model: linear_elastic, young_modulus: 13 MPa, poisson_ratio: 0.3}\n"
                       "initial: {stress: {xx: 40 kPa, yy: 80 kPa, zz: 40 kPa}}\n"
                       "test: [triaxial: {axial_strain: 1 %}]\n");
    const Outcome outcome =
        certify("linear_elastic", {"--with", "test.yaml", "--only", "retry", "--json", "c.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(certificate()["initial_stress_Pa"], nlohmann::json({-40e3, -80e3, -40e3, 0.0, 0.0, 0.0}));
    EXPECT_EQ(refusal(certify("tresca", {"--with", "test.yaml"})),
              "'test.yaml' is a test of 'linear_elastic', not of 'tresca'\n");
}

TEST_F(Certify, FindsAFileThroughALink) {
    fs::create_symlink(right_soils, work / "mine.so");
    const Outcome outcome = certify("mine.so", {"--model", "sand", "--only", "declaration"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("sand 1.0.0, " + right_soils)) << outcome.out;
}

TEST_F(Certify, RefusesInOneLine) {
    const std::string plugins = (build / "lib/gault/plugins").string();
    EXPECT_TRUE(has(refusal(certify("mohr_colomb")),
                    "no material model 'mohr_colomb'; did you mean 'mohr_coulomb'?"));
    EXPECT_TRUE(has(refusal(certify(right_soils, {"--model", "plan"})),
                    "no material model 'plan'; did you mean 'plain'?"));
    EXPECT_TRUE(has(refusal(certify(right_soils)), "holds 12 material models; choose one with --model"));
    EXPECT_TRUE(has(refusal(certify(plugins + "/wall.so")), "holds no material model"));
    EXPECT_TRUE(has(refusal(certify(plugins)), "is a folder: name a plugin's file, or a model"));
    EXPECT_TRUE(has(refusal(certify("./nothing.so")), "nothing.so"));
    EXPECT_TRUE(has(refusal(certify("tresca", {"--model", "tresca"})),
                    "--model chooses from a file; 'tresca' is a model"));
    EXPECT_TRUE(has(refusal(certify("tresca", {"--only", "tangents"})),
                    "no check 'tangents'; did you mean 'tangent'?"));
    const std::string missing = refusal(certify("linear_elastic", {"--set", "poisson_ratio=0.2"}));
    EXPECT_TRUE(has(missing, "young_modulus") && has(missing, "--with SCENE, or --set KEY=VALUE")) << missing;
    EXPECT_TRUE(
        has(refusal(certify("linear_elastic", {"--set", "young_modulus=20", "--set", "poisson_ratio=0.2"})),
            "'20' has no unit"));
    EXPECT_TRUE(has(refusal(certify("linear_elastic", {"--with", "nothing.yaml"})), "nothing.yaml"));
    EXPECT_TRUE(fs::is_empty(work)) << "writes nothing";
}

// ---- the shipped soils ----

bool holds_a_material(const fs::path& folder) {
    for (const auto& file : fs::directory_iterator(folder))
        if ((file.path().extension() == ".cpp" || file.path().extension() == ".hpp") &&
            has(core::test::text_of(file.path()), "#include <gault/material.hpp>"))
            return true;
    return false;
}

// Folders of plugins/, whose scene is of the material of the same name.
std::vector<std::string> shipped_soils() {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(repository / "plugins"))
        if (entry.is_directory() && holds_a_material(entry.path()))
            found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
}

class ShippedSoil : public Certify, public testing::WithParamInterface<std::string> {};

// Without random_walk, of a second to a minute, and speed, which has no verdict.
TEST_P(ShippedSoil, KeepsItsCertificate) {
    Words words = {"--with", (repository / "plugins" / GetParam() / "scene.yaml").string()};
    for (const char* check : {"declaration", "bounds", "batches", "threads", "increments", "retry", "rate",
                              "tangent", "step_size", "objectivity", "elastic_cycles", "modulus", "cavity"})
        words.insert(words.end(), {"--only", check});
    const Outcome outcome = certify(GetParam(), words);
    EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    EXPECT_EQ(lines(outcome.out).size(), 15u) << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(Repository, ShippedSoil, testing::ValuesIn(shipped_soils()),
                         [](const auto& test) { return test.param; });

// A plugin may hold a second model for another flag: umat_rate_dependent.
TEST_F(Certify, IsAskedForOfEveryMaterialThatIsListed) {
    const auto soils = shipped_soils();
    std::istringstream list(gault({"list"}).out);
    for (std::string kind, name, version, file; list >> kind >> name >> version >> file;)
        EXPECT_TRUE(kind != "material" ||
                    std::count(soils.begin(), soils.end(), fs::path(file).stem().string()))
            << name;
}

} // namespace
} // namespace gault::test
