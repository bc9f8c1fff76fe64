#include "core/output/results.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/frame_file.hpp"
#include "core/output/hdf5_file.hpp"
#include "core/output/history.hpp"
#include "core/output/xdmf.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace gault::core {

namespace fs = std::filesystem;

namespace {

// In the order of removal: whatever refers to another file goes before it.
constexpr std::array files{"summary.json", "results.xdmf", "results.h5", "history.csv", "failed_point.yaml"};

constexpr std::array<std::array<const char*, 2>, 6> conventions{{
    {"format", "gault results 1"},
    {"sign", "/frames: tension positive; /history: compression positive"},
    {"component_order", "xx yy zz xy yz zx; shear components are tensor components"},
    {"position",
     "current; (r, y, 0) in axisymmetric scenes, where zz is the hoop direction; (x, y, 0) in plane "
     "strain, where zz is out of plane"},
    {"volume",
     "current; of the whole ring (2 pi r) in axisymmetric scenes, of 1 m thickness in plane strain"},
    {"row", "a material point keeps its row in every frame"},
}};

std::vector<fs::path> earlier_results(const fs::path& folder) {
    std::vector<fs::path> found;
    const auto add = [&](const fs::path& file) {
        if (!fs::exists(fs::symlink_status(file))) return;
        if (fs::is_directory(file)) throw InputError(fmt::format("'{}' is a folder", file.string()));
        found.push_back(file);
    };
    for (const char* name : files)
        add(folder / name);
    if (fs::is_directory(folder / "frames"))
        for (const auto& entry : fs::directory_iterator(folder / "frames"))
            if (is_frame_file(entry.path().filename().string())) add(entry.path());
    return found;
}

void prepare(const fs::path& folder, bool replace) {
    fs::create_directories(folder);
    const std::vector<fs::path> earlier = earlier_results(folder);
    if (!earlier.empty() && !replace)
        throw InputError(fmt::format("'{}' already holds results ({}): choose another folder, or --force to "
                                     "replace them",
                                     folder.string(), earlier.front().filename().string()));
    for (const fs::path& file : earlier)
        fs::remove(file);
    for (const char* name : files)
        fs::remove(temporary_name(folder / name));
    fs::create_directories(folder / "frames");
}

} // namespace

struct ResultWriter::Impl {
    fs::path folder;
    std::vector<ColumnInfo> columns;
    Provenance provenance;
    std::size_t point_count;
    HistoryFile history;
    std::vector<std::vector<double>> rows = {};
    std::vector<FrameRecord> frames = {};

    void write_history(Hdf5File& out) const {
        out.group("/history");
        std::vector<double> values(rows.size());
        for (std::size_t column = 0; column < columns.size(); ++column) {
            for (std::size_t row = 0; row < rows.size(); ++row)
                values[row] = rows[row][column];
            out.numbers("/history/" + columns[column].name, columns[column], rows.size(), 1, values.data());
        }
    }

    // While the run goes on a frame is a link to its own file; at the end it is a copy.
    void write_results(bool finished) const {
        const fs::path file = folder / "results.h5";
        Hdf5File out(temporary_name(file));
        for (const auto& [name, text] : conventions)
            out.attribute("/", name, std::string(text));
        out.attribute("/", "status", std::string(finished ? "finished" : "running"));
        out.text("/scene", "the scene as run, YAML", provenance.scene_yaml);
        out.text("/provenance", "what made these results, JSON",
                 provenance.text.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
        out.count("/point", "the number of the material point in each row of a frame", point_count);
        write_history(out);
        out.group("/frames");
        for (std::size_t number = 0; number < frames.size(); ++number) {
            if (finished)
                put_frame(out, number, point_count, frames[number].attributes, frames[number].datasets);
            else
                out.link(frame_path(number), frame_file_name(number));
        }
        out.close();
        publish(file);
    }
};

ResultWriter::ResultWriter(fs::path folder, bool replace, std::vector<ColumnInfo> history_columns,
                           const Provenance& provenance, std::size_t point_count) {
    try {
        prepare(folder, replace);
        impl_.reset(new Impl{folder, history_columns, provenance, point_count,
                             HistoryFile(folder / "history.csv", history_columns)});
        impl_->write_results(false);
    } catch (const fs::filesystem_error& error) {
        throw InputError(
            fmt::format("cannot write results in '{}': {}", folder.string(), error.code().message()));
    } catch (const RunError& error) {
        throw InputError(error.what());
    }
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::row(const std::vector<double>& values) {
    const auto& columns = impl_->columns;
    if (values.size() != columns.size())
        throw RunError(fmt::format("history row {}: {} values for {} columns", rows().size(), values.size(),
                                   columns.size()));
    for (std::size_t column = 0; column < columns.size(); ++column)
        if (!std::isfinite(values[column]))
            throw RunError(fmt::format("history row {}: column '{}' is {}", rows().size(),
                                       columns[column].header(), values[column]));
    impl_->history.append(values);
    impl_->rows.push_back(values);
}

void ResultWriter::frame(const std::vector<FrameAttribute>& attributes,
                         const std::vector<Dataset>& datasets) {
    impl_->history.sync();
    // Each file refers to the one before it only.
    impl_->frames.push_back(
        write_frame(impl_->folder, impl_->frames.size(), impl_->point_count, attributes, datasets));
    impl_->write_results(false);
    write_atomically(folder() / "results.xdmf", xdmf(impl_->frames, impl_->point_count));
}

void ResultWriter::failed_point(const std::string& yaml) {
    write_atomically(folder() / "failed_point.yaml", yaml);
}

void ResultWriter::summary(const nlohmann::json& summary) {
    write_atomically(folder() / "summary.json",
                     summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void ResultWriter::finish() {
    impl_->history.sync();
    impl_->write_results(true);
    std::error_code ignored; // what stays is not referred to, and a folder with a stranger's files must stay
    for (std::size_t number = 0; number < impl_->frames.size(); ++number)
        fs::remove(folder() / frame_file_name(number), ignored);
    fs::remove(folder() / "frames", ignored);
}

const std::vector<std::vector<double>>& ResultWriter::rows() const {
    return impl_->rows;
}
const fs::path& ResultWriter::folder() const {
    return impl_->folder;
}

} // namespace gault::core
