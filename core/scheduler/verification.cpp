#include "core/scheduler/verification.hpp"
#include "core/base/suggest.hpp"
#include "core/base/units.hpp"
#include "core/output/interpolate.hpp"
#include "core/registry/answer.hpp"
#include "core/scheduler/palmer.hpp"
#include "core/scheduler/program.hpp"
#include "core/scheduler/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gault::core {
namespace {

// The column `name`, or `name_UNIT` converted to SI.
std::vector<double> read_column(const CsvTable& table, const std::filesystem::path& file,
                                const std::string& name, const std::string& si_unit) {
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
        const std::string& header = table.columns[k];
        if (header == name) return table.values[k];
        if (header.rfind(name + "_", 0) != 0) continue;
        double factor = 0.0;
        try {
            factor = parse_quantity("1 " + header.substr(name.size() + 1), si_unit);
        } catch (const std::invalid_argument&) {
            continue; // another column whose name begins alike
        }
        std::vector<double> values = table.values[k];
        for (double& v : values)
            v *= factor;
        return values;
    }
    throw InputError(
        fmt::format("{}: no column '{}'{}", file.string(), name, suggestion(name, table.columns)));
}

nlohmann::json file_origin(const std::filesystem::path& file, const std::filesystem::path& folder) {
    return {{"file", file.lexically_relative(folder).string()}};
}

void check_radii(const std::vector<double>& radius, const std::filesystem::path& file) try {
    LogarithmicCubic(radius, radius);
} catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
}

std::size_t history_column(const std::vector<ColumnInfo>& columns, const std::string& name,
                           const Location& where) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k].name == name) return k;
        names.push_back(columns[k].name);
    }
    throw InputError(where, fmt::format("the history has no column '{}'{}", name, suggestion(name, names)));
}

} // namespace

Verification::Verification(const Scene& scene, const std::vector<ColumnInfo>& columns) {
    const std::filesystem::path folder = scene.file.parent_path();
    for (const CurveReference& use : scene.curves) {
        const CsvTable table = read_csv(use.file);
        const std::size_t x = history_column(columns, use.x, use.where),
                          y = history_column(columns, use.y, use.where);
        curves_.push_back({use, file_origin(use.file, folder), x, y,
                           read_column(table, use.file, use.x, columns[x].unit),
                           read_column(table, use.file, use.y, columns[y].unit)});
    }
    for (const ProfileReference& use : scene.profiles)
        for (const ProfileReference::At& at : use.at) {
            const CsvTable table = read_csv(at.file);
            profiles_.push_back({use.measure,
                                 Crossing(at.value),
                                 file_origin(at.file, folder),
                                 read_column(table, at.file, "reference_radius", "m"),
                                 read_column(table, at.file, "sigma_r", "Pa"),
                                 read_column(table, at.file, "sigma_theta", "Pa"),
                                 {}});
            check_radii(profiles_.back().radius, at.file);
        }
    if (scene.palmer) add_palmer(scene, columns);
    for (const Scene::ObserverUse& use : scene.observers) {
        Observer observer{Instance(*use.model.component, use.model.parameters), use.surface.value_or(0), {}};
        const auto& api = observer.instance.api<gault_observer_api>();
        for (uint32_t k = 0; k < api.measure_count; ++k) {
            observer.measures.emplace_back(api.measures[k].name);
            check_measure(use.model.parameters.where, observer.instance.declaration().name,
                          observer.measures.back(), use.surface.has_value());
        }
        observers_.push_back(std::move(observer));
    }
}

void Verification::add_palmer(const Scene& scene, const std::vector<ColumnInfo>& columns) {
    constexpr int places = 2000;
    const PalmerReference& use = *scene.palmer;
    const nlohmann::json source = {{"against", "Palmer's integral of the soil's own path"}};
    const PalmerSolution exact(scene,
                               std::max(use.to, use.at.empty() ? 0.0 : *std::ranges::max_element(use.at)));
    Curve curve{{use.x, use.y, {}, use.from, use.to, {}, use.where},
                source,
                history_column(columns, use.x, use.where),
                history_column(columns, use.y, use.where),
                {},
                {},
                true};
    for (int k = 0; k <= places; ++k) { // denser where the curve bends, and a little beyond the end
        const double share = static_cast<double>(k) / places, x = use.to * share * share * (1.0 + 1e-6);
        curve.x_reference.push_back(x);
        curve.y_reference.push_back(exact.pressure(x));
    }
    curves_.push_back(std::move(curve));
    for (const double x : use.at) {
        PalmerSolution::Profile profile = exact.profile(x, places);
        profiles_.push_back({use.x,
                             Crossing(x),
                             source,
                             std::move(profile.radius),
                             std::move(profile.sigma_r),
                             std::move(profile.sigma_theta),
                             {}});
    }
}

void Verification::look(const std::function<double(const std::string&)>& measured, const Motion& motion) {
    for (Profile& profile : profiles_) {
        if (!profile.value.reached(measured(profile.measure))) continue;
        PointArrays points = collect(motion);
        for (const int k : {0, 2})
            for (double& s : points.stress[k])
                s = -s;
        const auto error = [&](int k, const std::vector<double>& reference) {
            return profile_error(points.reference[0], points.stress[k], points.volume, profile.radius,
                                 reference);
        };
        try {
            profile.errors = {{"sigma_r_l2", error(0, profile.sigma_r)},
                              {"sigma_theta_l2", error(2, profile.sigma_theta)}};
        } catch (const InputError& wrong) {
            profile.errors = {{"not_compared", wrong.what()}};
        }
    }
}

nlohmann::json Verification::finish(const std::vector<std::vector<double>>& rows) const {
    nlohmann::json result = nlohmann::json::object();
    for (const Curve& curve : curves_) {
        std::vector<double> x, y;
        double to = curve.use.to;
        for (const auto& row : rows) {
            if (curve.first_loading && !x.empty() && row[curve.x] < x.back()) {
                to = std::min(to, x.back());
                break;
            }
            x.push_back(row[curve.x]);
            y.push_back(row[curve.y]);
        }
        nlohmann::json j = {{"x", curve.use.x}, {"y", curve.use.y}, {"from", curve.use.from}, {"to", to}};
        j.update(curve.source);
        try {
            const CurveError error =
                compare_curve(x, y, curve.x_reference, curve.y_reference, curve.use.from, to);
            j["largest_relative_error"] = error.largest;
            j["largest_at"] = error.largest_at;
            j["root_mean_square"] = error.root_mean_square;
            j["rows"] = error.rows;
            if (curve.use.noise)
                j["noise_about_cubic"] =
                    noise_about_cubic(x, y, (*curve.use.noise)[0], (*curve.use.noise)[1]);
        } catch (const InputError& error) {
            j["not_compared"] = error.what();
        }
        result["curves"].push_back(std::move(j));
    }
    for (const Profile& profile : profiles_) {
        nlohmann::json j = {{"measure", profile.measure}, {"value", profile.value.target()}};
        j.update(profile.source);
        if (profile.errors.is_null())
            j["not_compared"] = fmt::format("{} never reached {:g}", profile.measure, profile.value.target());
        else
            j.update(profile.errors);
        result["profiles"].push_back(std::move(j));
    }
    return result;
}

namespace {

// What all observers see alike; the arrays are those of `points` and `zero`.
gault_sample sample_of(const PointArrays& points, const std::vector<double>& zero, const Grid& grid,
                       double time) {
    gault_sample sample{};
    sample.size = sizeof sample;
    sample.count = static_cast<int64_t>(points.volume.size());
    sample.time = time;
    for (int k = 0; k < 3; ++k) {
        sample.position[k] = k < 2 ? points.position[k].data() : zero.data();
        sample.reference_position[k] = k < 2 ? points.reference[k].data() : zero.data();
    }
    for (int k = 0; k < 6; ++k)
        sample.stress[k] = points.stress[k].data();
    sample.volume = points.volume.data();
    sample.material = points.material.data();
    for (int k = 0; k < 2; ++k)
        for (const double h : grid.axis(k).length())
            sample.cell_size[k] = std::max(sample.cell_size[k], h);
    return sample;
}

} // namespace

nlohmann::json Verification::observe(Solver& solver) {
    nlohmann::json all = nlohmann::json::object();
    if (observers_.empty()) return all;
    const Motion& motion = solver.motion();
    const PointArrays points = collect(motion);
    const std::vector<double> zero(points.volume.size());
    std::vector<const char*> material_names;
    for (const Material& material : motion.materials())
        material_names.push_back(material.name().c_str());
    material_names.push_back(nullptr);
    gault_sample sample = sample_of(points, zero, motion.grid(), solver.time());
    sample.material_name = material_names.data();
    for (Observer& observer : observers_) {
        std::string key = observer.instance.declaration().name;
        for (int n = 2; all.contains(key); ++n)
            key = fmt::format("{}_{}", observer.instance.declaration().name, n);
        all[key] = ask(observer, solver, sample);
    }
    return all;
}

nlohmann::json Verification::ask(const Observer& observer, Solver& solver, gault_sample sample) {
    const auto& api = observer.instance.api<gault_observer_api>();
    std::vector<std::vector<double>> states;
    for (const char* const* name = api.fields; name && *name; ++name)
        states.push_back(collect_state(solver.motion(), *name));
    std::vector<const double*> field;
    for (const std::vector<double>& values : states)
        field.push_back(values.empty() ? nullptr : values.data());
    sample.field = field.data();
    std::vector<double> measure, result(api.result_count, std::numeric_limits<double>::quiet_NaN());
    for (const std::string& name : observer.measures)
        measure.push_back(solver.measure(name, observer.surface).value());
    sample.measure = measure.data();
    sample.result = result.data();
    gault_error error{-1, 0, -1, ""};
    if (api.evaluate(observer.instance.self(), &sample, &error) != GAULT_OK)
        throw RunError(
            fmt::format("observer '{}': {}", observer.instance.declaration().name, error_text(error)));
    nlohmann::json j;
    for (uint32_t k = 0; k < api.result_count; ++k)
        if (std::isfinite(result[k])) j[api.results[k].name] = result[k];
    return j;
}

} // namespace gault::core
