// `gault element`: every test of the repository, the files and lines that it leaves, its refusals, and the point that a
// run kept.
#include "tests/app/child.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gault::test {
namespace {

std::vector<std::string> tests() {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(repository / "configs/element"))
        found.push_back(entry.path().stem().string());
    std::sort(found.begin(), found.end());
    return found;
}

class EveryElementTest : public App, public testing::WithParamInterface<std::string> {};

TEST_P(EveryElementTest, RunsAndIsDrawn) {
    const Outcome outcome = gault(
        {"element", (repository / "configs/element" / (GetParam() + ".yaml")).string(), "-o", "results"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto s = summary(results);
    EXPECT_EQ(s["status"], "done");
    const auto time = history(results, "time_s"), stage = history(results, "stage");
    EXPECT_EQ(time.size(), s["counts"]["steps"].get<std::size_t>() + 1);
    EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));
    EXPECT_EQ(stage.back(), s["counts"]["stages"]);
    EXPECT_GT(fs::file_size(results / "element.png"), 20000u);
    EXPECT_FALSE(fs::exists(results / "element.py.log"));
}

INSTANTIATE_TEST_SUITE_P(Repository, EveryElementTest, testing::ValuesIn(tests()),
                         [](const auto& test) { return test.param; });

class Element : public App {
  protected:
    Element() { write("triaxial: {axial_strain: 1 %, steps: 4, drainage: undrained}"); }

    void write(const std::string& stages, const std::string& more = "") const {
        std::ofstream(work / "t.yaml")
            << "gault: 1\n"
               "title: -t is no option\n"
               "material: {model: linear_elastic, young_modulus: 13 MPa, poisson_ratio: 0.3}\n"
               "initial: {stress: {isotropic: 100 kPa}}\n"
            << more << "test: [" << stages << "]\n";
    }
    Outcome element(Words more = {}) const {
        more.insert(more.begin(), {"element", "t.yaml", "-o", "results"});
        return gault(more);
    }
};

TEST_F(Element, LeavesATableASummaryAndAFigure) {
    const Outcome outcome = element();
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    const auto said = lines(outcome.err);
    ASSERT_EQ(said.size(), 3u) << outcome.err;
    EXPECT_EQ(said[0], "1 stages, 4 steps, 1 iterations");
    EXPECT_TRUE(has(said[1], " ns a point, ")) << said[1];
    EXPECT_EQ(said[2], "results in results");

    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(results))
        files.push_back(entry.path().filename());
    std::sort(files.begin(), files.end());
    EXPECT_EQ(files, (std::vector<std::string>{"element.png", "history.csv", "summary.json"}));

    const auto strain = history(results, "strain_yy");
    ASSERT_EQ(strain.size(), 5u);
    EXPECT_NEAR(strain[3], 0.0075, 1e-15);
    const double q = 0.01 * 3 * 5e6; // 3G
    EXPECT_NEAR(history(results, "pore_pressure_Pa").back(), q / 3, 1e-3);
    const auto s = summary(results);
    EXPECT_EQ(s["title"], "-t is no option");
    EXPECT_NEAR(s["undrained_strength_Pa"], q / 2, 1e-3);
    EXPECT_NEAR(s["peak"]["deviator_stress_Pa"], q, 1e-3);
    EXPECT_NEAR(s["end"]["mean_stress_Pa"], 100e3, 1e-3);
    EXPECT_EQ(s["end"]["time_s"], 1.0);
    EXPECT_EQ(s["counts"]["constitutive_updates"], 6); // at rest; first guess and correction; three more
    EXPECT_GT(s["nanoseconds_per_update"], 0.0);
    EXPECT_EQ(s["provenance"]["soil"], "linear_elastic");
    EXPECT_EQ(s["provenance"]["sha256"].get<std::string>().size(), 64u);
    EXPECT_TRUE(has(s["test"], "drainage: undrained"));
}

TEST_F(Element, KnowsItsOptions) {
    EXPECT_EQ(element({"-q", "--no-figure"}).err, "");
    EXPECT_FALSE(fs::exists(results / "element.png"));
    EXPECT_TRUE(has(
        refusal(element({"--no-figure"})),
        "'results' already holds results (summary.json): choose another folder, or --force to replace them"));
    ASSERT_EQ(element({"--force", "--no-figure", "--set", "test.0.triaxial.steps=7"}).status, 0);
    EXPECT_EQ(history(results, "time_s").size(), 8u);
    ASSERT_EQ(gault({"element", "t.yaml", "--no-figure"}).status, 0);
    EXPECT_TRUE(fs::exists(work / "out/t/summary.json"));
    const Outcome help = gault({"element", "--help"});
    for (const char* part :
         {"test FILE", "--set", "--output", "--force", "--no-figure", "--quiet", "docs/element.md"})
        EXPECT_TRUE(has(help.out, part)) << part;
    for (const std::string& line : lines(help.out))
        if (const auto begin = line.find("configs/"); begin != std::string::npos) {
            EXPECT_TRUE(fs::exists(repository / line.substr(begin))) << line;
        }
}

TEST_F(Element, RefusesWhatIsWrongAndWritesNothing) {
    const fs::path place = results;
    EXPECT_TRUE(refusal(element({"--set", "test.0.triaxial.axial_strian=1 %"}))
                    .starts_with("--set test.0.triaxial.axial_strian: unknown key 'axial_strian'"));
    EXPECT_TRUE(refusal(gault({"element", (repository / "configs/paper/fahey.yaml").string()}))
                    .ends_with("a test of one point has no geometry; a scene is for `gault run`\n"));
    write("triaxial: {axial_strain: 1 %}", "plugins: [nowhere]\n");
    EXPECT_TRUE(has(refusal(element()), "nowhere"));
    write("triaxial: {axial_strain: 1 %");
    EXPECT_TRUE(refusal(element()).starts_with("t.yaml:"));
    EXPECT_TRUE(has(refusal(gault({"element", "nothing.yaml"})), "nothing.yaml: no such file"));
    EXPECT_TRUE(has(refusal(gault({"element"})), "test is required; see `gault element --help`"));
    EXPECT_FALSE(fs::exists(place));
    write("triaxial: {axial_strain: 1 %}");
    EXPECT_TRUE(has(refusal(gault({"element", "t.yaml", "-o", "/dev/null/x"})),
                    "cannot write results in '/dev/null/x'"));
}

TEST_F(Element, ThatFailsKeepsItsRowsAndSaysWhy) {
    const std::string sand = "material={model: mohr_coulomb, young_modulus: 10 MPa, poisson_ratio: 0.3, "
                             "cohesion: 0, friction_angle: 30 deg}"; // bears 300 kPa
    write("triaxial: {axial_stress: 350 kPa, steps: 10}");
    const Outcome outcome = element({"--set", sand});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("error: stage 1 (triaxial), 80 % done: ")) << outcome.err;
    const auto s = summary(results);
    EXPECT_EQ(s["status"], "failed");
    EXPECT_EQ("error: " + s["message"].get<std::string>() + "\n", outcome.err);
    EXPECT_NEAR(history(results, "stress_yy_Pa").back(), 300e3, 1.0);
    EXPECT_TRUE(fs::exists(results / "element.png"));
}

TEST_F(Element, OfASoilThatRefusesItsStressEndsBeforeItBegins) {
    const Outcome outcome = element({"--set",
                                     "material={model: mohr_coulomb, young_modulus: 10 MPa, poisson_ratio: "
                                     "0.3, cohesion: 1 kPa, friction_angle: 30 deg}",
                                     "--set", "initial.stress={yy: 90 kPa}"});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_TRUE(outcome.err.starts_with("error: material 'mohr_coulomb': ")) << outcome.err;
    EXPECT_FALSE(fs::exists(results));
}

// "[1, 2]" behind `key: ` in a file
std::vector<double> numbers(const std::string& text, const std::string& key) {
    const std::size_t begin = text.find("  " + key + ": ") + key.size() + 4;
    std::string list = text.substr(begin, text.find('\n', begin) - begin);
    std::replace_if(
        list.begin(), list.end(), [](char c) { return c == '[' || c == ',' || c == ']' || c == 's'; }, ' ');
    std::istringstream stream(list);
    std::vector<double> values;
    for (double x; stream >> x;)
        values.push_back(x);
    return values;
}

class FailedPoint : public App, public testing::WithParamInterface<std::string> {};

// A soil that breaks after 7 ms: the call that failed fails again, and its parts that end earlier are answered elastically.
TEST_P(FailedPoint, IsAskedAgain) {
    const std::string plugins = (build / "tests/app/plugins").string();
    std::ofstream(work / "scene.yaml")
        << "gault: 1\ntitle: A column\ngeometry: {block: {width: 1 m, height: 1 m}}\n"
           "model: {symmetry: plane_strain, solver: explicit}\ngrid: {cells: [2, 2]}\n"
           "materials: {soil: {model: test_soil, density: 1800 kg/m^3, young_modulus: 10 MPa, poisson_ratio: "
           "0.25, "
           "breaks_after: 7 ms"
        << GetParam()
        << "}}\nboundaries: [{on: [left, right, bottom], type: roller}, {on: top, type: pressure}]\n"
           "program: {type: ramp, on: top, pressure: [[0 s, 0 kPa], [10 ms, 100 kPa]]}\n";
    const Outcome run = gault({"run", "scene.yaml", "-o", "results", "--plugin-path", plugins});
    ASSERT_EQ(run.status, 3);
    EXPECT_TRUE(has(run.err, "the soil broke")) << run.err;
    EXPECT_TRUE(has(run.err, "; its inputs: `gault element results/failed_point.yaml`")) << run.err;

    const Outcome again = gault({"element", "results/failed_point.yaml", "--plugin-path", plugins});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(again.err, "");
    const auto said = lines(again.out);
    ASSERT_EQ(said.size(), 9u) << again.out;
    EXPECT_TRUE(said[0].starts_with("A column: step ")) << said[0];

    const std::string file = core::test::text_of(results / "failed_point.yaml");
    const auto stress = numbers(file, "stress"), strain = numbers(file, "strain");
    const double time = numbers(file, "time").at(0), dt = numbers(file, "dt").at(0);
    ASSERT_GT(time, 7e-3);
    ASSERT_LE(time - dt, 7e-3);
    const double share[] = {1.0, 0.5, 0.25, 0.125, 1e-2, 1e-3, 0.0};
    for (std::size_t k = 0; k < 7; ++k) {
        std::istringstream line(said[k + 2]);
        double percent;
        std::string sign, status;
        line >> percent >> sign >> status;
        EXPECT_EQ(percent, 100 * share[k]);
        if (time - dt + share[k] * dt > 7e-3) {
            EXPECT_EQ(status, "FAILED");
            EXPECT_TRUE(said[k + 2].ends_with("the soil broke")) << said[k + 2];
            continue;
        }
        EXPECT_EQ(status, "OK");
        const double volumetric = 4e6 * (strain[0] + strain[1] + strain[2]); // lame = G = 4 MPa
        for (std::size_t i = 0; i < 6; ++i) {
            double answer;
            line >> answer;
            const double expected = stress[i] + share[k] * ((i < 3 ? volumetric : 0.0) + 8e6 * strain[i]);
            EXPECT_NEAR(answer, expected, 1e-5 * std::abs(expected) + 1e-12) << said[k + 2];
        }
        EXPECT_EQ(line.peek(), EOF) << "no state: " << said[k + 2];
    }
    EXPECT_FALSE(fs::exists(work / "out")) << "a replay writes nothing";
}

INSTANTIATE_TEST_SUITE_P(OfASoil, FailedPoint, testing::Values("", ", pore_water: {}"),
                         [](const auto& test) { return test.param.empty() ? "Drained" : "Undrained"; });

} // namespace
} // namespace gault::test
