// gault list, describe and check, which write nothing.
#include "tests/app/child.hpp"

#include <sstream>

namespace gault::test {
namespace {

using Components = App;

std::vector<std::array<std::string, 4>> table(const std::string& text) {
    std::vector<std::array<std::string, 4>> rows;
    for (const std::string& line : lines(text)) {
        auto& row = rows.emplace_back();
        std::istringstream stream(line);
        for (std::string& word : row)
            stream >> word;
    }
    return rows;
}

TEST_F(Components, AreListedWithKindNameVersionAndFile) {
    const Outcome list = gault({"list"});
    EXPECT_EQ(list.status, 0);
    EXPECT_EQ(list.err, "");
    std::map<std::string, std::string> kind;
    for (const auto& [k, name, version, file] : table(list.out)) {
        kind[name] = k;
        EXPECT_EQ(version.find_first_not_of("0123456789."), std::string::npos) << version;
        EXPECT_TRUE(fs::is_regular_file(file)) << file;
    }
    EXPECT_EQ(kind["mohr_coulomb"], "material");
    EXPECT_EQ(kind["roller"], "boundary");
    EXPECT_EQ(kind["pressuremeter"], "program");
    EXPECT_EQ(kind["thick_cylinder"], "observer");
}

TEST_F(Components, AreListedInColumns) {
    const Outcome list = gault({"list", "--plugin-path", (build / "tests/app/plugins").string()});
    std::array<std::size_t, 4> first{};
    for (const std::string& line : lines(list.out)) {
        std::array<std::size_t, 4> begin{};
        for (std::size_t k = 1; k < 4; ++k)
            begin[k] = line.find_first_not_of(' ', line.find(' ', begin[k - 1]));
        if (first[1] == 0) first = begin;
        EXPECT_EQ(begin, first) << list.out;
    }
}

TEST_F(Components, AreEachDescribedFromTheirDeclaration) {
    const auto rows = table(gault({"list"}).out);
    ASSERT_FALSE(rows.empty());
    for (const auto& [kind, name, version, file] : rows) {
        const Outcome text = gault({"describe", name});
        EXPECT_EQ(text.status, 0);
        EXPECT_TRUE(text.out.starts_with(kind + " " + name + " " + version + "\n")) << text.out;
        EXPECT_TRUE(has(text.out, file)) << text.out;
    }
}

TEST_F(Components, AreDescribedWithSymbolUnitDefaultAndBounds) {
    const std::string text = gault({"describe", "mohr_coulomb"}).out;
    for (const char* part : {"young_modulus", "friction_angle", "Pa", "rad", "required", "reference"})
        EXPECT_TRUE(has(text, part)) << part << "\n" << text;
}

TEST_F(Components, OfOneNameAndSeveralKindsAreAllDescribed) {
    const std::string text =
        gault({"describe", "ramp", "--plugin-path", (build / "tests/app/plugins").string()}).out;
    EXPECT_TRUE(text.starts_with("material ramp 3.2.1\n")) << text;
    EXPECT_TRUE(has(text, "\nprogram ramp ")) << text;
}

TEST_F(Components, UnknownOneGetsTheNearestName) {
    const std::string message = refusal(gault({"describe", "mohr_colomb"}));
    EXPECT_TRUE(has(message, "no component 'mohr_colomb'; did you mean 'mohr_coulomb'?")) << message;
}

TEST_F(Components, ListThatCannotBeWrittenIsAFailure) {
    Words words{"list"};
    const Outcome outcome = Child(work, words, {}, "/dev/full").wait();
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(outcome.err, "error: the standard output cannot be written\n");
}

TEST_F(Components, CheckSaysWhatEverySelectionTookHoldOf) {
    const Outcome check = gault({"check", (repository / "configs/paper/fahey.yaml").string()});
    EXPECT_EQ(check.status, 0);
    EXPECT_EQ(check.err, "");
    for (const char* part :
         {"material sand: 1152 points, mohr_coulomb ", "young_modulus 1e+08 Pa, poisson_ratio 0.25, ",
          "friction_angle 48 deg", "pressure on outer: ", "roller on top, bottom: ", "wall on inner: ",
          "grid.basis: quadratic", "stable step ", "this scene can run"})
        EXPECT_TRUE(has(check.out, part)) << part << "\n" << check.out;
    EXPECT_TRUE(fs::is_empty(work)) << "check writes nothing";
}

TEST_F(Components, CheckRefusesWhatRunRefuses) {
    const std::string scene = (repository / "configs/paper/fahey.yaml").string();
    for (const char* change :
         {"boundaries.2.type=pressure", "program.on=outer", "materials.sand.friction_angle=100 deg",
          "reference.curve.file=nothing.csv", "reference.curve.y=pressure"}) {
        const std::string message = refusal(gault({"check", scene, "--set", change}));
        EXPECT_EQ(message, refusal(gault({"run", scene, "--set", change})));
    }
    EXPECT_TRUE(fs::is_empty(work));
}

} // namespace
} // namespace gault::test
