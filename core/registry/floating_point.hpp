// Notices when foreign code changes how the processor computes (a library linked with -ffast-math does so for
// the whole process, while it is being loaded), and puts it back.
#pragma once
#include <string>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace gault::core {

class FloatingPointMode {
  public:
    // What changed since construction, in words, or ""; the mode is as before afterwards.
    std::string restore() const {
#if defined(__x86_64__)
        constexpr unsigned mask = 0xFFC0; // control bits; the flags below them change with any arithmetic
        const unsigned now = _mm_getcsr(), changed = (now ^ before_) & mask;
        if (!changed) return "";
        _mm_setcsr((now & ~mask) | (before_ & mask));
        std::string words;
        if (changed & 0x8000) words += ", flush to zero";
        if (changed & 0x0040) words += ", denormals are zero";
        if (changed & 0x6000) words += ", rounding";
        if (changed & 0x1F80) words += ", exception masks";
        return words.substr(2);
#else
        return "";
#endif
    }

  private:
#if defined(__x86_64__)
    unsigned before_ = _mm_getcsr();
#endif
};

} // namespace gault::core
