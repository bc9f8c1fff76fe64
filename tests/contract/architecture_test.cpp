// Directions of dependency, read from the #include lines: plugins -> sdk <- core <- apps, and every third-party
// library in its folders alone. Core knows no component by name.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path root = GAULT_SOURCE_DIR;

struct Include {
    fs::path file; // relative to the repository
    int line;
    std::string target;
};

std::string target_of(const std::string& line) {
    const auto hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') return "";
    const auto word = line.find_first_not_of(" \t", hash + 1);
    if (word == std::string::npos || line.compare(word, 7, "include") != 0) return "";
    const auto open = line.find_first_of("<\"", word), close = line.find_first_of(">\"", open + 1);
    return close == std::string::npos ? "" : line.substr(open + 1, close - open - 1);
}

std::vector<Include> includes_of(const std::string& folder) {
    std::vector<Include> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".h" && extension != ".hpp" && extension != ".c" && extension != ".cpp") continue;
        std::ifstream stream(entry.path());
        std::string text;
        for (int line = 1; std::getline(stream, text); ++line)
            if (const std::string target = target_of(text); !target.empty())
                found.push_back({fs::relative(entry.path(), root), line, target});
    }
    return found;
}

bool is_under(const fs::path& file, const std::string& folder) {
    return file.string().starts_with(folder + "/");
}

// Where an include with quotes may lead: from the file's own folder or from the root.
bool leads_into(const Include& include, const std::string& folder) {
    const fs::path beside = (include.file.parent_path() / include.target).lexically_normal();
    return is_under(include.target, folder) || (is_under(beside, folder) && fs::exists(root / beside));
}

void expect_none(const std::string& folder, const std::string& rule,
                 const std::function<bool(const Include&)>& breaks) {
    for (const Include& include : includes_of(folder))
        EXPECT_FALSE(breaks(include)) << include.file.string() << ":" << include.line << ": includes "
                                      << include.target << "; " << rule;
}

bool is_test(const fs::path& file) {
    return file.stem().string().ends_with("_test");
}

void expect_only_in(const std::string& library, const std::vector<std::string>& homes) {
    for (const char* folder : {"sdk", "core", "plugins", "apps"})
        expect_none(folder, library + " has other folders", [&](const Include& include) {
            return include.target.starts_with(library) &&
                   !(folder == std::string("plugins") && is_test(include.file)) &&
                   std::none_of(homes.begin(), homes.end(),
                                [&](const std::string& home) { return is_under(include.file, home); });
        });
    for (const std::string& home : homes) {
        const auto all = includes_of(home);
        EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                                [&](const Include& include) { return include.target.starts_with(library); }))
            << home << " includes nothing of " << library << " any more";
    }
}

// What the SDK, and so a plugin author, may take for granted: C++17 and C11 on x86-64.
const std::set<std::string> standard_headers = {
    "algorithm",     "array",     "cfloat",   "charconv", "cmath",       "cstddef",    "cstdint",
    "cstdio",        "cstdlib",   "cstring",  "deque",    "exception",   "functional", "immintrin.h",
    "limits",        "map",       "memory",   "new",      "numeric",     "optional",   "set",
    "stddef.h",      "stdexcept", "stdint.h", "string",   "string_view", "tuple",      "type_traits",
    "unordered_map", "utility",   "variant",  "vector"};

bool is_of_the_sdk_or_standard(const Include& include) {
    return include.target.starts_with("gault/") || standard_headers.count(include.target) > 0;
}

// A bridge to code in other languages needs more of C than physics does.
bool is_of_a_bridge(const Include& include) {
    static const std::set<std::string> headers = {"csetjmp", "dlfcn.h", "mutex", "stdio.h", "stdlib.h"};
    return is_under(include.file, "plugins/umat") && headers.count(include.target) > 0;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// As the plugins declare them: `name = "mohr_coulomb"`.
std::set<std::string> component_names() {
    static const std::regex declaration(R"re(\bname = "(\w+)")re");
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "plugins")) {
        if (entry.path().extension() != ".cpp" || is_test(entry.path())) continue;
        const std::string text = text_of(entry.path());
        for (std::sregex_iterator match(text.begin(), text.end(), declaration), end; match != end; ++match)
            names.insert((*match)[1]);
    }
    return names;
}

} // namespace

TEST(Architecture, IsReadFromTheIncludeLines) {
    EXPECT_EQ(target_of("#include <vector>"), "vector");
    EXPECT_EQ(target_of("  #  include \"core/base/error.hpp\" // why"), "core/base/error.hpp");
    EXPECT_EQ(target_of("// #include <vector>"), "");
    EXPECT_GT(includes_of("core").size(), 10u);
    EXPECT_GT(includes_of("sdk").size(), 3u);
    EXPECT_GT(includes_of("plugins").size(), 0u);
}

TEST(Architecture, PluginsIncludeNothingOfCoreOrApps) {
    expect_none("plugins", "a plugin includes the sdk only", [](const Include& include) {
        return leads_into(include, "core") || leads_into(include, "apps");
    });
}

TEST(Architecture, CoreIncludesNoPluginAndNoApp) {
    expect_none("core", "core names no plugin and no app", [](const Include& include) {
        return leads_into(include, "plugins") || leads_into(include, "apps");
    });
}

TEST(Architecture, TheSdkIncludesItselfAndTheStandardLibraryOnly) {
    expect_none("sdk", "the sdk depends on nothing", [](const Include& include) {
        return !is_of_the_sdk_or_standard(include) &&
               !fs::exists(root / include.file.parent_path() / include.target);
    });
}

TEST(Architecture, PluginsIncludeTheSdkThemselvesAndTheStandardLibraryOnly) {
    expect_none("plugins", "a plugin needs the sdk only", [](const Include& include) {
        return !is_test(include.file) && !is_of_the_sdk_or_standard(include) && !is_of_a_bridge(include) &&
               !fs::exists(root / include.file.parent_path() / include.target);
    });
}

TEST(Architecture, PluginsDoNotIncludeOneAnother) {
    expect_none("plugins", "a plugin is one folder", [](const Include& include) {
        const fs::path target = (include.file.parent_path() / include.target).lexically_normal();
        const auto second = [](const fs::path& path) { return *std::next(path.begin()); };
        return leads_into(include, "plugins") && is_under(target, "plugins") &&
               second(target) != second(include.file);
    });
}

TEST(Architecture, EachThirdPartyLibraryHasItsFolders) {
    expect_only_in("yaml-cpp/", {"core/config"});
    expect_only_in("hdf5", {"core/output"});
    expect_only_in("dlfcn.h", {"core/registry", "plugins/umat"});
    expect_only_in("udunits2", {"core/base"});
    expect_only_in("openssl/", {"core/output"});
    expect_only_in("spdlog/", {"core/base", "apps"});
    expect_only_in("nlohmann/", {"core/output", "core/laboratory", "core/scheduler", "core/plan",
                                 "core/study", "core/certificate"});
    expect_only_in("Eigen/", {"core/output", "core/solver", "core/laboratory", "core/certificate"});
    expect_only_in("CLI/", {"apps"});
    expect_only_in("fmt/", {"core", "apps"});
}

TEST(Architecture, CoreNamesNoComponent) {
    const std::set<std::string> names = component_names();
    ASSERT_TRUE(names.count("mohr_coulomb") && names.count("pressuremeter") && names.count("wall"));
    // Words of mechanics as well, which the contract itself uses: refused as a text alone.
    const std::set<std::string> words = {"pressure", "wall"};
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "core")) {
        if (!entry.is_regular_file()) continue;
        const std::string text = text_of(entry.path());
        for (const std::string& name : names) {
            const std::string pattern = words.count(name) ? "\"" + name + "\"" : "\\b" + name + "\\b";
            EXPECT_FALSE(std::regex_search(text, std::regex(pattern))) << entry.path() << " names " << name;
        }
    }
}
