#include "core/registry/elf.hpp"

#include <algorithm>
#include <cstring>
#include <elf.h>
#include <fmt/format.h>
#include <stdexcept>

namespace gault::core {
namespace {

using Bytes = std::span<const std::byte>;

#if defined(__x86_64__)
constexpr Elf64_Half host_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half host_machine = EM_AARCH64;
#else
#error "core/registry/elf.cpp: name the ELF machine of this processor"
#endif

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw std::runtime_error(fmt::format(format, std::forward<Args>(args)...));
}

// A part of the file: [offset, offset + length).
Bytes part(Bytes file, std::uint64_t offset, std::uint64_t length, const char* what) {
    if (offset > file.size() || length > file.size() - offset)
        fail("is truncated or damaged: its {} needs {} bytes from byte {} on, the file has {} bytes", what,
             length, offset, file.size());
    return file.subspan(offset, length);
}

template <class T>
T read(Bytes file, std::uint64_t offset, const char* what) {
    T value;
    std::memcpy(&value, part(file, offset, sizeof(T), what).data(), sizeof(T));
    return value;
}

template <class T>
std::vector<T> read_table(Bytes file, std::uint64_t offset, std::uint64_t count, const char* what) {
    const std::uint64_t most = file.size() / sizeof(T) + 1; // keeps the product from wrapping
    const Bytes source = part(file, offset, std::min(count, most) * sizeof(T), what);
    std::vector<T> table(count);
    if (count) std::memcpy(table.data(), source.data(), source.size());
    return table;
}

std::string machine_name(Elf64_Half machine) {
    switch (machine) {
    case EM_X86_64:
        return "x86-64";
    case EM_AARCH64:
        return "AArch64";
    case EM_386:
        return "i386";
    case EM_ARM:
        return "ARM";
    case EM_PPC64:
        return "PowerPC 64";
    case EM_RISCV:
        return "RISC-V";
    default:
        return fmt::format("ELF machine {}", machine);
    }
}

std::string type_name(Elf64_Half type) {
    switch (type) {
    case ET_REL:
        return "an object file";
    case ET_EXEC:
        return "an executable";
    case ET_CORE:
        return "a core dump";
    default:
        return fmt::format("of ELF type {}", type);
    }
}

std::string first_bytes(Bytes file) {
    std::string text;
    for (const std::byte byte : file.first(std::min<std::size_t>(file.size(), 8))) {
        const int c = std::to_integer<int>(byte);
        if (c >= 0x20 && c < 0x7f)
            text += static_cast<char>(c);
        else
            text += fmt::format("\\x{:02x}", c);
    }
    return text;
}

Elf64_Ehdr read_header(Bytes file) {
    if (file.empty()) fail("is empty; the host loads ELF shared libraries");
    if (std::memcmp(file.data(), ELFMAG, std::min<std::size_t>(SELFMAG, file.size())) != 0)
        fail("is not an ELF file (it starts with '{}'); the host loads ELF shared libraries",
             first_bytes(file));
    const Bytes ident = part(file, 0, EI_NIDENT, "ELF identification");
    if (const int found = std::to_integer<int>(ident[EI_CLASS]); found != ELFCLASS64)
        fail("is {}; the host loads 64-bit libraries", found == ELFCLASS32
                                                           ? std::string("a 32-bit ELF file")
                                                           : fmt::format("an ELF file of class {}", found));
    if (ident[EI_DATA] != std::byte{ELFDATA2LSB}) fail("is not little-endian; the host is little-endian");
    const auto header = read<Elf64_Ehdr>(file, 0, "ELF header");
    if (header.e_machine != host_machine)
        fail("is built for {}; the host runs on {}", machine_name(header.e_machine),
             machine_name(host_machine));
    if (header.e_type != ET_DYN) fail("is {}; the host loads shared libraries", type_name(header.e_type));
    if (header.e_version != EV_CURRENT || ident[EI_VERSION] != std::byte{EV_CURRENT})
        fail("is damaged: its ELF version is {}; the host knows {}", header.e_version, EV_CURRENT);
    if (header.e_phentsize != sizeof(Elf64_Phdr))
        fail("is damaged: its program headers have {} bytes each; the host expects {}", header.e_phentsize,
             sizeof(Elf64_Phdr));
    return header;
}

// Stripping may remove the section table, but one that is named and absent means that the end of the file is
// missing.
void check_sections(Bytes file, const Elf64_Ehdr& header) {
    if (header.e_shoff == 0) return;
    if (header.e_shentsize != sizeof(Elf64_Shdr))
        fail("is damaged: its section headers have {} bytes each; the host expects {}", header.e_shentsize,
             sizeof(Elf64_Shdr));
    for (const auto& section : read_table<Elf64_Shdr>(file, header.e_shoff, header.e_shnum, "section table"))
        if (section.sh_type != SHT_NOBITS && section.sh_type != SHT_NULL)
            part(file, section.sh_offset, section.sh_size, "section");
}

// The file as its loader will map it.
class Image {
  public:
    Image(Bytes file, const Elf64_Ehdr& header)
        : file_(file),
          segments_(read_table<Elf64_Phdr>(file, header.e_phoff, header.e_phnum, "program header table")) {
        std::uint64_t end = 0;
        for (const Elf64_Phdr& s : segments_) {
            if (s.p_type != PT_LOAD) continue;
            part(file, s.p_offset, s.p_filesz, "loadable segment");
            const bool aligned = s.p_align <= 1 || s.p_vaddr % s.p_align == s.p_offset % s.p_align;
            const bool fits = s.p_filesz == s.p_memsz || (s.p_filesz < s.p_memsz && s.p_flags & PF_W);
            if (!fits || s.p_vaddr < end || s.p_vaddr + s.p_memsz < s.p_vaddr || !aligned)
                fail("is damaged: its loadable segments overlap or contradict themselves");
            end = s.p_vaddr + s.p_memsz;
        }
        if (end == 0) fail("is damaged: it has no loadable segment");
    }

    const Elf64_Phdr* segment(Elf64_Word type) const {
        const auto found = std::ranges::find(segments_, type, &Elf64_Phdr::p_type);
        return found == segments_.end() ? nullptr : &*found;
    }

    // The bytes from a virtual address to the end of its segment.
    Bytes from(std::uint64_t address, const char* what) const {
        for (const Elf64_Phdr& s : segments_)
            if (s.p_type == PT_LOAD && address >= s.p_vaddr && address - s.p_vaddr < s.p_filesz)
                return file_.subspan(s.p_offset + (address - s.p_vaddr), s.p_filesz - (address - s.p_vaddr));
        fail("is damaged: its {} lies at address {:#x}, outside every loadable segment", what, address);
    }

    Bytes dynamic() const {
        const Elf64_Phdr* s = segment(PT_DYNAMIC);
        if (!s) fail("is not a shared library: it has no dynamic section");
        return part(from(s->p_vaddr, "dynamic section"), 0, s->p_filesz, "dynamic section");
    }

  private:
    Bytes file_;
    std::vector<Elf64_Phdr> segments_;
};

struct Dynamic {
    std::uint64_t strings = 0, string_bytes = 0, symbols = 0, hash = 0, gnu_hash = 0, flags_1 = 0;
    std::vector<std::uint64_t> needed, search_path; // offsets into the strings
};

Dynamic read_dynamic(Bytes section) {
    Dynamic d;
    for (const auto& entry :
         read_table<Elf64_Dyn>(section, 0, section.size() / sizeof(Elf64_Dyn), "dynamic section")) {
        const std::uint64_t value = entry.d_un.d_val;
        switch (entry.d_tag) {
        case DT_NULL:
            return d;
        case DT_STRTAB:
            d.strings = value;
            break;
        case DT_STRSZ:
            d.string_bytes = value;
            break;
        case DT_SYMTAB:
            d.symbols = value;
            break;
        case DT_HASH:
            d.hash = value;
            break;
        case DT_GNU_HASH:
            d.gnu_hash = value;
            break;
        case DT_FLAGS_1:
            d.flags_1 = value;
            break;
        case DT_NEEDED:
            d.needed.push_back(value);
            break;
        case DT_RPATH:
        case DT_RUNPATH:
            d.search_path.push_back(value);
            break;
        }
    }
    fail("is damaged: its dynamic section has no end");
}

std::string string_at(Bytes strings, std::uint64_t offset) {
    if (offset >= strings.size())
        fail("is damaged: a name lies at byte {} of its string table, which has {} bytes", offset,
             strings.size());
    const char* text = reinterpret_cast<const char*>(strings.data()) + offset;
    return std::string(text, strnlen(text, strings.size() - offset));
}

// The table does not say its length; the GNU hash table does: the last chain ends with the last symbol.
std::uint64_t count_by_gnu_hash(Bytes table) {
    const char* what = "symbol hash table";
    const auto buckets = read<std::uint32_t>(table, 0, what), first = read<std::uint32_t>(table, 4, what);
    const std::uint64_t bucket_offset = 16 + 8 * std::uint64_t{read<std::uint32_t>(table, 8, what)};
    const auto starts = read_table<std::uint32_t>(table, bucket_offset, buckets, what);
    std::uint64_t last = starts.empty() ? 0 : *std::ranges::max_element(starts);
    if (last < first) return first;
    const std::uint64_t chains = bucket_offset + 4 * std::uint64_t{buckets};
    while (!(read<std::uint32_t>(table, chains + 4 * (last - first), what) & 1))
        ++last;
    return last + 1;
}

std::uint64_t symbol_count(const Image& image, const Dynamic& dynamic) {
    if (dynamic.gnu_hash) return count_by_gnu_hash(image.from(dynamic.gnu_hash, "symbol hash table"));
    if (dynamic.hash)
        return read<std::uint32_t>(image.from(dynamic.hash, "symbol hash table"), 4, "symbol hash table");
    fail("is damaged: it has no symbol hash table");
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        if (end > begin) parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

} // namespace

ElfLibrary read_elf(std::span<const std::byte> bytes) {
    const Elf64_Ehdr header = read_header(bytes);
    const Image image(bytes, header);
    check_sections(bytes, header);
    const Dynamic dynamic = read_dynamic(image.dynamic());
    if (dynamic.flags_1 & DF_1_PIE) fail("is an executable; the host loads shared libraries");

    const Bytes strings =
        part(image.from(dynamic.strings, "string table"), 0, dynamic.string_bytes, "string table");
    ElfLibrary library;
    for (const std::uint64_t offset : dynamic.needed)
        library.needed.push_back(string_at(strings, offset));
    for (const std::uint64_t offset : dynamic.search_path)
        for (std::string& folder : split(string_at(strings, offset)))
            library.search_path.push_back(std::move(folder));

    const Bytes symbols = image.from(dynamic.symbols, "symbol table");
    for (const auto& symbol :
         read_table<Elf64_Sym>(symbols, 0, symbol_count(image, dynamic), "symbol table")) {
        if (symbol.st_shndx == SHN_UNDEF || symbol.st_name == 0) continue;
        const bool is_data = ELF64_ST_TYPE(symbol.st_info) == STT_OBJECT;
        library.defined.push_back({string_at(strings, symbol.st_name), is_data, symbol.st_size});
    }
    return library;
}

} // namespace gault::core
