// Directions of dependency, read from the #include lines: plugins -> sdk <- core <- apps, and one third-party
// library, one folder.
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
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

void expect_only_in(const std::string& library, const std::string& home) {
    for (const char* folder : {"sdk", "core", "plugins", "apps"})
        expect_none(folder, library + " belongs to " + home + " alone", [&](const Include& include) {
            return include.target.starts_with(library) && !is_under(include.file, home);
        });
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
        const bool system = include.target.find('/') == std::string::npos;
        return !include.target.starts_with("gault/") &&
               !(system && !fs::exists(root / include.file.parent_path() / include.target)) &&
               !leads_into(include, "sdk");
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

TEST(Architecture, EachThirdPartyLibraryHasOneHome) {
    expect_only_in("yaml-cpp/", "core/config");
    expect_only_in("hdf5", "core/output");
    expect_only_in("H5", "core/output");
    expect_only_in("dlfcn.h", "core/registry");
    expect_only_in("udunits2", "core/base");
    expect_only_in("openssl/", "core/output");
}
