#include "core/output/history.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace gault::core {

namespace {

// The kernel copies a write page by page and may stop between two pages when the process is killed.
constexpr std::size_t page = 4096;
constexpr std::size_t longest_number = 24; // -1.2345678901234567e-308

const std::filesystem::path& with_header(const std::filesystem::path& file,
                                         const std::vector<ColumnInfo>& columns) {
    std::string header;
    for (const ColumnInfo& column : columns)
        header += (header.empty() ? "" : ",") + column.header();
    write_atomically(file, header + "\n");
    return file;
}

} // namespace

std::string ColumnInfo::header() const {
    return unit == "1" ? name : name + "_" + unit;
}

HistoryFile::HistoryFile(std::filesystem::path file, const std::vector<ColumnInfo>& columns)
    : file_(std::move(file)), longest_row_(columns.size() * (longest_number + 1)),
      descriptor_(with_header(file_, columns), O_WRONLY | O_APPEND),
      size_(static_cast<off_t>(std::filesystem::file_size(file_))) {}

void HistoryFile::append(const std::vector<double>& values) {
    // The shortest digits that read back the same.
    std::string row = fmt::format("{}", fmt::join(values, ","));
    // Blanks fill a page whose rest could not hold the next row: no row then lies on two pages.
    const std::size_t free_in_page = page - static_cast<std::size_t>(size_) % page;
    if (row.size() < free_in_page && free_in_page - row.size() - 1 < longest_row_)
        row.resize(free_in_page - 1, ' ');
    row += '\n';

    if (!write_all(descriptor_, row)) {
        const int reason = errno;
        if (::ftruncate(descriptor_, size_) == 0) errno = reason;
        throw_write_error(file_);
    }
    size_ += static_cast<off_t>(row.size());
}

void HistoryFile::sync() {
    if (::fsync(descriptor_) != 0) throw_write_error(file_);
}

} // namespace gault::core
