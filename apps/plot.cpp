#include "apps/command.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <unistd.h>

namespace gault::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string results, picture;
    double measured = 0.0; // kPa
};

int plot(const Arguments& arguments, bool has_measured) {
    const fs::path results = arguments.results;
    if (!fs::is_regular_file(results / "history.csv"))
        throw core::InputError(fmt::format(
            "'{}' holds no history.csv; name the folder that `gault run` wrote", results.string()));
    std::vector<std::string> words = {
        "/usr/bin/python3", shared_file("plot.py").string(),
        "--output=" + (arguments.picture.empty() ? (results / "plot.png").string() : arguments.picture)};
    if (has_measured) words.push_back(fmt::format("--measured={}", arguments.measured));
    words.insert(words.end(), {"--", results.string()});
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    std::fflush(nullptr);
    ::execv(argv[0], argv.data()); // its words and its exit status are ours
    throw core::RunError(fmt::format("cannot run {}: {}", words[0], std::strerror(errno)));
}

} // namespace

Action declare_plot(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    options.add_option("results", arguments->results, "The folder that `gault run` wrote")
        ->required()
        ->type_name("FOLDER");
    options.add_option("-o,--output", arguments->picture, "The picture (default: FOLDER/plot.png)")
        ->type_name("PNG");
    CLI::Option* measured =
        options.add_option("--measured", arguments->measured, "A measured peak pressure to mark, kPa");
    options.footer("Draws pressure against cavity strain, and the radial stress of raw points at each frame, with the "
                   "references\nof the scene; prints the main numbers. Needs python3-matplotlib and python3-h5py.\n\n"
                   "Example:\n"
                   "  gault plot out/fahey -o fahey.png --measured 655");
    return [arguments, measured](const std::string&) { return plot(*arguments, measured->count() > 0); };
}

} // namespace gault::app
