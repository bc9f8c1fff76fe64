// The bytes of a document: whether they are text, and where in them a line and column lie.
#pragma once
#include "core/config/document.hpp"

#include <cstdint>

namespace gault::core::config {

class SourceText {
  public:
    // Removes a byte order mark. Throws InputError at the first byte that is not UTF-8 text, or tab that
    // indents.
    SourceText(std::string text, const std::string& file);

    const std::string& text() const { return text_; }
    Place place(std::size_t offset) const;        // column in characters, from 1
    std::size_t offset(int line, int byte) const; // both from 0, as yaml-cpp counts

    // The offset of a quote that is opened at or just after `offset` and never closed; npos otherwise.
    std::size_t unclosed_quote(std::size_t offset) const;

  private:
    std::string text_;
    std::vector<std::size_t> lines_;           // where each starts
    std::vector<std::uint32_t> continuations_; // bytes before an offset that do not begin a character
    std::shared_ptr<const std::string> file_;
    void refuse_binary() const;
    void refuse_tabs() const;
};

} // namespace gault::core::config
