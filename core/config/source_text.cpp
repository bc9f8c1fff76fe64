#include "core/config/source_text.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace gault::core::config {
namespace {

// Bytes of the UTF-8 character at `offset`; 0 where there is none (overlong, surrogate, beyond U+10FFFF, cut
// short).
std::size_t utf8_length(std::string_view text, std::size_t offset) {
    const auto byte = [&](std::size_t i) -> std::uint32_t {
        return offset + i < text.size() ? static_cast<unsigned char>(text[offset + i]) : 0;
    };
    const std::uint32_t first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4) return 0;
    std::uint32_t code = first & (0xFFu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3F);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    return overlong || (code >= 0xD800 && code <= 0xDFFF) || code > 0x10FFFF ? 0 : length;
}

bool is_text(unsigned char c) {
    return c >= 0x20 ? c != 0x7F : c == '\t' || c == '\n' || c == '\r';
}

} // namespace

SourceText::SourceText(std::string text, const std::string& file)
    : text_(std::move(text)), file_(std::make_shared<const std::string>(file)) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
    lines_.push_back(0);
    continuations_.push_back(0);
    for (std::size_t i = 0; i < text_.size(); ++i) {
        if (text_[i] == '\n') lines_.push_back(i + 1);
        continuations_.push_back(continuations_.back() + ((text_[i] & 0xC0) == 0x80 ? 1 : 0));
    }
    refuse_binary();
    refuse_tabs();
}

Place SourceText::place(std::size_t offset) const {
    offset = std::min(offset, text_.size());
    const auto line = std::upper_bound(lines_.begin(), lines_.end(), offset) - 1;
    const std::size_t characters = offset - *line - (continuations_[offset] - continuations_[*line]);
    return {file_, static_cast<int>(line - lines_.begin()) + 1, static_cast<int>(characters) + 1};
}

std::size_t SourceText::offset(int line, int byte) const {
    if (line < 0 || byte < 0 || static_cast<std::size_t>(line) >= lines_.size()) return text_.size();
    return std::min(lines_[static_cast<std::size_t>(line)] + static_cast<std::size_t>(byte), text_.size());
}

void SourceText::refuse_binary() const {
    for (std::size_t i = 0; i < text_.size();) {
        const std::size_t length = utf8_length(text_, i);
        if (length == 0 || !is_text(static_cast<unsigned char>(text_[i]))) {
            char byte[8];
            std::snprintf(byte, sizeof byte, "0x%02X", static_cast<unsigned char>(text_[i]));
            throw InputError(place(i).location(), std::string("not UTF-8 text: byte ") + byte);
        }
        i += length;
    }
}

// yaml-cpp takes a tab for part of the value
void SourceText::refuse_tabs() const {
    for (const std::size_t line : lines_) {
        const std::size_t word = text_.find_first_not_of(" \t", line);
        if (word == std::string::npos || text_[word] == '\n' || text_[word] == '\r' || text_[word] == '#')
            continue;
        const std::size_t tab = text_.find('\t', line);
        if (tab < word)
            throw InputError(place(tab).location(), "a tab in the indentation; YAML indents with spaces");
    }
}

std::size_t SourceText::unclosed_quote(std::size_t offset) const {
    if (offset < text_.size() && text_[offset] == '&') // an anchor stands before its value
        offset = text_.find_first_not_of(" \t\r\n",
                                         std::min(text_.find_first_of(" \t\r\n", offset), text_.size()));
    if (offset >= text_.size() || (text_[offset] != '"' && text_[offset] != '\'')) return std::string::npos;
    const char quote = text_[offset];
    for (std::size_t i = offset + 1; i < text_.size(); ++i) {
        if (quote == '"' && text_[i] == '\\')
            ++i;
        else if (quote == '\'' && text_.compare(i, 2, "''") == 0)
            ++i;
        else if (text_[i] == quote)
            return std::string::npos;
    }
    return offset;
}

} // namespace gault::core::config
