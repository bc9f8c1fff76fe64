#include "tests/bad_scenes/check_scene.hpp"

#include "core/config/reader.hpp"

#include <optional>

namespace gault::core {
namespace {

const std::string folder = GAULT_SOURCE_DIR "/tests/bad_scenes/good/";

// The scene as it will run; nothing where it was refused as it should be.
std::optional<std::string> read_once(const std::string& text, std::string& wrong) {
    const std::string file = folder + "scene.yaml";
    try {
        return config::read_scene_text(text, file, {}, test_registry()).yaml;
    } catch (const InputError& error) {
        const std::string what = error.what();
        if (!what.starts_with(file + ":"))
            wrong = "no location: " + what;
        else if (what.find('\n') != std::string::npos)
            wrong = "more than a line: " + what;
        else if (what.size() > 2000)
            wrong = "a message of " + std::to_string(what.size()) + " bytes";
    } catch (const std::exception& error) {
        wrong = std::string("not an InputError: ") + error.what();
    }
    return std::nullopt;
}

} // namespace

const Registry& test_registry() {
    static const Registry registry({GAULT_BINARY_DIR "/tests/plugins/test_components.so"});
    return registry;
}

std::string broken_promise(const std::string& text) {
    std::string wrong;
    const auto yaml = read_once(text, wrong);
    if (!yaml) return wrong;
    const auto again = read_once(*yaml, wrong);
    return again == yaml
               ? ""
               : "its yaml reads differently: " + wrong + "\n" + *yaml + again.value_or("(refused)");
}

} // namespace gault::core
