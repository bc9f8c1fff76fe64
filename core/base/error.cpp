#include "core/base/error.hpp"

namespace gault::core {

std::string Location::text() const {
    if (line <= 0) return file;
    std::string text = file;
    if (!file.empty()) text += ':';
    text += std::to_string(line);
    if (column > 0) text.append(":").append(std::to_string(column));
    return text;
}

} // namespace gault::core
