// load_plugins PATH...: loads what is there and describes it, as the host does.
#include "core/registry/registry.hpp"

#include <cstdio>

int main(int count, char** arguments) {
    try {
        const gault::core::Registry registry(
            std::vector<std::filesystem::path>(arguments + 1, arguments + count));
        for (const gault::core::Component& component : registry.components())
            std::puts(gault::core::describe(component).c_str());
        return registry.components().empty();
    } catch (const gault::core::InputError& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 2;
    }
}
