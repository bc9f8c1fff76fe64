#include "core/registry/answer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

namespace gault::core {
namespace {

bool is_continuation(char c) {
    return (c & 0xC0) == 0x80;
}

// Bytes of the character at the front; 0 where it is none, or a control character.
std::size_t character(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return lead >= 0x20 && lead != 0x7F;
    const std::size_t bytes = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
    if (bytes == 0 || bytes > text.size()) return 0;
    if (!std::ranges::all_of(text.substr(1, bytes - 1), is_continuation)) return 0;
    const auto next = static_cast<unsigned char>(text[1]);
    const bool is_control = lead == 0xC2 && next < 0xA0;
    const bool is_overlong = (lead == 0xE0 && next < 0xA0) || (lead == 0xF0 && next < 0x90);
    const bool is_no_character = (lead == 0xED && next >= 0xA0) || (lead == 0xF4 && next >= 0x90);
    return is_control || is_overlong || is_no_character ? 0 : bytes;
}

} // namespace

std::string plain_text(const char* text, std::size_t capacity) {
    std::string line;
    if (!text) return line;
    for (std::string_view rest(text, strnlen(text, capacity)); !rest.empty();) {
        const std::size_t bytes = character(rest);
        line += bytes ? rest.substr(0, bytes) : std::string_view(" ");
        rest.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    const auto last = line.find_last_not_of(' ');
    line.erase(last == std::string::npos ? 0 : last + 1);
    line.erase(0, line.find_first_not_of(' '));
    return line;
}

std::string error_text(const gault_error& error) {
    return plain_text(error.text, sizeof error.text);
}

double step_fraction(double suggest, double least, double most) {
    return std::clamp(std::isnan(suggest) ? 0.5 : suggest, least, most);
}

} // namespace gault::core
