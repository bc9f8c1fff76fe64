#include "core/base/error.hpp"

namespace gault::core {

std::string Location::text() const {
    if (line <= 0) return file;
    std::string position = std::to_string(line) + (column > 0 ? ":" + std::to_string(column) : "");
    return file.empty() ? position : file + ":" + position;
}

} // namespace gault::core
