#include "core/output/atomic_file.hpp"
#include "core/base/error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace gault::core {

namespace fs = std::filesystem;

FileDescriptor::FileDescriptor(const fs::path& file, int flags)
    : descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) throw_write_error(file);
}

FileDescriptor::~FileDescriptor() {
    ::close(descriptor_);
}

bool write_all(int descriptor, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

void throw_write_error(const fs::path& file) {
    throw RunError(
        fmt::format("cannot write '{}': {}", file.string(), std::generic_category().message(errno)));
}

fs::path temporary_name(const fs::path& file) {
    fs::path name = file;
    return name += ".tmp";
}

void publish(const fs::path& file) {
    const fs::path temporary = temporary_name(file);
    {
        const FileDescriptor descriptor(temporary, O_RDONLY);
        if (::fsync(descriptor) != 0) throw_write_error(temporary);
    }
    if (::rename(temporary.c_str(), file.c_str()) != 0) throw_write_error(file);
    const FileDescriptor folder(file.parent_path(), O_RDONLY | O_DIRECTORY);
    ::fsync(folder); // some file systems cannot sync a folder; the rename itself has succeeded
}

void write_atomically(const fs::path& file, std::string_view content) {
    const fs::path temporary = temporary_name(file);
    {
        const FileDescriptor descriptor(temporary, O_WRONLY | O_CREAT | O_TRUNC);
        if (!write_all(descriptor, content)) throw_write_error(file);
    }
    publish(file);
}

} // namespace gault::core
