#include "core/scheduler/progress.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <sstream>

namespace gault::core::test {
namespace {

std::string shown(double share) {
    std::ostringstream said;
    const auto before = spdlog::default_logger();
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_st>(said)));
    spdlog::set_pattern("%v");
    Progress(10, false).show({16, 2.0, share, "strain 1"});
    spdlog::set_default_logger(before);
    return said.str();
}

TEST(Progress, NamesAShareWhereItIsKnown) {
    EXPECT_EQ(shown(0.25).find(" 25 %  step 16  t = 2 s  strain 1"), 0u) << shown(0.25);
    EXPECT_NE(shown(0.25).find(" left"), std::string::npos);
    EXPECT_EQ(shown(std::nan("")).find("step 16  t = 2 s  strain 1"), 0u) << shown(std::nan(""));
    EXPECT_EQ(shown(std::nan("")).find(" left"), std::string::npos);
}

} // namespace
} // namespace gault::core::test
