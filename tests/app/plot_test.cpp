// `gault plot`: the picture of a run, where it goes, and its refusals.
#include "tests/app/child.hpp"

namespace gault::test {
namespace {

class Plot : public App {};

TEST_F(Plot, DrawsARunAndPrintsItsNumbers) {
    run("configs/paper/fahey_auto.yaml");
    const Outcome beside = gault({"plot", "results"});
    ASSERT_EQ(beside.status, 0) << beside.err;
    EXPECT_TRUE(has(beside.out, "Peak pressure: 627.9")) << beside.out;
    EXPECT_GT(fs::file_size(results / "plot.png"), 20000u);
    const Outcome named = gault({"plot", "results", "-o", "-p.png", "--measured", "655"});
    ASSERT_EQ(named.status, 0) << named.err;
    EXPECT_GT(fs::file_size(work / "-p.png"), 20000u);
}

TEST_F(Plot, RefusesWhatNoRunWrote) {
    EXPECT_EQ(refusal(gault({"plot", "nowhere"})),
              "'nowhere' holds no history.csv; name the folder that `gault run` wrote\n");
    EXPECT_TRUE(fs::is_empty(work));
}

} // namespace
} // namespace gault::test
