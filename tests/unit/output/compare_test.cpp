#include "core/base/error.hpp"
#include "core/output/compare.hpp"
#include "core/output/interpolate.hpp"
#include "tests/unit/output/support.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

using namespace gault::core;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Numbers = std::vector<double>;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Numbers uniform(double from, double to, int intervals) {
    Numbers x;
    for (int i = 0; i <= intervals; ++i)
        x.push_back(from + (to - from) * i / intervals);
    return x;
}

Numbers map(const Numbers& x, const std::function<double(double)>& f) {
    Numbers y(x.size());
    std::ranges::transform(x, y.begin(), f);
    return y;
}

template <class Interpolant>
double largest_error(const std::function<double(double)>& f, double from, double to, int intervals) {
    const Numbers x = uniform(from, to, intervals);
    const Interpolant curve(x, map(x, f));
    double largest = 0.0;
    for (const double place : uniform(from, to, 1013))
        largest = std::max(largest, std::abs(curve(place) - f(place)));
    return largest;
}

} // namespace

TEST(MonotoneCubic, PassesThroughItsPointsAndReproducesALine) {
    const Numbers x{0, 1, 3, 4, 7}, y{2, 5, 4, 4, 9};
    const MonotoneCubic curve(x, y);
    for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_DOUBLE_EQ(curve(x[i]), y[i]);
    const MonotoneCubic line(x, map(x, [](double s) { return 3 - 2 * s; }));
    for (const double s : uniform(0, 7, 50))
        EXPECT_NEAR(line(s), 3 - 2 * s, 1e-14);
    EXPECT_DOUBLE_EQ(MonotoneCubic(Numbers{1, 3}, Numbers{2, 6})(2), 4);
}

TEST(MonotoneCubic, NeverOvershootsAStep) {
    const Numbers x{0, 1, 2, 3, 4, 5}, y{0, 0, 0, 1, 1, 1};
    const MonotoneCubic curve(x, y);
    for (const double s : uniform(0, 5, 500)) {
        EXPECT_GE(curve(s), 0.0);
        EXPECT_LE(curve(s), 1.0);
    }
}

TEST(MonotoneCubic, IsOfThirdOrderWhereTheDataAreMonotone) {
    const auto f = [](double s) { return std::exp(s); };
    EXPECT_GT(largest_error<MonotoneCubic>(f, 0, 1, 20) / largest_error<MonotoneCubic>(f, 0, 1, 40), 7.0);
}

TEST(LogarithmicCubic, IsOfFourthOrderAndExactForCubicsBeyondItsEndsToo) {
    const auto f = [](double r) { return 1 / (r * r); };
    EXPECT_GT(largest_error<LogarithmicCubic>(f, 1, 3, 80) / largest_error<LogarithmicCubic>(f, 1, 3, 160),
              14.0);

    const auto cubic = [](double r) { return 2 + std::log(r) - 3 * std::pow(std::log(r), 3); };
    const Numbers r{1, 1.5, 2, 2.7, 4, 5};
    const LogarithmicCubic curve(r, map(r, cubic));
    for (const double place : {0.7, 1.0, 1.2, 1.9, 3.3, 4.1, 6.2})
        EXPECT_NEAR(curve(place), cubic(place), 1e-12);
    EXPECT_THROW(curve(0.6), InputError);
    EXPECT_THROW(curve(6.3), InputError);
    EXPECT_THROW(LogarithmicCubic(Numbers{0, 1, 2, 3}, Numbers{1, 1, 1, 1}), InputError);
}

TEST(CompareCurve, FindsAKnownRelativeError) {
    const Numbers x_reference = uniform(0, 2, 10),
                  y_reference = map(x_reference, [](double s) { return 1 + 3 * s; });
    const Numbers x = uniform(0, 1.9, 57), y = map(x, [](double s) { return 1.02 * (1 + 3 * s); });
    const CurveError error = compare_curve(x, y, x_reference, y_reference, 0.49, 1.51);
    EXPECT_NEAR(error.largest, 0.02, 1e-14);
    EXPECT_NEAR(error.root_mean_square, 0.02, 1e-14);
    EXPECT_EQ(error.rows, 31u); // 15/30 ... 45/30
}

TEST(CompareCurve, NamesThePlaceAndIgnoresRowsOutsideTheRange) {
    const Numbers reference{0, 1, 2, 3, 4}, level{-10, -10, -10, -10, -10};
    const Numbers x{0, 1, 2, 3}, y{-10, -10, -9, -20};
    const CurveError error = compare_curve(x, y, reference, level, 0, 2.5);
    EXPECT_NEAR(error.largest, 0.1, 1e-15);
    EXPECT_EQ(error.largest_at, 2);
    EXPECT_NEAR(error.root_mean_square, 0.1 / std::sqrt(3.0), 1e-15);
    EXPECT_EQ(error.rows, 3u);
}

TEST(CompareCurve, TakesEveryRowOfALoop) {
    const Numbers reference{0, 4}, rising{1, 5};
    const Numbers x{1, 3, 2, 3}, y{2, 4, 3 * 1.5, 4};
    const CurveError error = compare_curve(x, y, reference, rising, 1, 3);
    EXPECT_EQ(error.rows, 4u);
    EXPECT_EQ(error.largest_at, 2);
    EXPECT_NEAR(error.largest, 0.5, 1e-15);
}

TEST(CompareCurve, RefusesWhatItCannotCompare) {
    const Numbers x{0, 1, 2}, y{1, 1, 1};
    EXPECT_THAT([&] { compare_curve(x, y, x, y, 3, 4); },
                ThrowsMessage<InputError>(HasSubstr("no row lies between 3 and 4")));
    EXPECT_THAT(
        [&] {
            compare_curve(x, y, Numbers{0, 1}, Numbers{1, 1}, 0, 2);
        },
        ThrowsMessage<InputError>(HasSubstr("2 lies outside the reference, 0 to 1")));
    EXPECT_THAT(
        [&] {
            compare_curve(x, y, Numbers{0, 1, 1}, y, 0, 2);
        },
        ThrowsMessage<InputError>(HasSubstr("does not increase at row 2")));
    EXPECT_THAT(
        [&] {
            compare_curve(x, Numbers{1, not_a_number, 1}, x, y, 0, 2);
        },
        ThrowsMessage<InputError>(HasSubstr("y is nan at row 1")));
    EXPECT_THROW(compare_curve(Numbers{0, not_a_number, 2}, y, x, y, 0, 2), InputError);
    EXPECT_THROW(compare_curve(x, y, x, Numbers{1, not_a_number, 1}, 0, 2), InputError);
    EXPECT_THROW(compare_curve(x, y, x, Numbers{1, 0, 1}, 0, 2), InputError);
    EXPECT_THROW(compare_curve(x, Numbers{1, 1}, x, y, 0, 2), InputError);
    EXPECT_THROW(compare_curve(x, y, Numbers{0}, Numbers{1}, 0, 2), InputError);
}

TEST(NoiseAboutCubic, IsZeroForACubicAndTheRmsOfWhatIsNotOne) {
    const Numbers x = uniform(0.04, 0.1, 3000);
    const auto smooth = [](double s) { return 6e5 - 1e6 * s + 4e7 * s * s * s; };
    EXPECT_LT(noise_about_cubic(x, map(x, smooth), 0.04, 0.1), 1e-13);

    // Legendre's P4 is orthogonal to cubics, its mean is 0 and its RMS 1/3; the sum over 3000 intervals is
    // 0.1 % off.
    const auto p4 = [](double s) {
        const double t = (s - 0.07) / 0.03;
        return (35 * std::pow(t, 4) - 30 * t * t + 3) / 8;
    };
    const Numbers y = map(x, [&](double s) { return 200 + 6 * p4(s); });
    EXPECT_NEAR(noise_about_cubic(x, y, 0.04, 0.1), 0.01, 3e-5);
}

TEST(NoiseAboutCubic, LooksAtItsRangeOnlyAndNeedsFiveRows) {
    const Numbers x{0, 1, 2, 3, 4, 5, 6}, y{9, 1, 1, 1, 1, 1, 7};
    EXPECT_LT(noise_about_cubic(x, y, 1, 5), 1e-14);
    EXPECT_THAT([&] { noise_about_cubic(x, y, 1, 4); }, ThrowsMessage<InputError>(HasSubstr("4 rows")));
    EXPECT_THROW(noise_about_cubic(x, y, 7, 8), InputError);
    EXPECT_THROW(noise_about_cubic(x, Numbers(7, 0.0), 1, 5), InputError);
    EXPECT_THROW(noise_about_cubic(x, Numbers{9, 1, not_a_number, 1, 1, 1, 7}, 1, 5), InputError);
}

TEST(ProfileError, IsTheRelativeNormWeightedByVolumeInAnyOrderOfPoints) {
    const Numbers reference{1, 2, 3, 4, 5}, level{-3, -3, -3, -3, -3};
    // sqrt((1 * 0.3^2 + 3 * 0.6^2) / (4 * 3^2))
    EXPECT_NEAR(profile_error(Numbers{4.5, 0.8}, Numbers{-3.3, -2.4}, Numbers{1, 3}, reference, level),
                std::sqrt(1.17 / 36), 1e-14);
    const Numbers r = uniform(1, 5, 33);
    EXPECT_NEAR(profile_error(r, map(r, [](double) { return -3.03; }), Numbers(34, 0.5), reference, level),
                0.01, 1e-14);
}

TEST(ProfileError, RefusesWhatItCannotCompare) {
    const Numbers r{1, 2, 3, 4}, s{1, 1, 1, 1};
    EXPECT_THROW(profile_error({}, {}, {}, r, s), InputError);
    EXPECT_THROW(profile_error(r, s, Numbers{1}, r, s), InputError);
    EXPECT_THROW(profile_error(Numbers{1000, 2000}, Numbers{1, 1}, Numbers{1, 1}, r, s), InputError);
    EXPECT_THROW(profile_error(r, Numbers{1, not_a_number, 1, 1}, s, r, s), InputError);
    EXPECT_THROW(profile_error(r, s, s, r, Numbers{0, 0, 0, 0}), InputError);
    EXPECT_THROW(profile_error(r, s, s, Numbers{1, 2, 3}, Numbers{1, 1, 1}), InputError);
}

namespace {

class Csv : public testing::Test {
  protected:
    CsvTable read(const char* content) {
        std::ofstream(file) << content;
        return read_csv(file);
    }
    test::Folder folder;
    std::filesystem::path file = folder.path / "a.csv";
};

} // namespace

TEST_F(Csv, ReadsColumnsByName) {
    const CsvTable table = read("strain, pressure_kPa\r\n0,90\r\n\r\n 1e-3 ,\t-2.5   \r\n");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"strain", "pressure_kPa"}));
    EXPECT_THAT(table.column("strain"), testing::ElementsAre(0, 1e-3));
    EXPECT_THAT(table.column("pressure_kPa"), testing::ElementsAre(90, -2.5));
}

TEST_F(Csv, SuggestsTheNearestColumn) {
    const CsvTable table = read("strain,pressure_kPa\n0,90\n");
    EXPECT_THAT([&] { (void)table.column("presure_kPa"); },
                ThrowsMessage<InputError>(HasSubstr("did you mean 'pressure_kPa'?")));
}

TEST_F(Csv, SaysWhereAFileIsWrong) {
    const std::string name = file.string();
    EXPECT_THAT([&] { read("a,b\n1,2\n3, x4\n"); },
                ThrowsMessage<InputError>(HasSubstr(name + ":3:4: 'x4' is not a finite number")));
    EXPECT_THAT([&] { read("a,b\n1,2\n3\n"); },
                ThrowsMessage<InputError>(HasSubstr(name + ":3:1: 1 values for 2 columns")));
    EXPECT_THAT([&] { read("a,b\n1,nan\n"); }, ThrowsMessage<InputError>(HasSubstr(":2:3: 'nan'")));
    EXPECT_THROW(read("a,b\n1,\n"), InputError);
    EXPECT_THROW(read(""), InputError);
    EXPECT_THROW(read_csv(folder.path / "absent.csv"), InputError);
    EXPECT_THROW(read_csv(folder.path), InputError);
}
