// A UMAT's shared library: found, opened once and, as a plugin, never closed.
#pragma once
#include <gault/component.hpp>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace umat {

// A library linked with -ffast-math makes the whole process flush small numbers to zero while it is opened.
class FloatingPointMode {
  public:
    FloatingPointMode() = default;
    FloatingPointMode(const FloatingPointMode&) = delete;
#if defined(__SSE2__)
    ~FloatingPointMode() {
        _mm_setcsr(before_);
    }

  private:
    unsigned before_ = _mm_getcsr();
#else
    ~FloatingPointMode() {}
#endif
};

// Runs `body`; false where it ended in leave(), below. Between the two are only frames of C and Fortran.
inline thread_local std::jmp_buf* way_out = nullptr;
template <class Body>
bool runs_to_its_end(const Body& body) {
    std::jmp_buf here;
    way_out = &here;
    if (setjmp(here) != 0) {
        way_out = nullptr;
        return false;
    }
    body();
    way_out = nullptr;
    return true;
}
inline void leave() { // XIT
    if (way_out) std::longjmp(*way_out, 1);
}

struct Library {
    std::string file;
    void* handle;
    std::mutex alone; // held while code of it runs that may not run twice at a time
};

// The folder of UMATs beside the folder of plugins: lib/gault/umat for lib/gault/plugins.
inline std::string own_folder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<void*>(&leave), &info) == 0 || !info.dli_fname) return "";
    std::string plugins = info.dli_fname;
    plugins.erase(std::min(plugins.rfind('/'), plugins.size()));
    if (const auto variant = plugins.rfind("/glibc-hwcaps/"); variant != std::string::npos)
        plugins.erase(variant);
    return plugins + "/../umat";
}

inline std::vector<std::string> places(const std::string& name) {
    if (name[0] == '/') return {name};
    std::vector<std::string> found{"./" + name};
    const char* variable = std::getenv("GAULT_UMAT_PATH");
    const std::string folders = variable ? variable : "";
    for (std::size_t begin = 0; begin < folders.size();) {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        if (end > begin) found.push_back(folders.substr(begin, end - begin) + "/" + name);
        begin = end + 1;
    }
    if (const std::string folder = own_folder(); !folder.empty()) found.push_back(folder + "/" + name);
    return found;
}

inline std::string find(const std::string& name) {
    if (name.empty()) throw gault::Invalid("library", "is empty; it is the name of a shared library");
    std::string looked;
    for (const std::string& place : places(name)) {
        if (std::FILE* file = std::fopen(place.c_str(), "rb")) {
            std::fclose(file);
            return place;
        }
        looked += (looked.empty() ? "" : ", ") + place;
    }
    throw gault::Invalid("library", "is not found; looked for " + looked);
}

// What dlerror says, and what helps.
inline std::string explain(const std::string& text) {
    const std::string undefined = "undefined symbol: ";
    const auto at = text.find(undefined);
    if (at == std::string::npos) return "cannot be opened: " + text;
    const std::string symbol = text.substr(
        at + undefined.size(), text.find_first_of(", \t\n", at + undefined.size()) - at - undefined.size());
    const bool in_stub = symbol == "xit_" || symbol == "stdb_abqerr_";
    return "cannot be opened: it wants '" + symbol + "', " +
           (in_stub ? "which is part of Abaqus; compile abaqus_stub.c of this plugin together with it"
                    : "which neither it nor a library that it links to defines; utilities of Abaqus are not "
                      "here") +
           " (" + text + ")";
}

// Components are created one after the other, on the host's main thread.
inline Library& open(const std::string& name) {
    static std::map<void*, std::unique_ptr<Library>> all;
    const std::string file = find(name);
    const FloatingPointMode as_before;
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw gault::Invalid("library", explain(dlerror()));
    std::unique_ptr<Library>& library = all[handle];
    if (!library) {
        library.reset(new Library{file, handle, {}});
        if (void* hook = dlsym(handle, "gault_umat_xit")) *static_cast<void (**)()>(hook) = &leave;
    }
    return *library;
}

inline void* find_symbol(const Library& library, const std::string& symbol) {
    if (void* found = dlsym(library.handle, symbol.c_str())) return found;
    const char* why = dlerror();
    throw gault::Invalid("symbol", "'" + symbol +
                                       "' is not in the library; a Fortran SUBROUTINE UMAT is usually "
                                       "'umat_', in lower case and with an underscore (" +
                                       (why ? why : "it is NULL") + ")");
}

} // namespace umat
