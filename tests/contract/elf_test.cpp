// Files that are no library for this host, or a damaged one: said before anything is opened, whatever the
// bytes.
#include "core/registry/elf.hpp"
#include "core/registry/registry.hpp"
#include "tests/contract/scratch.hpp"

#include <algorithm>
#include <cstring>
#include <elf.h>
#include <gtest/gtest.h>
#include <random>

using namespace gault::core;

namespace {

const std::string valid = contents(CONTRACT_DIR "/good/hypoelastic.so");

ElfLibrary read(const std::string& bytes) {
    return read_elf(std::as_bytes(std::span(bytes)));
}

std::string complaint(const std::string& bytes) {
    try {
        read(bytes);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

template <class T>
std::string patched(std::size_t offset, T value) {
    std::string bytes = valid;
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return bytes;
}

} // namespace

TEST(ElfFile, OfAPluginListsItsEntryAndItsDependencies) {
    const ElfLibrary library = read(valid);
    ASSERT_EQ(library.defined.size(), 1u); // hidden visibility: the entry and nothing else
    EXPECT_EQ(library.defined[0].name, "gault_module_v1");
    EXPECT_TRUE(library.defined[0].is_data);
    EXPECT_GE(library.defined[0].bytes, sizeof(gault_module));
    EXPECT_TRUE(std::ranges::find(library.needed, "libc.so.6") != library.needed.end());
}

TEST(ElfFile, ThatIsNoneIsQuoted) {
    EXPECT_EQ(complaint("hello, world"),
              "is not an ELF file (it starts with 'hello, w'); the host loads ELF shared libraries");
    EXPECT_EQ(complaint("MZ\x90"),
              "is not an ELF file (it starts with 'MZ\\x90'); the host loads ELF shared libraries");
    EXPECT_EQ(complaint(""), "is empty; the host loads ELF shared libraries");
}

TEST(ElfFile, ForAnotherMachineNamesBoth) {
    const std::size_t machine = offsetof(Elf64_Ehdr, e_machine);
    EXPECT_EQ(complaint(patched<Elf64_Half>(machine, EM_AARCH64)),
              "is built for AArch64; the host runs on x86-64");
    EXPECT_EQ(complaint(patched<Elf64_Half>(machine, 9999)),
              "is built for ELF machine 9999; the host runs on x86-64");
    EXPECT_EQ(complaint(patched<char>(EI_CLASS, ELFCLASS32)),
              "is a 32-bit ELF file; the host loads 64-bit libraries");
    EXPECT_EQ(complaint(patched<char>(EI_DATA, ELFDATA2MSB)),
              "is not little-endian; the host is little-endian");
}

TEST(ElfFile, OfAnotherTypeNamesBoth) {
    const std::size_t type = offsetof(Elf64_Ehdr, e_type);
    EXPECT_EQ(complaint(patched<Elf64_Half>(type, ET_REL)),
              "is an object file; the host loads shared libraries");
    EXPECT_EQ(complaint(patched<Elf64_Half>(type, ET_EXEC)),
              "is an executable; the host loads shared libraries");
    EXPECT_EQ(complaint(contents("/proc/self/exe")), "is an executable; the host loads shared libraries");
}

TEST(ElfFile, WithoutSectionTableIsStillALibrary) {
    std::string stripped = patched<Elf64_Off>(offsetof(Elf64_Ehdr, e_shoff), 0);
    EXPECT_EQ(read(stripped).defined.size(), 1u);
}

TEST(ElfFile, TruncatedAnywhereIsSaidToBe) {
    for (std::size_t size = 4; size < valid.size(); size += 61) {
        const std::string text = complaint(valid.substr(0, size));
        EXPECT_TRUE(text.starts_with("is truncated or damaged: its ")) << size << ": " << text;
        EXPECT_TRUE(text.ends_with("the file has " + std::to_string(size) + " bytes"))
            << size << ": " << text;
    }
}

TEST(ElfFile, WithFlippedBytesNeverDoesHarm) {
    std::mt19937 random(20240229);
    const auto flip = [&](std::string& bytes, std::size_t end) {
        bytes[random() % end] ^= static_cast<char>(1 + random() % 255);
    };
    const std::size_t headers = sizeof(Elf64_Ehdr) + 12 * sizeof(Elf64_Phdr);
    std::size_t refused = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string bytes = valid;
        for (int flips = 1 + i % 4; flips > 0; --flips)
            flip(bytes, i % 2 ? headers : bytes.size());
        refused += !complaint(bytes).empty();
    }
    EXPECT_GT(refused, 1000u);
}

TEST(TruncatedPlugin, IsRefusedByTheRegistryByName) {
    const Scratch scratch;
    const auto file = scratch.write("cut.so", valid.substr(0, valid.size() - 100));
    try {
        Registry registry({scratch.path});
        ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
        EXPECT_TRUE(std::string(e.what()).starts_with(file.string() + ": is truncated or damaged: "))
            << e.what();
    }
}
