// What a person sees while a run goes on: a bar on a terminal, a line now and then elsewhere.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace gault::core {

class Progress {
  public:
    Progress(std::size_t points, bool quiet);
    ~Progress(); // leaves a terminal's line clean

    struct State {
        int64_t step;
        double time, share;  // s; of the run that is done, NaN if unknown
        std::string measure; // "cavity strain 2.31 %", or empty
    };
    bool due(int64_t step); // cheap; true a few times a second
    void show(const State& state);

  private:
    std::size_t points_;
    bool quiet_, terminal_;
    std::chrono::steady_clock::time_point start_, last_;
    int64_t last_step_ = 0;
};

} // namespace gault::core
