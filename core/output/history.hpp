// history.csv: a header, then one row per write(2), so that a kill never leaves part of a row.
#pragma once
#include "core/output/atomic_file.hpp"
#include "core/output/results.hpp"

#include <sys/types.h>

namespace gault::core {

class HistoryFile {
  public:
    HistoryFile(std::filesystem::path file, const std::vector<ColumnInfo>& columns); // RunError

    // RunError when the file system refuses; the file is then as it was before.
    void append(const std::vector<double>& values);
    void sync(); // RunError

  private:
    std::filesystem::path file_;
    std::size_t longest_row_;
    FileDescriptor descriptor_;
    off_t size_;
};

} // namespace gault::core
