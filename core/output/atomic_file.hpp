// Files that appear whole or not at all: written under a temporary name, synced, renamed.
#pragma once
#include <filesystem>
#include <string_view>

namespace gault::core {

class FileDescriptor { // closes what open(2) returned
  public:
    FileDescriptor(const std::filesystem::path& file, int flags); // RunError: file and reason
    ~FileDescriptor();
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    operator int() const { return descriptor_; }

  private:
    int descriptor_;
};

bool write_all(int descriptor,
               std::string_view content); // false: see errno; part of it may have been written

// RunError from errno: "cannot write 'FILE': No space left on device".
[[noreturn]] void throw_write_error(const std::filesystem::path& file);

std::filesystem::path temporary_name(const std::filesystem::path& file); // beside it: "FILE.tmp"

// Syncs temporary_name(file) and gives it its final name, replacing what had it. RunError.
void publish(const std::filesystem::path& file);

void write_atomically(const std::filesystem::path& file, std::string_view content); // RunError

} // namespace gault::core
