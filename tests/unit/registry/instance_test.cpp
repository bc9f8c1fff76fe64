// What a component answers to create(), and what the user is told.
#include "core/registry/instance.hpp"

#include <cstring>
#include <gtest/gtest.h>

using namespace gault::core;

namespace {

// The next answer of the component under test.
gault_status status;
std::string reason;
int32_t blamed;
int alive;

gault_status create(const gault_host* host, const gault_value* values, void** self,
                    gault_error* error) noexcept {
    host->log(host->self, GAULT_DEBUG, nullptr);
    host->log(host->self, GAULT_DEBUG, "created");
    EXPECT_EQ(host->extension(host->self, "anything/1"), nullptr);
    EXPECT_STREQ(host->name, "gault");
    EXPECT_EQ(error->parameter, -1);
    EXPECT_EQ(values[0].real, 7.0);
    error->parameter = blamed;
    std::memcpy(error->text, reason.data(), std::min(reason.size(), sizeof error->text));
    if (status != GAULT_OK) return status;
    ++alive;
    *self = &alive;
    return GAULT_OK;
}

void destroy(void*) noexcept {
    --alive;
}

const gault_parameter parameter = [] {
    gault_parameter p{};
    p.size = sizeof p;
    p.name = "rate";
    return p;
}();
const gault_parameter* const parameters[] = {&parameter, nullptr};
const gault_material_api api{};

const gault_component declaration = [] {
    gault_component c{};
    c.size = sizeof c;
    c.kind = GAULT_PROGRAM;
    c.name = "clock";
    c.parameters = parameters;
    c.api = &api;
    c.create = create;
    c.destroy = destroy;
    return c;
}();
const Component component{&declaration, nullptr, "/plugins/clock.so"};

class Created : public testing::Test {
  protected:
    Created() {
        status = GAULT_OK;
        reason = "";
        blamed = -1;
        alive = 0;
        values.values.push_back({});
        values.values[0].real = 7.0;
        values.locations.push_back({"scene.yaml", 5, 9});
        values.where = {"scene.yaml", 4, 3};
    }
    std::string refusal() const {
        try {
            const Instance instance(component, values);
        } catch (const InputError& e) {
            return e.what();
        }
        return "created";
    }
    Parameters values;
};

} // namespace

TEST_F(Created, LivesUntilItsOwnerEnds) {
    {
        Instance first(component, values);
        EXPECT_EQ(first.self(), &alive);
        EXPECT_EQ(&first.api<gault_material_api>(), &api);
        const Instance second(std::move(first));
        EXPECT_EQ(second.self(), &alive);
        EXPECT_EQ(alive, 1);
    }
    EXPECT_EQ(alive, 0);
}

TEST_F(Created, IsRefusedAtTheParameterThatItBlames) {
    status = GAULT_INVALID;
    reason = "must not be 7";
    blamed = 0;
    EXPECT_EQ(refusal(), "scene.yaml:5:9: program 'clock': rate: must not be 7");
    EXPECT_EQ(alive, 0);
}

TEST_F(Created, IsRefusedAsAWholeWhenItBlamesNoParameterOfItsOwn) {
    status = GAULT_INVALID;
    reason = "rate and until contradict each other";
    for (const int32_t index : {-1, 1, 2000000000, -2000000000}) {
        blamed = index;
        EXPECT_EQ(refusal(), "scene.yaml:4:3: program 'clock': rate and until contradict each other");
    }
}

TEST_F(Created, SaysWhyItFailed) {
    status = GAULT_FAILED;
    reason = "out of memory";
    EXPECT_EQ(refusal(), "scene.yaml:4:3: program 'clock': out of memory");
}

TEST_F(Created, ThatGivesNoReasonIsSaidToGiveNone) {
    status = GAULT_FAILED;
    EXPECT_EQ(refusal(), "scene.yaml:4:3: program 'clock': refused by /plugins/clock.so without a reason");
}

TEST_F(Created, ThatAnswersNonsenseIsQuoted) {
    status = 77;
    reason = "?";
    EXPECT_EQ(refusal(),
              "scene.yaml:4:3: program 'clock': /plugins/clock.so answered with the unknown status 77 (?)");
}

TEST_F(Created, MayLeaveItsTextUnterminatedOrInSeveralLines) {
    status = GAULT_FAILED;
    reason = std::string(GAULT_TEXT, 'x');
    EXPECT_EQ(refusal(), "scene.yaml:4:3: program 'clock': " + std::string(GAULT_TEXT, 'x'));
    reason = "one\ntwo\ttabs";
    EXPECT_EQ(refusal(), "scene.yaml:4:3: program 'clock': one two tabs");
}

TEST_F(Created, WithTooFewValuesIsTheHostsMistake) {
    values.values.clear();
    EXPECT_THROW(Instance(component, values), std::logic_error);
}
