// What an ELF shared library says of itself, read without opening it as one: a damaged file costs a sentence,
// where dlopen would cost the process (SIGBUS on a truncated file).
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gault::core {

struct ElfSymbol {
    std::string name;
    bool is_data;
    std::uint64_t bytes;
};

struct ElfLibrary {
    std::vector<std::string> needed;      // libraries it depends on
    std::vector<std::string> search_path; // where it looks for them first; may hold $ORIGIN
    std::vector<ElfSymbol> defined;       // dynamic symbols that the file itself defines
};

// `bytes` is the whole file. Every offset is checked before it is followed. Throws std::runtime_error: what
// the file is and what the host loads, to follow "FILE: ".
ElfLibrary read_elf(std::span<const std::byte> bytes);

} // namespace gault::core
