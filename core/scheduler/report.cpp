#include "core/scheduler/report.hpp"
#include "core/base/log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace gault::core {
namespace {

// An observer's result is a number, a program's {value, unit, ...}.
std::string derived_text(const nlohmann::json& result) {
    if (result.is_number()) return fmt::format("{:.6g}", result.get<double>());
    const std::string unit = result["unit"], note = result["note"];
    return fmt::format("{:.6g}{}{}{}", result["value"].get<double>(), unit == "1" ? "" : " " + unit,
                       note.empty() ? "" : "; ", note);
}

} // namespace

void report_reference(const nlohmann::json& reference) {
    for (const auto& c : reference.value("curves", nlohmann::json::array())) {
        const std::string y = c["y"];
        if (c.contains("not_compared"))
            log::warn("{} not compared: {}", y, c["not_compared"].get<std::string>());
        else
            log::info("{}: largest relative error {:.4f} % at {} = {:.4g}", y,
                      100.0 * c["largest_relative_error"].get<double>(), c["x"].get<std::string>(),
                      c["largest_at"].get<double>());
    }
    for (const auto& p : reference.value("profiles", nlohmann::json::array())) {
        if (p.contains("not_compared"))
            log::warn("profile not compared: {}", p["not_compared"].get<std::string>());
        else
            log::info("{} = {:g}: L2 error of raw sigma_r {:.4f} %, sigma_theta {:.4f} %",
                      p["measure"].get<std::string>(), p["value"].get<double>(),
                      100.0 * p["sigma_r_l2"].get<double>(), 100.0 * p["sigma_theta_l2"].get<double>());
    }
}

void report_derived(const nlohmann::json& derived) {
    std::vector<std::string> absent;
    for (const auto& [name, results] : derived.items())
        for (const auto& [key, value] : results.items())
            if (value.is_object() && value.contains("absent"))
                absent.push_back(key);
            else
                log::info("{} {}: {}", name, key, derived_text(value));
    if (!absent.empty())
        log::info("not derived, for reasons that are in summary.json: {}", fmt::join(absent, ", "));
}

} // namespace gault::core
