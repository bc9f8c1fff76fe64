// bin/gault as a child process in a folder of its own.
#pragma once
#include "tests/unit/output/support.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace gault::test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Environment = std::map<std::string, std::string>;

const fs::path repository = GAULT_SOURCE_DIR;
const fs::path build = GAULT_BINARY_DIR;

struct Outcome {
    int status; // exit status; 128 + the signal that ended it
    std::string out, err;
};

class Child {
  public:
    // Its working directory is `folder`; what it prints goes to files beside that folder, or its standard
    // output to `out`.
    Child(const fs::path& folder, const Words& words, const Environment& environment = {},
          const fs::path& out = {});
    ~Child(); // kills it
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    bool ended();
    void signal(int number);
    Outcome wait();

  private:
    fs::path out_, err_;
    pid_t id_;
    int wait_status_ = 0;
    bool ended_ = false;
};

// The test's working directory, empty at first, in which it runs gault.
class App : public testing::Test {
  protected:
    App();
    Outcome gault(const Words& words, const Environment& environment = {}) const {
        return Child(work, words, environment).wait();
    }
    // Runs a scene of the repository into `results`, which must succeed.
    void run(const std::string& scene, Words more = {}) const;

    core::test::Folder folder;
    const fs::path work, results;
};

nlohmann::json summary(const fs::path& results);
// A column of history.csv, whose every number must be finite.
std::vector<double> history(const fs::path& results, const std::string& column);
// y at x = at, linear between the rows.
double at(const std::vector<double>& x, const std::vector<double>& y, double at);

std::vector<std::string> lines(const std::string& text);
bool has(const std::string& text, const std::string& part);
// Status 2, nothing but one line on stderr that begins with "error: "; that line without its beginning.
std::string refusal(const Outcome& outcome);

} // namespace gault::test
