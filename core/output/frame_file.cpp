#include "core/output/frame_file.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/hdf5_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace gault::core {

namespace {

double time_of(const std::vector<FrameAttribute>& attributes, const std::string& frame) {
    const auto time = std::ranges::find(attributes, "time", &FrameAttribute::name);
    if (time == attributes.end()) throw RunError(frame + " has no attribute 'time'");
    return time->value;
}

void fill_finite(std::vector<double>& values, const Dataset& dataset, std::size_t rows,
                 const std::string& frame) {
    const auto components = static_cast<std::size_t>(dataset.components);
    values.resize(rows * components);
    dataset.fill(values.data());
    const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
    if (bad == values.end()) return;
    const auto position = static_cast<std::size_t>(bad - values.begin());
    throw RunError(fmt::format("{}: dataset '{}', row {}, component {} is {}", frame, dataset.info.name,
                               position / components, position % components, *bad));
}

void fill_file(const std::filesystem::path& file, const std::string& frame, std::size_t rows,
               const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets) {
    Hdf5File out(file);
    for (const auto& [name, unit, value] : attributes) {
        out.attribute("/", name, value);
        out.attribute("/", name + "_unit", unit);
    }
    std::vector<double> values;
    for (const Dataset& dataset : datasets) {
        fill_finite(values, dataset, rows, frame);
        out.numbers("/" + dataset.info.name, dataset.info, rows, dataset.components, values.data());
    }
    out.close();
}

} // namespace

std::string frame_name(std::size_t number) {
    return fmt::format("{:04}", number);
}
std::string frame_file_name(std::size_t number) {
    return "frames/" + frame_name(number) + ".h5";
}

bool is_frame_file(const std::string& name) {
    const auto digits = std::min(name.find_first_not_of("0123456789"), name.size());
    const std::string rest = name.substr(digits);
    return digits >= 4 && (rest == ".h5" || rest == ".h5.tmp");
}

FrameRecord write_frame(const std::filesystem::path& folder, std::size_t number, std::size_t point_count,
                        const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets) {
    const std::string frame = "frame " + frame_name(number);
    FrameRecord record{time_of(attributes, frame), {}};
    for (const auto& [name, unit, value] : attributes)
        if (!std::isfinite(value))
            throw RunError(fmt::format("{}: attribute '{}' is {}", frame, name, value));
    for (const Dataset& dataset : datasets)
        record.fields.push_back({dataset.info.name, dataset.components});

    const std::filesystem::path file = folder / frame_file_name(number);
    try {
        fill_file(temporary_name(file), frame, point_count, attributes, datasets);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary_name(file), ignored);
        throw;
    }
    publish(file);
    return record;
}

} // namespace gault::core
