#include "core/base/team.hpp"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace gault::core {
namespace {

constexpr int spins = 2000; // some tens of microseconds

void pause() {
#if defined(__x86_64__)
    _mm_pause();
#endif
}

// Waits while `value` is `old`: a short spin, then asleep.
template <class T>
void wait_while(std::atomic<T>& value, T old) {
    for (int i = 0; i < spins; ++i) {
        if (value.load(std::memory_order_acquire) != old) return;
        pause();
    }
    value.wait(old, std::memory_order_acquire);
}

} // namespace

Team::Team(int threads) : parts_(static_cast<std::size_t>(threads)) {
    for (int t = 1; t < threads; ++t)
        workers_.emplace_back([this, t] { work(t); });
}

Team::~Team() {
    leaving_ = true;
    ++round_;
    round_.notify_all();
    for (std::thread& worker : workers_)
        worker.join();
}

void Team::run(int n, Call call, void* context) {
    call_ = call;
    context_ = context;
    piece_ = std::max(1, n / (64 * threads()));
    for (int t = 0; t < threads(); ++t) {
        parts_[t].next.store(static_cast<int>(int64_t{n} * t / threads()), std::memory_order_relaxed);
        parts_[t].end = static_cast<int>(int64_t{n} * (t + 1) / threads());
    }
    busy_.store(threads() - 1, std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    share(0);
    for (int left; (left = busy_.load(std::memory_order_acquire)) != 0;)
        wait_while(busy_, left);
}

void Team::share(int thread) {
    for (int t = 0; t < threads(); ++t) {
        Part& part = parts_[(thread + t) % threads()];
        for (int begin; (begin = part.next.fetch_add(piece_, std::memory_order_relaxed)) < part.end;)
            for (int i = begin; i < std::min(begin + piece_, part.end); ++i)
                call_(context_, i, thread);
    }
}

void Team::work(int thread) {
    for (uint32_t seen = 0;;) {
        wait_while(round_, seen);
        seen = round_.load(std::memory_order_acquire);
        if (leaving_) return;
        share(thread);
        if (busy_.fetch_sub(1, std::memory_order_release) == 1) busy_.notify_one();
    }
}

} // namespace gault::core
