#include "core/registry/registry.hpp"
#include "core/base/isa.hpp"
#include "core/base/log.hpp"
#include "core/base/suggest.hpp"
#include "core/registry/loader.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

namespace gault::core {
namespace {

namespace fs = std::filesystem;

constexpr const char* variants = "glibc-hwcaps";

std::vector<fs::path> libraries_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".so") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

// A variant alone would be a plugin that exists on some processors only.
void check_variants(const fs::path& folder) {
    for (const Isa isa : {Isa::v3, Isa::v4}) {
        const fs::path where = folder / variants / isa_name(isa);
        if (!fs::is_directory(where)) continue;
        for (const fs::path& file : libraries_in(where))
            if (!fs::exists(folder / file.filename()))
                throw InputError({file, 0, 0}, "is a variant without a baseline; the host expects " +
                                                   (folder / file.filename()).string() +
                                                   " for other processors");
    }
}

// The files that the search path names, in order; InputError for an entry that does not exist.
std::vector<fs::path> listed_files(const std::vector<fs::path>& search_path) {
    std::vector<fs::path> files;
    for (const fs::path& entry : search_path) {
        if (fs::is_directory(entry)) {
            check_variants(entry);
            for (fs::path& file : libraries_in(entry))
                files.push_back(std::move(file));
        } else {
            files.push_back(entry);
        }
    }
    return files;
}

fs::path resolved(const fs::path& file) {
    std::error_code error;
    fs::path path = fs::canonical(file, error);
    if (error)
        throw InputError({file, 0, 0},
                         "is on the plugin search path and cannot be reached: " + error.message());
    return path;
}

// The variant for this processor: beside the name that was listed, or beside the file that it leads to.
fs::path best_variant(const fs::path& listed, const fs::path& file, Isa best) {
    for (const Isa isa : {Isa::v4, Isa::v3}) {
        if (isa > best) continue;
        for (const fs::path& base : {listed, file}) {
            const fs::path variant = base.parent_path() / variants / isa_name(isa) / base.filename();
            if (fs::exists(variant)) return resolved(variant);
        }
    }
    return file;
}

bool met_before(std::vector<fs::path>& files, const fs::path& file) {
    const auto same = [&](const fs::path& other) { return fs::equivalent(other, file); }; // hard links, too
    if (std::ranges::any_of(files, same)) return true;
    files.push_back(file);
    return false;
}

} // namespace

const char* kind_name(gault_kind kind) {
    switch (kind) {
    case GAULT_MATERIAL:
        return "material";
    case GAULT_BOUNDARY:
        return "boundary";
    case GAULT_PROGRAM:
        return "program";
    case GAULT_OBSERVER:
        return "observer";
    default:
        return "component of an unknown kind";
    }
}

Registry::Registry(const std::vector<fs::path>& search_path) try {
    const Isa best = best_isa();
    std::vector<fs::path> met;
    std::map<std::pair<gault_kind, std::string>, fs::path> provider;
    for (const fs::path& listed : listed_files(search_path)) {
        const fs::path file = resolved(listed);
        if (met_before(met, file)) continue;
        const fs::path best_file = best_variant(listed, file, best);
        const gault_module& module = load_module(best_file);
        log::debug("{}: {} {}", best_file.string(), module.name, module.version);
        for (const gault_component* const* c = module.components; *c; ++c) {
            const auto [other, is_new] = provider.try_emplace({(*c)->kind, (*c)->name}, best_file);
            if (!is_new)
                throw InputError({best_file, 0, 0}, "provides the " + std::string(kind_name((*c)->kind)) +
                                                        " '" + (*c)->name + "', which " +
                                                        other->second.string() +
                                                        " provides already; take one of the two files away");
            components_.push_back({*c, &module, best_file});
        }
    }
    std::ranges::sort(components_, {}, [](const Component& c) {
        return std::tuple(c.declaration->kind, std::string_view(c.declaration->name));
    });
} catch (const fs::filesystem_error& e) { // a folder that cannot be read
    throw InputError({e.path1(), 0, 0},
                     "is on the plugin search path and cannot be read: " + e.code().message());
}

const Component& Registry::find(gault_kind kind, std::string_view name, const Location& where) const {
    std::vector<std::string> names;
    std::string elsewhere;
    for (const Component& c : components_) {
        if (c.declaration->kind == kind && name == c.declaration->name) return c;
        if (c.declaration->kind == kind)
            names.push_back(c.declaration->name);
        else if (name == c.declaration->name)
            elsewhere = kind_name(c.declaration->kind);
    }
    std::string text = "no " + std::string(kind_name(kind)) + " is named '" + std::string(name) + "'";
    if (!elsewhere.empty()) text += " (it is a " + elsewhere + ")";
    text += names.empty() ? "; no plugin that was found provides any" : suggestion(name, names);
    text += "; plugins of your own are found with `plugins:` in the scene, --plugin-path or GAULT_PLUGIN_PATH";
    throw InputError(where, text);
}

std::vector<fs::path> plugin_search_path(const std::vector<fs::path>& first,
                                         const std::vector<fs::path>& command_line) {
    std::vector<fs::path> path = first;
    path.insert(path.end(), command_line.begin(), command_line.end());
    if (const char* variable = std::getenv("GAULT_PLUGIN_PATH")) {
        const std::string_view text = variable;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find(':', begin), text.size());
            if (end > begin) path.emplace_back(text.substr(begin, end - begin));
            begin = end + 1;
        }
    }
    const fs::path executable = fs::read_symlink("/proc/self/exe");
    const fs::path own = executable.parent_path().parent_path() / "lib/gault/plugins";
    if (fs::is_directory(own)) path.push_back(own);
    return path;
}

} // namespace gault::core
