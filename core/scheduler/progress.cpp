#include "core/scheduler/progress.hpp"
#include "core/base/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace gault::core {
namespace {

double seconds(std::chrono::steady_clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

std::string duration_text(double s) {
    if (s < 100.0) return fmt::format("{:.0f} s", s);
    return s < 6000.0 ? fmt::format("{:.0f} min", s / 60.0) : fmt::format("{:.1f} h", s / 3600.0);
}

} // namespace

Progress::Progress(std::size_t points, bool quiet)
    : points_(points), quiet_(quiet), terminal_(isatty(STDERR_FILENO)),
      start_(std::chrono::steady_clock::now()), last_(start_) {}

Progress::~Progress() {
    if (terminal_ && !quiet_) std::fputs("\r\x1b[K", stderr);
}

bool Progress::due(int64_t step) {
    if (quiet_ || step % 16 != 0) return false;
    return seconds(std::chrono::steady_clock::now() - last_) > (terminal_ ? 0.2 : 5.0);
}

void Progress::show(const State& state) {
    const auto now = std::chrono::steady_clock::now();
    const double rate =
        static_cast<double>(state.step - last_step_) * static_cast<double>(points_) / seconds(now - last_);
    const bool known = std::isfinite(state.share);
    const double done = known ? std::clamp(state.share, 0.0, 1.0) : 0.0;
    const std::string left =
        done > 0.0 ? duration_text(seconds(now - start_) * (1.0 - done) / done) + " left" : "";
    const std::string text = fmt::format("step {}  t = {:.4g} s  {}  {:.1f} M point-steps/s  {}", state.step,
                                         state.time, state.measure, rate * 1e-6, left);
    constexpr std::size_t width = 24;
    const auto full = static_cast<std::size_t>(done * width);
    const std::string percent = known ? fmt::format("{:3.0f} %  ", 100.0 * done) : "";
    if (terminal_) {
        const std::string bar =
            known ? "[" + std::string(full, '#') + std::string(width - full, '.') + "] " : "";
        std::fprintf(stderr, "\r\x1b[K%s%s%s", bar.c_str(), percent.c_str(), text.c_str());
        std::fflush(stderr);
    } else {
        log::info("{}{}", percent, text);
    }
    last_ = now;
    last_step_ = state.step;
}

} // namespace gault::core
