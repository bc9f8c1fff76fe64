#include "core/base/units.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>

namespace gault::core {
namespace {

std::string refusal(std::string_view text, std::string_view unit) {
    try {
        parse_quantity(text, unit);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

#define EXPECT_REFUSED(text, unit, part)                                                                     \
    EXPECT_NE(refusal(text, unit).find(part), std::string::npos) << refusal(text, unit)

TEST(Units, ConvertsWhatPeopleWrite) {
    EXPECT_EQ(parse_quantity("90 kPa", "Pa"), 90e3);
    EXPECT_EQ(parse_quantity("100 MPa", "Pa"), 100e6);
    EXPECT_EQ(parse_quantity("150 kN/m2", "Pa"), 150e3);
    EXPECT_EQ(parse_quantity("150 kN/m^2", "Pa"), 150e3);
    EXPECT_EQ(parse_quantity("2 kN/m²", "Pa"), 2e3);
    EXPECT_EQ(parse_quantity("2 bar", "Pa"), 2e5);
    EXPECT_EQ(parse_quantity("20 mm", "m"), 0.02);
    EXPECT_EQ(parse_quantity("1650 kg/m^3", "kg/m^3"), 1650.0);
    EXPECT_EQ(parse_quantity("1.65 t/m3", "kg/m^3"), 1650.0);
    EXPECT_EQ(parse_quantity("1.65 g/cm^3", "kg/m^3"), 1650.0);
    EXPECT_EQ(parse_quantity("1 mm/s", "m/s"), 1e-3);
    EXPECT_EQ(parse_quantity("60 mm/min", "m/s"), 1e-3);
    EXPECT_EQ(parse_quantity("9.81 m/s^2", "m/s^2"), 9.81);
    EXPECT_EQ(parse_quantity("9.81 m s-2", "m/s^2"), 9.81);
    EXPECT_EQ(parse_quantity("3 1/s", "1/s"), 3.0);
    EXPECT_EQ(parse_quantity("3/s", "1/s"), 3.0);
    EXPECT_EQ(parse_quantity("60 %/min", "1/s"), 0.01);
    EXPECT_EQ(parse_quantity("2 Pa.s/m^2", "Pa s/m^2"), 2.0);
    EXPECT_EQ(parse_quantity("2 h", "s"), 7200.0);
}

TEST(Units, ReadsAnglesInEverySpelling) {
    const double half_turn = std::numbers::pi;
    for (const char* text : {"180 deg", "180deg", "180 degree", "180 degrees", "180°", "180 °"})
        EXPECT_NEAR(parse_quantity(text, "rad"), half_turn, 4e-16 * half_turn) << text;
    EXPECT_EQ(parse_quantity("-0.5 rad", "rad"), -0.5);
    EXPECT_LT(parse_quantity("-5 deg", "rad"), 0.0);
}

TEST(Units, ReadsPureNumbersAndPercent) {
    EXPECT_EQ(parse_quantity("0.25", "1"), 0.25);
    EXPECT_EQ(parse_quantity("10 %", "1"), 0.1);
    EXPECT_EQ(parse_quantity("7%", "1"), 0.07);
    EXPECT_EQ(parse_quantity("2.5 %", "1"), 0.025);
    EXPECT_EQ(parse_quantity("4 percent", "1"), 0.04);
}

TEST(Units, ReadsNumbersInEverySpelling) {
    EXPECT_EQ(parse_quantity("1e5 Pa", "Pa"), 1e5);
    EXPECT_EQ(parse_quantity("+1.5E2 Pa", "Pa"), 150.0);
    EXPECT_EQ(parse_quantity("  5 Pa  ", "Pa"), 5.0);
    EXPECT_EQ(parse_quantity("5\u00a0kPa", "Pa"), 5e3);
    EXPECT_EQ(parse_quantity(".5 Pa", "Pa"), 0.5);
    EXPECT_EQ(parse_quantity("3 µm", "m"), 3e-6);
}

TEST(Units, TakesABareZeroAsAQuantity) {
    EXPECT_EQ(parse_quantity("0", "Pa"), 0.0);
    EXPECT_EQ(parse_quantity("0.0", "m/s"), 0.0);
}

TEST(Units, AsksForTheUnitOfABareNumber) {
    EXPECT_REFUSED("150", "Pa", "write for example '150 Pa'");
    EXPECT_REFUSED("150", "Pa", "kPa");
    EXPECT_REFUSED("48", "rad", "write for example '48 deg'");
}

TEST(Units, SaysBothUnitsWhereTheCaseDecides) {
    EXPECT_REFUSED("150 kpa", "Pa", "did you mean 'kPa'?");
    EXPECT_REFUSED("10 mpa", "Pa", "did you mean 'MPa' or 'mPa'?");
    EXPECT_REFUSED("10 Mpa", "Pa", "did you mean 'MPa' or 'mPa'?");
    EXPECT_REFUSED("10 pa", "Pa", "did you mean 'Pa'?"); // to udunits2 a picoare
    EXPECT_REFUSED("10 PA", "Pa", "did you mean 'Pa'?"); // to udunits2 a petaampere
    EXPECT_REFUSED("10 KPA", "Pa", "did you mean 'kPa'?");
}

TEST(Units, RefusesAnotherDimension) {
    EXPECT_REFUSED("20 mm", "Pa", "'mm' does not convert to 'Pa'; allowed: Pa, kPa, MPa, GPa, ...");
    EXPECT_REFUSED("10 %", "Pa", "does not convert");
    EXPECT_REFUSED("10 kPa", "1", "does not convert to a pure number; write a bare number or a percentage");
    EXPECT_REFUSED("48 %", "rad", "does not convert");
    EXPECT_REFUSED("48 deg", "1", "does not convert");
    EXPECT_REFUSED("2 s", "1/s", "does not convert");
    EXPECT_REFUSED("2 rad/s", "1/s", "does not convert");
}

TEST(Units, RefusesNumbersOutOfPlace) {
    EXPECT_REFUSED("1,000 Pa", "Pa", "comma");
    EXPECT_REFUSED("1 2 kPa", "Pa", "'2 kPa' is not a unit");
    EXPECT_REFUSED("1 000 Pa", "Pa", "'000 Pa' is not a unit");
    EXPECT_REFUSED("1 m^0.5", "m", "is not a unit");
    EXPECT_REFUSED("1 m^99", "m", "is not a unit");
    EXPECT_REFUSED("5 s @ 5", "s", "is not a unit");
    EXPECT_REFUSED("5 s since 2000", "s", "is not a unit");
    EXPECT_REFUSED("0x10 Pa", "Pa", "is not a unit");
}

TEST(Units, RefusesWhatUdunitsWouldIgnore) {
    EXPECT_REFUSED("5 mm)", "m", "is not a unit");
    EXPECT_REFUSED("5 m/", "m", "is not a unit");
    EXPECT_REFUSED("5 mm # wide", "m", "is not a unit");
    EXPECT_REFUSED("5 lg(re mW)", "m", "is not a unit");
}

TEST(Units, RefusesWhatIsNoFiniteNumber) {
    EXPECT_REFUSED("", "Pa", "is not a number");
    EXPECT_REFUSED("kPa", "Pa", "is not a number");
    EXPECT_REFUSED("ten kPa", "Pa", "is not a number");
    EXPECT_REFUSED("nan Pa", "Pa", "is not a finite number");
    EXPECT_REFUSED("inf", "1", "is not a finite number");
    EXPECT_REFUSED("1e999 Pa", "Pa", "beyond the range");
    EXPECT_REFUSED("1e308 GPa", "Pa", "beyond the range");
}

TEST(Units, SaysWhenADeclaredUnitIsUnknown) {
    EXPECT_REFUSED("5 Pa", "wurst", "the declared unit 'wurst' is not known");
}

} // namespace
} // namespace gault::core
