// A few threads that share loops. Waiting threads spin briefly and then sleep, so that a busy machine costs
// little. Every thread begins with its own part of the loop, the same in every loop of that length, so that
// its data stays in its cache; then it takes pieces of the others' parts, so that a thread the system has
// taken away holds nobody up.
#pragma once
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace gault::core {

class Team {
  public:
    explicit Team(int threads); // at least 1, the caller included
    ~Team();
    Team(const Team&) = delete;

    int threads() const { return static_cast<int>(workers_.size()) + 1; }

    // f(index, thread) for every index in [0, n), in any order and on any thread in [0, threads()); returns
    // when all are done. f must not throw. Called by one thread at a time.
    template <class F>
    void each(int n, F f) {
        if (workers_.empty() || n < 2) {
            for (int i = 0; i < n; ++i)
                f(i, 0);
            return;
        }
        run(
            n, [](void* context, int i, int thread) { (*static_cast<F*>(context))(i, thread); }, &f);
    }

  private:
    using Call = void (*)(void*, int, int);
    void run(int n, Call call, void* context);
    void work(int thread);
    void share(int thread);

    struct alignas(64) Part {
        std::atomic<int> next{0};
        int end = 0;
    };

    Call call_ = nullptr;
    void* context_ = nullptr;
    int piece_ = 1;
    std::vector<Part> parts_; // one a thread
    alignas(64) std::atomic<int> busy_{0};
    alignas(64) std::atomic<uint32_t> round_{0};
    std::atomic<bool> leaving_{false};
    std::vector<std::thread> workers_;
};

} // namespace gault::core
