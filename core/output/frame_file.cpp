#include "core/output/frame_file.hpp"
#include "core/output/atomic_file.hpp"

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

} // namespace

std::string frame_path(std::size_t number) {
    return fmt::format("/frames/{:04}", number);
}
std::string frame_file_name(std::size_t number) {
    return fmt::format("frames/{:04}.h5", number);
}

bool is_frame_file(const std::string& name) {
    const auto digits = std::min(name.find_first_not_of("0123456789"), name.size());
    const std::string rest = name.substr(digits);
    return digits >= 4 && (rest == ".h5" || rest == ".h5.tmp");
}

void put_frame(Hdf5File& out, std::size_t number, std::size_t point_count,
               const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets) {
    const std::string group = frame_path(number);
    out.group(group);
    for (const auto& [name, unit, value] : attributes) {
        out.attribute(group, name, value);
        out.attribute(group, name + "_unit", unit);
    }
    std::vector<double> values;
    for (const Dataset& dataset : datasets) {
        fill_finite(values, dataset, point_count, group);
        out.numbers(group + "/" + dataset.info.name, dataset.info, point_count, dataset.components,
                    values.data());
    }
}

FrameRecord write_frame(const std::filesystem::path& folder, std::size_t number, std::size_t point_count,
                        const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets) {
    const std::string path = frame_path(number);
    FrameRecord record{time_of(attributes, path), attributes, {}};
    for (const auto& [name, unit, value] : attributes)
        if (!std::isfinite(value)) throw RunError(fmt::format("{}: attribute '{}' is {}", path, name, value));

    const std::filesystem::path file = folder / frame_file_name(number);
    Hdf5File out(temporary_name(file));
    out.group("/frames");
    put_frame(out, number, point_count, attributes, datasets);
    out.close();
    publish(file);
    for (const auto& [info, components, fill] : datasets) {
        const auto read_back = [file, place = path + "/" + info.name](double* values) {
            read_numbers(file, place, values);
        };
        record.datasets.push_back({info, components, read_back});
    }
    return record;
}

} // namespace gault::core
