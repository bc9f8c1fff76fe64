#include "tests/app/child.hpp"

#include "core/output/compare.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace gault::test {
namespace {

// In the child: from here to the program. Whatever fails ends it with a status that gault does not have.
[[noreturn]] void become(const fs::path& folder, const Words& words, const Environment& environment,
                         const fs::path& out, const fs::path& err) {
    const auto redirect = [](const fs::path& file, int descriptor) {
        const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        if (opened < 0 || dup2(opened, descriptor) < 0) _exit(99);
    };
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    unsetenv("GAULT_PLUGIN_PATH");
    setenv("OMP_WAIT_POLICY", "passive", 1); // other tests share the cores
    for (const auto& [name, value] : environment)
        setenv(name.c_str(), value.c_str(), 1);
    std::vector<char*> arguments{const_cast<char*>("gault")};
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    if (chdir(folder.c_str()) == 0) execv(GAULT_PROGRAM, arguments.data());
    _exit(99);
}

} // namespace

Child::Child(const fs::path& folder, const Words& words, const Environment& environment, const fs::path& out)
    : out_(out.empty() ? fs::path(folder.string() + ".out") : out), err_(folder.string() + ".err"),
      id_(fork()) {
    if (id_ == 0) become(folder, words, environment, out_, err_);
    if (id_ < 0) throw std::runtime_error("cannot fork");
}

Child::~Child() {
    if (ended()) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
}

bool Child::ended() {
    if (!ended_) ended_ = waitpid(id_, &wait_status_, WNOHANG) == id_;
    return ended_;
}

void Child::signal(int number) {
    kill(id_, number);
}

Outcome Child::wait() {
    if (!ended_) ended_ = waitpid(id_, &wait_status_, 0) == id_;
    const int status = WIFEXITED(wait_status_) ? WEXITSTATUS(wait_status_) : 128 + WTERMSIG(wait_status_);
    return {status, fs::is_regular_file(out_) ? core::test::text_of(out_) : "", core::test::text_of(err_)};
}

App::App() : work(folder.path / "work"), results(work / "results") {
    fs::create_directory(work);
}

void App::run(const std::string& scene, Words more) const {
    more.insert(more.begin(), {"run", (repository / scene).string(), "-o", results.string()});
    const Outcome outcome = gault(more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ASSERT_EQ(summary(results)["status"], "done");
}

nlohmann::json summary(const fs::path& results) {
    return nlohmann::json::parse(core::test::text_of(results / "summary.json"));
}

std::vector<double> history(const fs::path& results, const std::string& column) {
    const core::CsvTable table = core::read_csv(results / "history.csv"); // refuses what is not finite
    const auto values = table.column(column);
    return {values.begin(), values.end()};
}

double at(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const auto right = std::lower_bound(x.begin(), x.end(), at);
    if (right == x.begin() || right == x.end()) throw std::out_of_range("outside the history");
    const auto i = static_cast<std::size_t>(right - x.begin());
    return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

std::vector<std::string> lines(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(stream, line);)
        all.push_back(line);
    return all;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string refusal(const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("error: ")) << outcome.err;
    return outcome.err.substr(std::min<std::size_t>(7, outcome.err.size()));
}

} // namespace gault::test
