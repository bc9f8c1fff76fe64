#include "core/certificate/certificate.hpp"
#include "core/certificate/checks.hpp"
#include "core/output/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gault::core {
namespace {

const char* word(Finding::Verdict verdict) {
    switch (verdict) {
    case Finding::Verdict::passed:
        return "pass";
    case Finding::Verdict::failed:
        return "FAIL";
    default:
        return "-";
    }
}

std::string answer_of(const Check& check, const Subject& subject) {
    Finding finding;
    try {
        finding = check.run(subject);
    } catch (const std::exception& error) {
        finding = checks::failed(error.what());
    }
    return static_cast<char>('0' + static_cast<int>(finding.verdict)) + finding.figure;
}

// What the child wrote before it closed its end; empty: the time limit came first.
std::string read_until(int descriptor, double seconds, bool& in_time) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    std::string text;
    in_time = true;
    for (;;) {
        const double left = std::chrono::duration<double>(end - Clock::now()).count();
        pollfd wait{descriptor, POLLIN, 0};
        const int ready = ::poll(&wait, 1, static_cast<int>(std::clamp(1e3 * left, 0.0, 1e6)));
        if ((ready < 0 && errno == EINTR) || (ready == 0 && Clock::now() < end)) continue;
        if (ready <= 0) {
            in_time = false;
            return text;
        }
        char buffer[4096];
        const ssize_t n = ::read(descriptor, buffer, sizeof buffer);
        if (n <= 0) return text;
        text.append(buffer, static_cast<std::size_t>(n));
    }
}

Finding in_a_process(const Check& check, const Subject& subject) {
    int ends[2];
    if (::pipe(ends) != 0) throw RunError(fmt::format("no pipe: {}", std::strerror(errno)));
    const pid_t child = ::fork();
    if (child < 0) throw RunError(fmt::format("no process: {}", std::strerror(errno)));
    if (child == 0) {
        ::close(ends[0]);
        const std::string answer = answer_of(check, subject);
        const bool written =
            ::write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size());
        ::_exit(written ? 0 : 1);
    }
    ::close(ends[1]);
    bool in_time = false;
    const std::string answer = read_until(ends[0], subject.time_limit, in_time);
    ::close(ends[0]);
    if (!in_time) ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!in_time) return checks::failed(fmt::format("no end within {:g} s", subject.time_limit));
    if (WIFSIGNALED(status)) return checks::failed(fmt::format("crashed: {}", strsignal(WTERMSIG(status))));
    if (answer.empty())
        return checks::failed(fmt::format("ended the process with status {}", WEXITSTATUS(status)));
    return {static_cast<Finding::Verdict>(answer[0] - '0'), answer.substr(1)};
}

} // namespace

const std::vector<Check>& all_checks() {
    using namespace checks;
    static const std::vector<Check> all = {
        {"declaration", "every unit is one, and every parameter and state has a sentence", declaration},
        {"effect", "what is declared takes part", effect},
        {"bounds", "values at the bounds are taken, or refused by name", bounds},
        {"batches", "split, shuffled and padded batches give the same bits", batches},
        {"threads", "concurrent calls give the same bits", threads},
        {"increments", "zero, tiny, huge and NaN increments are answered", increments},
        {"retry", "parts of a step that was too long are answered", retry},
        {"rate", "the rate matters where that is declared", rate},
        {"tangent", "the tangent is that of differences", tangent},
        {"step_size", "shorter steps converge", step_size},
        {"objectivity", "a rotated path gives the rotated result", objectivity},
        {"elastic_cycles", "closed cycles of strain give no work", elastic_cycles},
        {"random_walk", "random steps stay finite and within the declared bounds", random_walk},
        {"modulus", "the modulus bounds every wave's", modulus},
        {"cavity", "a cavity in it, undrained, opens as its own path says", cavity},
        {"speed", "cost of a point, and over that of linear elasticity", speed},
    };
    return all;
}

std::vector<CheckResult> certify(const Subject& subject, const std::vector<std::string>& only) {
    std::vector<CheckResult> results;
    for (const Check& check : all_checks()) {
        if (!only.empty() && std::find(only.begin(), only.end(), check.name) == only.end()) continue;
        const auto start = std::chrono::steady_clock::now();
        Finding finding = in_a_process(check, subject);
        results.push_back({&check, std::move(finding),
                           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    }
    return results;
}

bool passed(const std::vector<CheckResult>& results) {
    return std::none_of(results.begin(), results.end(), [](const CheckResult& result) {
        return result.finding.verdict == Finding::Verdict::failed;
    });
}

std::string certificate_table(const std::vector<CheckResult>& results) {
    std::size_t name = 0, statement = 0;
    for (const CheckResult& r : results) {
        name = std::max(name, std::strlen(r.check->name));
        statement = std::max(statement, std::strlen(r.check->statement));
    }
    std::string table;
    for (const CheckResult& r : results)
        table += fmt::format("{:<4}  {:<{}}  {:<{}}  {}\n", word(r.finding.verdict), r.check->name, name,
                             r.check->statement, statement, r.finding.figure);
    return table;
}

nlohmann::json certificate_json(const Subject& subject, const std::vector<CheckResult>& results) {
    const Component& component = *subject.use.model.component;
    nlohmann::json checks = nlohmann::json::array();
    for (const CheckResult& r : results)
        checks.push_back({{"name", r.check->name},
                          {"statement", r.check->statement},
                          {"verdict", r.finding.verdict == Finding::Verdict::left_out ? "left out"
                                      : r.finding.verdict == Finding::Verdict::passed ? "passed"
                                                                                      : "failed"},
                          {"figure", r.finding.figure},
                          {"seconds", r.seconds}});
    return {{"model", component.declaration->name},
            {"version", component.declaration->version},
            {"file", component.file.string()},
            {"sha256", sha256_of_file(component.file)},
            {"parameters", subject.use.yaml},
            {"initial_stress_Pa", subject.stress},
            {"passed", passed(results)},
            {"checks", checks}};
}

} // namespace gault::core
