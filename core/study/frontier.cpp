#include "core/study/frontier.hpp"
#include "core/base/error.hpp"
#include "core/base/isa.hpp"
#include "core/base/log.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/compare.hpp"
#include "core/study/child.hpp"
#include "core/study/extrapolation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

namespace gault::core {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t most_rows = 400; // of a curve that is kept

struct Run { // a member, and what its runs gave
    const Study::Family* family;
    const Study::Member* member;
    std::vector<double> seconds;
    json results; // summary.json, with `history`
    std::string failure;
    std::vector<double> x, y; // the curve
    bool ran() const { return !seconds.empty(); }
};

class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "gault-XXXXXX").string();
        if (!mkdtemp(name.data())) throw RunError("no temporary folder can be made");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown";
}

// {column: {first, last, least, largest}} of a history, for values of a study.
json extremes(const CsvTable& history) {
    json all = json::object();
    for (std::size_t k = 0; k < history.columns.size(); ++k) {
        const std::vector<double>& v = history.values[k];
        if (v.empty()) continue;
        all[history.columns[k]] = {{"first", v.front()},
                                   {"last", v.back()},
                                   {"least", *std::min_element(v.begin(), v.end())},
                                   {"largest", *std::max_element(v.begin(), v.end())}};
    }
    return all;
}

// The last line that a failed run wrote, without its "error: ".
std::string last_line(std::string text) {
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    text.erase(0, text.rfind('\n') + 1);
    return text.rfind("error: ", 0) == 0 ? text.substr(7) : text;
}

// The number at the places of a measure, of several the largest; null where one of them holds none.
json measured(const json& results, const Study::Measure& measure) {
    double largest = -HUGE_VAL;
    for (const std::string& place : measure.places) {
        const json::json_pointer pointer(place);
        if (!results.contains(pointer) || !results[pointer].is_number()) return nullptr;
        largest = std::max(largest, std::abs(results[pointer].get<double>()));
    }
    return largest;
}

// All errors that a run's results hold, by their usual names.
std::vector<Study::Measure> errors_in(const json& results) {
    std::vector<Study::Measure> all;
    const auto add = [&](const std::string& name, const std::string& place) {
        const auto same = [&](const Study::Measure& m) { return m.name == name; };
        const auto found = std::find_if(all.begin(), all.end(), same);
        if (found != all.end())
            found->places.push_back(place);
        else
            all.push_back({name, {place}});
    };
    const json& reference = results["reference"];
    for (const char* list : {"curves", "profiles"})
        for (std::size_t k = 0; reference.contains(list) && k < reference[list].size(); ++k)
            for (const char* error : {"largest_relative_error", "sigma_r_l2", "sigma_theta_l2"})
                if (reference[list][k].contains(error))
                    add(list == std::string("curves") ? reference[list][k]["y"].get<std::string>() : error,
                        fmt::format("/reference/{}/{}/{}", list, k, error));
    for (const auto& [name, derived] : results["derived"].items())
        for (const auto& [key, value] : derived.items())
            if (value.is_number() && (key.ends_with("_l2") || key.ends_with("_error")))
                add(key, "/derived/" + name + "/" + key);
    return all;
}

class Frontier {
  public:
    Frontier(const Study& study, const FrontierOptions& options) : study_(study), options_(options) {
        for (const Study::Family& family : study.families)
            for (const Study::Member& member : family.members)
                runs_.push_back({&family, &member, {}, {}, "", {}, {}});
    }
    json go();

  private:
    void run(Run& run);
    void take_results(Run& run, const fs::path& folder);
    void write();
    void choose_errors();
    void compare_with_extrapolation();
    std::optional<Extrapolation> best_extrapolation();
    std::vector<const Run*> of(const Study::Family& family) const;
    json error_of(const Run& run, const Study::Measure& error) const;
    json to_json(const Run& run) const;
    void mark_orders(json& family) const;
    void mark_front(json& all) const;
    json everything();
    std::string as_csv(const json& all) const;

    const Study& study_;
    const FrontierOptions& options_;
    TemporaryFolder scratch_;
    std::vector<Run> runs_;
    std::vector<Study::Measure> errors_;
    std::string against_;
    std::optional<Extrapolation> extrapolation_;
};

std::vector<const Run*> Frontier::of(const Study::Family& family) const {
    std::vector<const Run*> all;
    for (const Run& run : runs_)
        if (run.family == &family) all.push_back(&run);
    return all;
}

void Frontier::run(Run& run) {
    if (!run.failure.empty()) return;
    const fs::path folder = scratch_.path() / "run";
    std::vector<std::string> command{options_.program, "run", study_.scene, "-o", folder, "--force", "-q"};
    command.insert(command.end(), options_.arguments.begin(), options_.arguments.end());
    for (const auto* set : {&run.family->set, &run.member->set})
        for (const Override& change : *set)
            command.insert(command.end(), {"--set", change.key + "=" + change.value});
    if (run.member->threads > 0)
        command.insert(command.end(), {"--threads", std::to_string(run.member->threads)});
    const ChildResult child = run_child(command, scratch_.path() / "error");
    if (child.status == 2)
        throw InputError(
            fmt::format("{}, {}: {}", run.family->name, run.member->label, last_line(child.error)));
    if (child.status == 130 || child.status == 128 + 2)
        throw RunError("interrupted; what was measured is written");
    if (child.status != 0) {
        run.failure = last_line(child.error);
        return;
    }
    run.seconds.push_back(child.seconds);
    take_results(run, folder);
}

void Frontier::take_results(Run& run, const fs::path& folder) {
    std::ifstream stream(folder / "summary.json");
    run.results = json::parse(stream);
    const CsvTable history = read_csv(folder / "history.csv");
    run.results["history"] = extremes(history);
    if (!study_.curve) return;
    const auto x = history.column((*study_.curve)[0]), y = history.column((*study_.curve)[1]);
    run.x.assign(x.begin(), x.end());
    run.y.assign(y.begin(), y.end());
}

// The errors that the study names, or those of the first run that has any.
void Frontier::choose_errors() {
    if (study_.errors)
        errors_ = *study_.errors;
    else
        for (const Run& run : runs_)
            if (errors_.empty() && run.ran()) errors_ = errors_in(run.results);
    if (!errors_.empty()) against_ = "the scene's reference";
}

std::optional<Extrapolation> Frontier::best_extrapolation() {
    std::optional<Extrapolation> best;
    for (const Study::Family& family : study_.families) {
        std::vector<SampledCurve> curves;
        for (const Run* run : of(family))
            if (run->ran()) curves.push_back(rising_part(run->x, run->y, run->member->size));
        const auto found = extrapolate(curves);
        if (!found || (best && best->remaining <= found->remaining)) continue;
        best = found;
        against_ = fmt::format(
            "Richardson's extrapolation of {} over {} from the family '{}', of observed order "
            "{:.1f}, whose finest run is {:.2g} % off",
            (*study_.curve)[1], (*study_.curve)[0], family.name, found->order, 100.0 * found->remaining);
    }
    return best;
}

void Frontier::compare_with_extrapolation() {
    if (study_.errors || !study_.curve) return;
    extrapolation_ = best_extrapolation();
    if (extrapolation_) errors_ = {{(*study_.curve)[1], {}}};
}

json Frontier::error_of(const Run& run, const Study::Measure& error) const {
    if (!run.ran()) return nullptr;
    if (!error.places.empty()) return measured(run.results, error);
    return distance(rising_part(run.x, run.y, 0.0), *extrapolation_);
}

json Frontier::to_json(const Run& run) const {
    json settings = json::object();
    for (const auto* set : {&run.family->set, &run.member->set})
        for (const Override& change : *set)
            settings[change.key] = change.value;
    json j = {{"label", run.member->label},
              {"settings", settings},
              {"size", run.member->size},
              {"status", run.ran()             ? "done"
                         : run.failure.empty() ? "not run yet"
                                               : "failed"}};
    if (!run.failure.empty()) j["message"] = run.failure;
    if (!run.ran()) return j;
    const json& counts = run.results["counts"];
    const double stepping = run.results["wall_seconds"]["stepping"];
    j["wall_seconds"] = {{"median", median(run.seconds)},
                         {"least", *std::min_element(run.seconds.begin(), run.seconds.end())},
                         {"most", *std::max_element(run.seconds.begin(), run.seconds.end())},
                         {"runs", run.seconds}};
    for (const char* count : {"points", "steps", "constitutive_updates"})
        j[count] = counts[count];
    j["threads"] = run.results["threads"];
    j["point_steps_per_second"] =
        stepping > 0.0 ? json(counts["constitutive_updates"].get<double>() / stepping) : json(nullptr);
    j["peak_memory_bytes"] = run.results["peak_memory_bytes"];
    for (const Study::Measure& error : errors_)
        j["errors"][error.name] = error_of(run, error);
    for (const Study::Measure& value : study_.values)
        j["values"][value.name] = measured(run.results, value);
    const std::size_t every = run.x.size() / most_rows + 1;
    for (std::size_t i = 0; i < run.x.size(); ++i)
        if (i % every == 0 || i + 1 == run.x.size()) {
            j["curve"]["x"].push_back(run.x[i]);
            j["curve"]["y"].push_back(run.y[i]);
        }
    return j;
}

// The order of an error over the size that is varied, from each member and the one before; sizes that differ by less
// than a tenth (0.499 and 0.4999) have none.
void Frontier::mark_orders(json& family) const {
    json& members = family["members"];
    for (std::size_t k = 1; k < members.size(); ++k) {
        const json &here = members[k], &last = members[k - 1];
        if (!here.contains("errors") || !last.contains("errors")) continue;
        const double steps = std::abs(std::log(here["size"].get<double>() / last["size"].get<double>()));
        if (!(steps > 0.1)) continue;
        for (const Study::Measure& error : errors_) {
            const json now = here["errors"][error.name], before = last["errors"][error.name];
            if (!now.is_number() || !before.is_number()) continue;
            const double order = std::log(before.get<double>() / now.get<double>()) / steps;
            if (std::isfinite(order)) members[k]["orders"][error.name] = order;
        }
    }
}

// A member is on the front of an error where none is both faster and nearer.
void Frontier::mark_front(json& all) const {
    struct At {
        double seconds, error;
        json* member;
    };
    for (const Study::Measure& error : errors_) {
        std::vector<At> done;
        for (json& family : all["families"])
            for (json& member : family["members"])
                if (member.contains("errors") && member["errors"][error.name].is_number())
                    done.push_back({member["wall_seconds"]["median"], member["errors"][error.name], &member});
        for (const At& at : done)
            (*at.member)["front"][error.name] = std::none_of(done.begin(), done.end(), [&](const At& other) {
                return other.seconds <= at.seconds && other.error <= at.error &&
                       (other.seconds < at.seconds || other.error < at.error);
            });
    }
}

json Frontier::everything() {
    errors_.clear();
    against_.clear();
    choose_errors();
    if (errors_.empty()) compare_with_extrapolation();
    json all = {{"title", study_.title},
                {"scene", study_.scene.string()},
                {"program", "gault " + options_.program_version},
                {"command", options_.command_line},
                {"machine",
                 {{"processor", processor()},
                  {"cores", std::thread::hardware_concurrency()},
                  {"instruction_set", isa_name(best_isa())}}},
                {"against", against_.empty() ? json(nullptr) : json(against_)},
                {"errors", json::array()},
                {"values", json::array()},
                {"families", json::array()}};
    if (study_.curve) all["curve"] = *study_.curve;
    for (const Study::Measure& error : errors_)
        all["errors"].push_back(error.name);
    for (const Study::Measure& value : study_.values)
        all["values"].push_back(value.name);
    for (const Study::Family& family : study_.families) {
        json j = {{"name", family.name}, {"members", json::array()}};
        for (const Run* run : of(family))
            j["members"].push_back(to_json(*run));
        mark_orders(j);
        all["families"].push_back(std::move(j));
    }
    mark_front(all);
    return all;
}

std::string cell(const json& value) {
    if (value.is_null()) return "";
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    if (!value.is_string()) return value.dump();
    std::string text = value;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2)
        text.insert(at, "\"");
    return '"' + text + '"';
}

std::string Frontier::as_csv(const json& all) const {
    const auto part = [](const json& member, const char* group, const json& name) {
        return member.contains(group) ? member[group].value(name.get<std::string>(), json()) : json();
    };
    std::string text = "family,setting,status,wall_median_s,wall_least_s,wall_most_s,points,steps,"
                       "constitutive_updates,point_steps_per_second,peak_memory_bytes";
    for (const json& name : all["errors"])
        text += fmt::format(",error_{0},order_{0},front_{0}", name.get<std::string>());
    for (const json& name : all["values"])
        text += "," + name.get<std::string>();
    for (const json& family : all["families"])
        for (const json& member : family["members"]) {
            text += fmt::format("\n{},{},{}", cell(family["name"]), cell(member["label"]),
                                member["status"].get<std::string>());
            for (const char* time : {"median", "least", "most"})
                text += "," + cell(part(member, "wall_seconds", time));
            for (const char* key :
                 {"points", "steps", "constitutive_updates", "point_steps_per_second", "peak_memory_bytes"})
                text += "," + cell(member.value(key, json()));
            for (const json& name : all["errors"])
                for (const char* group : {"errors", "orders", "front"})
                    text += "," + cell(part(member, group, name));
            for (const json& name : all["values"])
                text += "," + cell(part(member, "values", name));
        }
    return text + "\n";
}

void Frontier::write() {
    const json all = everything();
    write_atomically(options_.folder / "frontier.json", all.dump(1) + "\n");
    write_atomically(options_.folder / "frontier.csv", as_csv(all));
}

json Frontier::go() {
    fs::create_directories(options_.folder);
    const int repeat = options_.repeat > 0 ? options_.repeat : study_.repeat;
    for (int turn = 1; turn <= repeat; ++turn)
        for (std::size_t k = 0; k < runs_.size(); ++k) {
            run(runs_[k]);
            log::info("turn {} of {}, {} of {}: {}{}{}: {}", turn, repeat, k + 1, runs_.size(),
                      runs_[k].family->name, runs_[k].member->label.empty() ? "" : ", ",
                      runs_[k].member->label,
                      runs_[k].ran() ? fmt::format("{:.3g} s", runs_[k].seconds.back()) : runs_[k].failure);
            write();
        }
    return everything();
}

} // namespace

json run_frontier(const Study& study, const FrontierOptions& options) {
    return Frontier(study, options).go();
}

} // namespace gault::core
