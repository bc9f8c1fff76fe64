#include "core/registry/loader.hpp"
#include "core/base/error.hpp"
#include "core/registry/elf.hpp"
#include "core/registry/floating_point.hpp"
#include "core/registry/module_check.hpp"

#include <algorithm>
#include <cstdlib>
#include <cxxabi.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fstream>
#include <link.h>
#include <map>
#include <memory>
#include <stdexcept>

namespace gault::core {
namespace {

namespace fs = std::filesystem;

// By read(), not by mapping: a file that shrinks meanwhile gives an error and no signal.
std::vector<std::byte> read_bytes(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!fs::is_regular_file(file))
        throw std::runtime_error("is not a regular file; the host loads shared libraries");
    std::vector<std::byte> bytes(fs::file_size(file));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream) throw std::runtime_error("cannot be read");
    return bytes;
}

const ElfSymbol* symbol(const ElfLibrary& library, std::string_view name) {
    const auto found = std::ranges::find(library.defined, name, &ElfSymbol::name);
    return found == library.defined.end() ? nullptr : &*found;
}

// The dependency that defines the entry symbol, which is a plugin itself, or "".
fs::path dependency_with_entry(const ElfLibrary& library, const fs::path& file) {
    std::vector<std::string> folders = library.search_path;
    folders.push_back("$ORIGIN");
    for (std::string folder : folders) {
        for (const char* origin : {"$ORIGIN", "${ORIGIN}"})
            if (const auto at = folder.find(origin); at != std::string::npos)
                folder.replace(at, std::string_view(origin).size(), file.parent_path().string());
        for (const std::string& name : library.needed) {
            const fs::path candidate = fs::path(folder) / name;
            if (fs::is_regular_file(candidate) && symbol(read_elf(read_bytes(candidate)), GAULT_ENTRY_SYMBOL))
                return candidate.lexically_normal();
        }
    }
    return {};
}

[[noreturn]] void fail_without_entry(const ElfLibrary& library, const fs::path& file) {
    const std::string stem = "gault_module_v";
    for (const ElfSymbol& s : library.defined) {
        const std::string major = s.name.starts_with(stem) ? s.name.substr(stem.size()) : "";
        if (!major.empty() && std::ranges::all_of(major, [](char c) { return c >= '0' && c <= '9'; }))
            throw std::runtime_error(fmt::format("was built for ABI major {} ({}); this host offers {} ({})",
                                                 major, s.name, GAULT_ABI_MAJOR, GAULT_ENTRY_SYMBOL));
    }
    if (const fs::path other = dependency_with_entry(library, file); !other.empty())
        throw std::runtime_error(
            fmt::format("has no entry symbol " GAULT_ENTRY_SYMBOL " of its own; the one it sees belongs "
                        "to the library {} that it links to; the host expects it in the file itself",
                        other.string()));
    throw std::runtime_error("has no entry symbol; the host expects a plugin to export " GAULT_ENTRY_SYMBOL
                             " (define it with GAULT_EXPORT)");
}

ElfSymbol find_entry(const fs::path& file) {
    const ElfLibrary library = read_elf(read_bytes(file));
    const ElfSymbol* entry = symbol(library, GAULT_ENTRY_SYMBOL);
    if (!entry) fail_without_entry(library, file);
    if (!entry->is_data)
        throw std::runtime_error("exports " GAULT_ENTRY_SYMBOL
                                 " as code; the host expects constant data, a gault_module");
    return *entry;
}

std::string demangled(const std::string& name) {
    if (!name.starts_with("_Z")) return fmt::format("'{}'", name);
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(
        abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status), std::free);
    return text ? fmt::format("'{}' ({})", text.get(), name) : fmt::format("'{}'", name);
}

// What dlerror says, in one line that names what is missing and what helps.
std::string explain(std::string text, const fs::path& file) {
    std::ranges::replace(text, '\n', ' ');
    const std::string undefined = "undefined symbol: ", absent = ": cannot open shared object file";
    if (const auto at = text.find(undefined); at != std::string::npos) {
        const auto begin = at + undefined.size();
        const std::string name = text.substr(begin, text.find_first_of(", \t", begin) - begin);
        return fmt::format(
            "wants the symbol {}, which neither it nor a library it links to defines; link what defines it "
            "(the linker option -Wl,-z,defs finds this while building)",
            demangled(name));
    }
    if (const auto at = text.find(absent); at != std::string::npos)
        return fmt::format(
            "wants the library '{}', which is not found on this system; install it, or link with a run path",
            text.substr(0, at));
    if (text.starts_with(file.string() + ": ")) text.erase(0, file.string().size() + 2);
    return "cannot be opened: " + text;
}

void* open(const fs::path& file) {
    // By file: it stays open, so opening it again would show nothing.
    static std::map<fs::path, std::string> changes;
    const FloatingPointMode mode;
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    std::string& changed = changes[file];
    if (const std::string now = mode.restore(); !now.empty()) changed = now;
    if (!handle) throw std::runtime_error(explain(dlerror(), file));
    if (!changed.empty())
        throw std::runtime_error(
            fmt::format("changes the floating-point mode of the whole process ({}); the host expects it "
                        "unchanged: build and link without -ffast-math",
                        changed));
    return handle;
}

// A unique (STB_GNU_UNIQUE) symbol is one for the whole process, in spite of RTLD_LOCAL: the first file's.
const void* own_entry(void* handle) {
    const void* entry = dlsym(handle, GAULT_ENTRY_SYMBOL);
    link_map *own = nullptr, *owner = nullptr;
    Dl_info info{};
    if (!entry || dlinfo(handle, RTLD_DI_LINKMAP, &own) != 0 ||
        dladdr1(entry, &info, reinterpret_cast<void**>(&owner), RTLD_DL_LINKMAP) == 0)
        throw std::runtime_error("has an entry symbol " GAULT_ENTRY_SYMBOL " that leads nowhere");
    if (owner != own)
        throw std::runtime_error(
            fmt::format("has an entry symbol " GAULT_ENTRY_SYMBOL " that leads to {}; the host expects it "
                        "in the file itself: compile with -fno-gnu-unique and -fvisibility=hidden",
                        owner->l_name));
    return entry;
}

} // namespace

const gault_module& load_module(const fs::path& file) {
    try {
        const ElfSymbol entry = find_entry(file);
        const auto& module = *static_cast<const gault_module*>(own_entry(open(file)));
        check_module(module, entry.bytes);
        return module;
    } catch (const std::exception& e) {
        throw InputError({file, 0, 0}, e.what());
    }
}

} // namespace gault::core
