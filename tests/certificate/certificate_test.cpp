// Every check fails the soil that is wrong in what it looks at, says what is wrong, and lets right soils pass.
#include "core/certificate/certificate.hpp"
#include "core/config/sample.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gault::core {
namespace {

const Registry& soils() {
    const std::string plugins = GAULT_BINARY_DIR "/lib/gault/plugins/";
    static const Registry registry({SOILS_DIR "/wrong_soils.so", SOILS_DIR "/right_soils.so",
                                    plugins + "pressure.so", plugins + "fixity.so", plugins + "wall.so",
                                    plugins + "pressuremeter.so"});
    return registry;
}

// Without the walk, which takes a second, and the speed, which is no verdict.
const std::vector<std::string> quick = {"declaration", "effect",    "bounds",  "batches", "threads",   "increments",
                                        "retry",          "rate",    "tangent", "step_size", "objectivity",
                                        "elastic_cycles", "modulus", "cavity"};

class Certificate {
  public:
    Certificate(const std::string& soil, const std::vector<std::string>& only, double time_limit = 60.0) {
        const MaterialUse use = material_from(soil, {}, soils());
        Subject subject{soils(),
                        use,
                        {-100e3, -100e3, -100e3, 0.0, 0.0, 0.0},
                        GAULT_SOURCE_DIR "/configs/certificate/cavity.yaml"};
        subject.time_limit = time_limit;
        results_ = certify(subject, only);
    }
    std::vector<std::string> with(Finding::Verdict verdict) const {
        std::vector<std::string> names;
        for (const CheckResult& result : results_)
            if (result.finding.verdict == verdict) names.emplace_back(result.check->name);
        return names;
    }
    std::string figure(const std::string& check) const {
        for (const CheckResult& result : results_)
            if (check == result.check->name) return result.finding.figure;
        return "";
    }
    std::string table() const { return certificate_table(results_); }

  private:
    std::vector<CheckResult> results_;
};

struct Wrong {
    const char* soil;
    std::vector<std::string> fails; // the first is the one that looks for it
    const char* says;
    std::vector<std::string> only = quick;
    double time_limit = 60.0; // s
};

class WrongSoil : public testing::TestWithParam<Wrong> {};

TEST_P(WrongSoil, FailsWhatLooksForIt) {
    const Wrong& wrong = GetParam();
    const Certificate certificate(wrong.soil, wrong.only, wrong.time_limit);
    std::vector<std::string> fails = certificate.with(Finding::Verdict::failed), expected = wrong.fails;
    std::sort(fails.begin(), fails.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(fails, expected) << certificate.table();
    const std::string figure = certificate.figure(wrong.fails[0]);
    EXPECT_NE(figure.find(wrong.says), std::string::npos) << figure;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) // which turn the signal into an exit
constexpr const char* null_pointer = "ended the process with status";
#else
constexpr const char* null_pointer = "crashed: Segmentation fault";
#endif

const Wrong wrongs[] = {
    {"undocumented",
     {"declaration"},
     "state 'work': no unit 'kJo/m^3'; state 'work': 'Of the past' is no sentence"},
    {"forgets_a_state", {"effect"}, "state 'plastic_strain' never changes"},
    {"crashes_at_bound", {"bounds"}, "crashed: Aborted"},
    {"fails_at_bound",
     {"bounds"},
     "'extra' = 1, within its bounds, is answered with status 3 and names no parameter"},
    {"silent_at_bound", {"bounds"}, "'extra' = 1"},
    {"nan_at_bound", {"bounds"}, "'extra' = 1: a strain of 0 is answered, and not with numbers"},
    {"one_for_all", {"bounds"}, "an instance with other values changes the results of this one"},
    {"by_position", {"batches"}, "shuffled: a point comes to another result, by"},
    {"by_neighbour", {"batches", "increments"}, "shuffled"},
    {"by_padding", {"batches"}, "padded with other points"},
    {"by_order", {"batches", "increments"}, "shuffled"},
    {"by_calls", {"batches", "bounds", "increments"}, "a second time"},
    {"leaves_states", {"batches"}, "with other values in its outputs before"},
    {"wants_moduli", {"batches", "cavity"}, null_pointer},
    {"tangent_on_the_way", {"batches", "cavity"}, "asked for its tangent: a point comes to another result"},
    {"shared_scratch", {"threads"}, "come to another result"},
    {"creeps_at_rest", {"increments"}, "no strain: the stress creeps"},
    {"swallows_nan", {"increments"}, "NaN for xx: a finite stress"},
    {"overflows", {"increments"}, "a strain of 1000: an answer that is not finite"},
    {"divides_by_time", {"increments", "cavity"}, "no strain, over 0 s: an answer that is not finite"},
    {"hangs", {"increments"}, "no end within 0.5 s", {"increments", "retry"}, 0.5},
    {"crashes", {"increments"}, "crashed: Aborted"},
    {"exits", {"increments"}, "ended the process with status 0"},
    {"suggests_more", {"retry"}, "suggests 2 of the step"},
    {"retries_for_ever",
     {"retry", "step_size"},
     "is not answered in 1024 parts",
     {"increments", "retry", "step_size"}},
    {"undeclared_rate", {"rate"}, "not declared; 40 of 40 points differ"},
    {"ages", {"rate", "cavity"}, "not declared"},
    {"elastic_tangent", {"tangent"}, "of the modulus"},
    {"transposed_tangent", {"tangent"}, "of the modulus"},
    {"engineering_tangent", {"tangent"}, "of the modulus"},
    {"nan_tangent", {"tangent", "cavity"}, "an entry that is not finite"},
    {"hardens_by_step", {"step_size", "cavity"}, "order"},
    {"looks_at_xx", {"objectivity"}, "off by"},
    {"undeclared_vector", {"objectivity"}, "(state '"},
    {"never_spins", {"objectivity"}, "when the body turns in the step"},
    {"gives_work", {"elastic_cycles"}, "work at most"},
    {"leaves_its_bounds", {"random_walk"}, "state 'damage' is 1", {"random_walk"}},
    {"too_soft", {"modulus"}, "needs 1.1111 in"},
    {"too_soft_in_flow", {"modulus"}, "report as much there", {"modulus"}},
    {"refuses_to_start",
     {"speed", "batches", "cavity"},
     "the initial stress is none of tension",
     {"declaration", "batches", "cavity", "speed"}},
};

template <class Case>
std::string soil_of(const testing::TestParamInfo<Case>& info) {
    return info.param.soil;
}

INSTANTIATE_TEST_SUITE_P(All, WrongSoil, testing::ValuesIn(wrongs), soil_of<Wrong>);

struct Right {
    const char* soil;
    std::vector<std::string> no_verdict; // checks
    const char *check, *says;            // what is said of the soil's kind
};

class RightSoil : public testing::TestWithParam<Right> {};

TEST_P(RightSoil, PassesAllThatIsItsOwn) {
    const Right& right = GetParam();
    const Certificate certificate(right.soil, quick);
    EXPECT_EQ(certificate.with(Finding::Verdict::failed), std::vector<std::string>{}) << certificate.table();
    EXPECT_EQ(certificate.with(Finding::Verdict::left_out), right.no_verdict) << certificate.table();
    EXPECT_NE(certificate.figure(right.check).find(right.says), std::string::npos) << certificate.table();
}

const Right rights[] = {
    {"plain", {}, "modulus", "needs 1.0000 in 300 elastic points"},
    {"sand", {}, "tangent", "at most of"},
    {"rubber", {}, "objectivity", "200 points and rotations"},
    {"fabric", {"tangent"}, "objectivity", "200 points and rotations"},
    {"fixed_axis", {"tangent", "objectivity"}, "objectivity", "has a fixed axis, y: off by"},
    {"kinematic", {"tangent"}, "step_size", "order"},
    {"chain", {"tangent"}, "declaration", "5 parameters and states"},
    {"legacy", {"threads", "tangent"}, "threads", "one thread at a time"},
    {"dense", {"tangent"}, "elastic_cycles", "400 elastic cycles of 400"},
    {"sized", {"tangent", "cavity"}, "cavity", "in cells of another size"},
    {"salt", {"tangent", "elastic_cycles", "cavity"}, "rate", "declared; 40 of 40 points differ"},
    {"hypoelastic", {"tangent"}, "elastic_cycles", "elastic cycles of 400"},
};

INSTANTIATE_TEST_SUITE_P(All, RightSoil, testing::ValuesIn(rights), soil_of<Right>);

TEST(Certificate, OfARightSoilEndsWithTheSpeed) {
    const Certificate certificate("plain", {});
    EXPECT_EQ(certificate.with(Finding::Verdict::passed).size(), all_checks().size()) << certificate.table();
    EXPECT_NE(certificate.figure("random_walk").find("1000000 steps, 0 %"), std::string::npos);
    EXPECT_NE(certificate.figure("speed").find("ns a point"), std::string::npos);
}

} // namespace
} // namespace gault::core
