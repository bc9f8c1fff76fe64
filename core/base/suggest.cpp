#include "core/base/suggest.hpp"

#include <algorithm>
#include <numeric>

namespace gault::core {
namespace {

constexpr std::size_t few = 16; // candidates worth listing in one line

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours, one each.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                current[j] = std::min(current[j], before[j - 2] + 1);
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
        else if (c == '-' || c == ' ')
            c = '_';
    return result;
}

} // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    const std::string wanted = lower(word);
    std::string best;
    std::size_t best_distance = 0;
    for (const std::string& candidate : candidates) {
        const std::size_t wrong = distance(wanted, lower(candidate));
        if (3 * wrong > std::max(wanted.size(), candidate.size())) continue;
        if (!best.empty() && wrong >= best_distance) continue;
        best = candidate;
        best_distance = wrong;
    }
    return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
    std::string text;
    if (const std::string near = nearest(word, candidates); !near.empty())
        text = "; did you mean '" + near + "'?";
    if (candidates.empty() || candidates.size() > few) return text;
    text += "; allowed: ";
    for (std::size_t i = 0; i < candidates.size(); ++i)
        text += (i ? ", " : "") + candidates[i];
    return text;
}

} // namespace gault::core
