#include "apps/command.hpp"
#include "core/scheduler/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace gault::app {
namespace {

std::string amount(double value, const char* unit) {
    for (const auto& [size, prefix] : {std::pair{1e9, "G"}, {1e6, "M"}, {1e3, "k"}})
        if (value >= size) return fmt::format("{:.3g} {}{}", value / size, prefix, unit);
    return fmt::format("{:.3g} {}", value, unit);
}

void print(const core::Estimate& e) {
    if (!e.unknown.empty())
        fmt::print("{} points; steps and time are not known: {}\n", e.points, e.unknown);
    else
        fmt::print("{} points, about {:.0f} steps, {} constitutive updates, {:.2g} s, {}\n", e.points,
                   e.steps, amount(e.updates, ""), e.seconds, amount(e.bytes, "B"));
}

void print(const std::vector<core::Choice>& choices) {
    std::size_t key = 0, value = 0;
    for (const core::Choice& choice : choices)
        key = std::max(key, choice.key.size()), value = std::max(value, choice.value.size());
    for (const core::Choice& choice : choices)
        fmt::print("    {:<{}}  {:<{}}  {}\n", choice.key, key, choice.value, value, choice.reason);
}

core::Estimate estimate(const LoadedScene& scene) {
    return core::estimate_cost(
        *scene, [&](const std::vector<core::Override>& more) { return scene.reread(more); },
        core::threads_that_pay(scene->points(), 0), 10.0);
}

// What is set by hand and differs from the least that is enough.
std::vector<core::Choice> by_hand(const LoadedScene& scene, const LoadedScene& least) {
    std::vector<core::Choice> differing;
    for (const core::Choice& choice : least.choices()) {
        const auto same = [&](const core::Choice& other) { return other.key == choice.key; };
        if (std::none_of(scene.choices().begin(), scene.choices().end(), same)) differing.push_back(choice);
    }
    return differing;
}

void compare_with_least(const LoadedScene& scene, const SceneArguments& arguments) try {
    const LoadedScene least(arguments, everything_open(*scene));
    const auto set = by_hand(scene, least);
    if (set.empty()) return;
    fmt::print("\nset by hand, where this would have been chosen:\n");
    print(set);
    fmt::print("\nwith which it would take:\n    ");
    print(estimate(least));
} catch (const core::InputError&) { // parts that lie on the knots of the grid set by hand, and no other
}

int plan(const SceneArguments& arguments) {
    const LoadedScene scene(arguments);
    fmt::print("{}, for an accuracy of {:g} %\n\nchosen:\n", scene->title, 100.0 * scene->accuracy);
    std::vector<core::Choice> choices = scene.choices();
    choices.insert(choices.end(), scene->chosen.begin(), scene->chosen.end());
    print(choices);
    fmt::print("\nit will take:\n    ");
    print(estimate(scene));
    compare_with_least(scene, arguments);
    return 0;
}

} // namespace

Action declare_plan(CLI::App& options) {
    const auto arguments = std::make_shared<SceneArguments>();
    arguments->declare(options);
    options.footer(
        "Prints what was left open and is chosen, with the reason, and what the run will cost: points, "
        "steps, constitutive updates,\ntime and memory, from a pilot run on a coarse grid and the first "
        "steps of the scene. What is set by hand is respected;\nthe plan says what it costs beside the "
        "least that is enough for the scene's `accuracy`.\n\n"
        "Examples:\n"
        "  gault plan configs/paper/fahey.yaml\n"
        "  gault plan configs/paper/fahey.yaml --set accuracy='0.1 %' --set model.symmetry=auto");
    return [arguments](const std::string&) { return plan(*arguments); };
}

} // namespace gault::app
