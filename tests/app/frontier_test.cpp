// gault frontier: a study run as a user does, and its tables.
#include "tests/app/child.hpp"

#include <algorithm>
#include <fstream>

namespace gault::test {
namespace {

class Frontier : public App {
  protected:
    Outcome frontier(const std::string& text, Words more = {}) const {
        std::ofstream(work / "study.yaml")
            << "gault: 1\nscene: " + (repository / "configs/paper/fahey_auto.yaml").string() + "\n" + text;
        Words words{"frontier", "study.yaml", "-o", "results", "--repeat", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return gault(words);
    }
    nlohmann::json written() const {
        std::ifstream stream(results / "frontier.json");
        return nlohmann::json::parse(stream);
    }
};

TEST_F(Frontier, MeasuresErrorsTheirOrderAndTheFront) {
    const Outcome outcome = frontier("families:\n  - name: cells\n    vary: {grid.cells: [12, 24, 48]}\n");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto all = written();
    EXPECT_EQ(all["errors"], (nlohmann::json{"true_pressure", "sigma_r_l2", "sigma_theta_l2"}));
    EXPECT_EQ(all["against"], "the scene's reference");
    const auto& members = all["families"][0]["members"];
    ASSERT_EQ(members.size(), 3u);
    for (const auto& member : members) {
        EXPECT_EQ(member["status"], "done");
        EXPECT_GT(member["wall_seconds"]["median"], 0.0);
        EXPECT_GT(member["peak_memory_bytes"], 1e6);
        EXPECT_GT(member["constitutive_updates"], 100);
    }
    // linear cells with one point: the pressure is of second order
    EXPECT_NEAR(members[2]["orders"]["true_pressure"].get<double>(), 2.0, 0.3);
    EXPECT_TRUE(members[2]["front"]["true_pressure"]) << "nothing is nearer than the finest";
    std::ifstream stream(results / "frontier.csv");
    std::vector<long> cells; // of the header, then of the rows
    for (std::string line; std::getline(stream, line);)
        cells.push_back(std::count(line.begin(), line.end(), ','));
    EXPECT_EQ(cells, std::vector<long>(4, cells.at(0)));
    EXPECT_NE(outcome.out.find("cells 48"), std::string::npos);
    EXPECT_GT(fs::file_size(results / "frontier.png"), 10000u);
}

// What the extrapolated curve says of coarse grids is what the exact one does.
TEST_F(Frontier, ExtrapolatesWhereThereIsNoReference) {
    const auto errors = [&](const std::string& reference, const char* name) {
        const Outcome outcome =
            frontier("set: {program.row_strain: 0.5 %" + reference +
                         "}\ncurve: {x: cavity_strain, y: true_pressure_Pa}\n"
                         "families:\n  - name: cells\n    vary: {grid.cells: [12, 24, 48, 96]}\n",
                     {"--force"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const auto all = written();
        std::vector<double> found;
        for (const auto& member : all["families"][0]["members"])
            found.push_back(member["errors"][name]);
        return found;
    };
    const auto exact = errors("", "true_pressure"), estimated = errors(", reference: {}", "true_pressure_Pa");
    EXPECT_NE(written()["against"].get<std::string>().find("Richardson"), std::string::npos);
    for (int k = 0; k < 2; ++k) {
        EXPECT_LT(estimated[k], 2.0 * exact[k]);
        EXPECT_GT(estimated[k], 0.5 * exact[k]);
    }
}

TEST_F(Frontier, KeepsAMemberThatFails) {
    const Outcome outcome =
        frontier("set: {model.symmetry: axisymmetric, model.solver: explicit, grid.cells: [12, 1], "
                 "points.per_cell: 4}\n"
                 "families:\n  - name: steps\n    vary: {solver: [{mass_scaling: 900}, "
                 "{mass_scaling: 900, time_step_factor: 1.9}]}\n");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json members = written()["families"][0]["members"];
    EXPECT_EQ(members[0]["status"], "done");
    EXPECT_EQ(members[1]["status"], "failed");
    EXPECT_NE(members[1]["message"].get<std::string>().find("step"), std::string::npos);
}

TEST_F(Frontier, RefusesAWrongMemberAndAFolderInUse) {
    EXPECT_NE(refusal(frontier("families:\n  - name: a\n    vary: {grid.cels: [12]}\n")).find("grid.cels"),
              std::string::npos);
    ASSERT_EQ(frontier("families:\n  - name: a\n    vary: {grid.cells: [12]}\n", {"--force"}).status, 0);
    EXPECT_NE(refusal(frontier("families:\n  - name: a\n")).find("--force"), std::string::npos);
}

TEST_F(Frontier, OfASceneRefinesItAndItsAccuracy) {
    const Outcome outcome = gault({"frontier", (repository / "configs/paper/case2_auto.yaml").string(), "-o",
                                   "results", "--repeat", "1"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto all = written();
    EXPECT_EQ(all["families"].size(), 2u);
    EXPECT_EQ(all["families"][1]["members"].size(), 5u);
    for (const auto& family : all["families"])
        for (const auto& member : family["members"])
            EXPECT_EQ(member["status"], "done") << member.dump();
}

} // namespace
} // namespace gault::test
