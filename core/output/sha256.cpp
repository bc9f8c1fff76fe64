#include "core/output/results.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <system_error>

namespace gault::core {

std::string sha256_of_file(const std::filesystem::path& file) {
    const auto fail = [&] {
        throw InputError(
            fmt::format("cannot read '{}': {}", file.string(), std::generic_category().message(errno)));
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
    if (!stream) fail();
    const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);

    std::vector<unsigned char> block(1 << 16);
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), stream.get()))
        EVP_DigestUpdate(context.get(), block.data(), count);
    if (std::ferror(stream.get())) fail();

    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned length = 0;
    EVP_DigestFinal_ex(context.get(), digest.data(), &length);
    return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + length, ""));
}

} // namespace gault::core
