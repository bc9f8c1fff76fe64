#include "apps/command.hpp"
#include "core/base/suggest.hpp"
#include "core/config/reader.hpp"
#include "core/output/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <memory>

namespace gault::app {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kinds = {"material", "boundary", "program", "observer"};

constexpr std::string_view cpp_keywords =
    " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t "
    "class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue "
    "decltype default delete do double dynamic_cast else enum explicit export extern false float for friend "
    "goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private "
    "protected public register reinterpret_cast requires return short signed sizeof static static_assert "
    "static_cast struct switch template this thread_local throw true try typedef typeid typename union "
    "unsigned using virtual void volatile wchar_t while xor xor_eq ";
constexpr std::string_view cmake_targets =
    " all clean depend edit_cache help install package package_source preinstall rebuild_cache test ";

struct Arguments {
    std::string kind, name, folder;
};

bool is_among(std::string_view words, const std::string& word) {
    return words.find(" " + word + " ") != std::string_view::npos;
}

bool is_name(const std::string& word) {
    const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return !word.empty() && word[0] >= 'a' && word[0] <= 'z' &&
           std::all_of(word.begin(), word.end(), allowed);
}

// The nearest word that is a name: "MySoil" gives "my_soil". Empty where no letter is in it.
std::string as_name(const std::string& word) {
    std::string name;
    for (const char c : word) {
        const auto u = static_cast<unsigned char>(c);
        if (std::isupper(u) && !name.empty() && std::islower(static_cast<unsigned char>(name.back())))
            name += '_';
        if (std::isalpha(u) || !name.empty())
            name += std::isalnum(u) ? static_cast<char>(std::tolower(u)) : '_';
    }
    return name;
}

std::string type_name(const std::string& name) { // "my_soil" gives "MySoil"
    std::string type;
    bool begins = true;
    for (const char c : name) {
        if (c != '_') type += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        begins = c == '_';
    }
    return type;
}

void check_name(const std::string& name) {
    if (!is_name(name)) {
        const std::string near = as_name(name);
        throw core::InputError(fmt::format(
            "'{}' cannot be a name; allowed are small letters, digits and underscores, a letter first{}",
            name, near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
    if (is_among(cpp_keywords, name))
        throw core::InputError(fmt::format("'{}' is a word of C++; choose another name", name));
    if (is_among(cmake_targets, name))
        throw core::InputError(
            fmt::format("'{}' is a target that CMake makes itself; choose another name", name));
    // A file of the same name would replace that of a component of another kind, too.
    const core::Registry registry(core::plugin_search_path({}, {}));
    for (const core::Component& c : registry.components())
        if (name == c.declaration->name || name == c.file.stem())
            throw core::InputError(fmt::format("'{}' is the {} of {}; choose another name", name,
                                               core::kind_name(c.declaration->kind), c.file.string()));
}

void check_folder(const fs::path& folder) {
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw core::InputError(fmt::format("'{}' is a file; choose another folder with -o", folder.string()));
    if (fs::is_directory(folder) && !fs::is_empty(folder))
        throw core::InputError(
            fmt::format("'{}' exists and is not empty; choose another folder with -o", folder.string()));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

// Every file of the kind's template, its placeholders new_KIND and NewKind replaced. Returns how many.
int write_project(const Arguments& arguments, const fs::path& folder) {
    const fs::path source = installation() / "share/gault/template" / arguments.kind;
    if (!fs::is_directory(source))
        throw core::InputError(
            fmt::format("'{}' is missing: it comes with the SDK (the Debian package gault, "
                        "or `cmake --install BUILD --component sdk`)",
                        source.string()));
    const std::string placeholder = "new_" + arguments.kind;
    const auto own = [&](const std::string& text) {
        return replaced(replaced(text, placeholder, arguments.name), type_name(placeholder),
                        type_name(arguments.name));
    };
    int files = 0;
    fs::create_directories(folder);
    for (const fs::directory_entry& entry : fs::directory_iterator(source)) {
        core::write_atomically(folder / own(entry.path().filename().string()),
                               own(core::config::read_text(entry.path())));
        ++files;
    }
    return files;
}

std::string shell_word(const std::string& text) {
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) ||
               std::string_view("/._-+=:,@%").find(c) != std::string::npos;
    };
    return std::all_of(text.begin(), text.end(), is_plain) ? text
                                                           : "'" + replaced(text, "'", R"('\'')") + "'";
}

int make_project(const Arguments& arguments) {
    if (std::find(kinds.begin(), kinds.end(), arguments.kind) == kinds.end())
        throw core::InputError(
            fmt::format("no kind '{}'{}", arguments.kind, core::suggestion(arguments.kind, kinds)));
    check_name(arguments.name);
    const fs::path folder = arguments.folder.empty() ? arguments.name : arguments.folder;
    int files = 0;
    try {
        check_folder(folder);
        files = write_project(arguments, folder);
    } catch (const fs::filesystem_error& error) {
        throw core::InputError(
            fmt::format("cannot write a project in '{}': {}", folder.string(), error.code().message()));
    }
    const std::string typed = program_invocation_name;
    const std::string gault =
        shell_word(typed.find('/') == std::string::npos ? typed : (installation() / "bin/gault").string());
    fmt::print("{} files in {}. Build it and run it:\n\n"
               "    cd {}\n"
               "    cmake -S . -B build -DCMAKE_PREFIX_PATH={}\n"
               "    cmake --build build\n"
               "    {} run scene.yaml\n\n"
               "Then, after every change:\n\n"
               "    cmake --build build\n"
               "    ctest --test-dir build\n",
               files, folder.string(), shell_word(folder.string()), shell_word(installation().string()),
               gault);
    if (arguments.kind == "material")
        fmt::print("    {0} element triaxial.yaml --force\n"
                   "    {0} certify {1} --with scene.yaml\n",
                   gault, arguments.name);
    fmt::print("\nREADME.md says what to change.\n");
    return 0;
}

} // namespace

Action declare_new(CLI::App& options) {
    const auto arguments = std::make_shared<Arguments>();
    options.add_option("kind", arguments->kind, "material, boundary, program or observer")
        ->required()
        ->type_name("KIND");
    options.add_option("name", arguments->name, "Of the component, as scenes will call it")
        ->required()
        ->type_name("NAME");
    options.add_option("-o,--output", arguments->folder, "Folder of the project (default: NAME)")
        ->type_name("FOLDER");
    options.footer(
        "Writes a project that builds as it is: source, test, CMakeLists.txt, README.md and a scene; of a "
        "material also\na test for `gault element`. Prints how to build and run it.\n\n"
        "Examples:\n"
        "  gault new material my_soil\n"
        "  gault new boundary elastic_liner -o liner");
    return [arguments](const std::string&) { return make_project(*arguments); };
}

} // namespace gault::app
