#include "core/output/hdf5_file.hpp"

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>

namespace gault::core {

namespace {

// The deepest message of HDF5's error stack, or within it the operating system's own words.
std::string reason() {
    std::string text = "unknown HDF5 error";
    const auto keep = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
        if (error->desc && *error->desc) *static_cast<std::string*>(out) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep, &text);
    constexpr std::string_view mark = "error message = '";
    if (const auto begin = text.find(mark); begin != std::string::npos) {
        const auto from = begin + mark.size();
        return text.substr(from, text.find('\'', from) - from);
    }
    return text;
}

hid_t create(const std::filesystem::path& file) {
    static const bool ready = [] {
        // The library's own clean-up crashes on a file whose disk was full; we close every file.
        H5dont_atexit();
        return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
    }();
    (void)ready;
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // Another inode: HDF5 may still hold a file of this name that could not be written.
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    // Nobody else sees a temporary name, and some network file systems cannot lock.
    H5Pset_file_locking(access, false, true);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    return H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

Hdf5Handle untimed() { // the same results give the same bytes
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(properties, false);
    return {properties, H5Pclose};
}

Hdf5Handle text_type() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return {type, H5Tclose};
}

Hdf5Handle scalar() {
    return {H5Screate(H5S_SCALAR), H5Sclose};
}

} // namespace

Hdf5File::Hdf5File(const std::filesystem::path& file) : name_(file), file_(create(file), H5Fclose) {
    check(file_);
}

Hdf5File::~Hdf5File() {
    if (complete_) return;
    // Closing a file that cannot be written would crash HDF5 at its next use: such a file stays open.
    if (file_ >= 0 && H5Fflush(file_, H5F_SCOPE_LOCAL) < 0) file_.release();
    std::error_code ignored;
    std::filesystem::remove(name_, ignored);
}

hid_t Hdf5File::check(hid_t result) const {
    if (result < 0) throw RunError(fmt::format("cannot write '{}': {}", name_.string(), reason()));
    return result;
}

void Hdf5File::group(const std::string& path) {
    const Hdf5Handle group(check(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
                           H5Gclose);
}

void Hdf5File::attribute(const std::string& object, const std::string& name, double value) {
    const Hdf5Handle space = scalar();
    const Hdf5Handle attribute(check(H5Acreate_by_name(file_, object.c_str(), name.c_str(), H5T_IEEE_F64LE,
                                                       space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
                               H5Aclose);
    check(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::string& value) {
    const Hdf5Handle owner(check(H5Oopen(file_, object.c_str(), H5P_DEFAULT)), H5Oclose);
    text_attribute(owner, name, value);
}

void Hdf5File::text_attribute(hid_t object, const std::string& name, const std::string& value) {
    const Hdf5Handle space = scalar(), type = text_type();
    const Hdf5Handle attribute(check(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT)),
                               H5Aclose);
    const char* characters = value.c_str();
    check(H5Awrite(attribute, type, &characters));
}

void Hdf5File::describe(hid_t object, const std::string& unit, const std::string& description) {
    text_attribute(object, "unit", unit);
    text_attribute(object, "description", description);
}

void Hdf5File::numbers(const std::string& path, const ColumnInfo& info, std::size_t rows, int components,
                       const double* values) {
    const std::array<hsize_t, 2> shape{rows, static_cast<hsize_t>(components)};
    const Hdf5Handle space(check(H5Screate_simple(components == 1 ? 1 : 2, shape.data(), nullptr)), H5Sclose);
    const Hdf5Handle properties = untimed();
    const Hdf5Handle dataset(
        check(H5Dcreate2(file_, path.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT)),
        H5Dclose);
    describe(dataset, info.unit, info.description);
    if (components == 3) text_attribute(dataset, "components", "x y z");
    if (components == 6) text_attribute(dataset, "components", "xx yy zz xy yz zx");
    if (rows > 0) check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

void Hdf5File::count(const std::string& path, const std::string& description, std::size_t rows) {
    std::vector<std::int64_t> values(rows);
    std::iota(values.begin(), values.end(), 0);
    const hsize_t shape = rows;
    const Hdf5Handle space(check(H5Screate_simple(1, &shape, nullptr)), H5Sclose), properties = untimed();
    const Hdf5Handle dataset(
        check(H5Dcreate2(file_, path.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT)),
        H5Dclose);
    describe(dataset, "1", description);
    check(H5Dwrite(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
}

void Hdf5File::text(const std::string& path, const std::string& description, const std::string& value) {
    const Hdf5Handle space = scalar(), type = text_type(), properties = untimed();
    const Hdf5Handle dataset(
        check(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT)), H5Dclose);
    describe(dataset, "1", description);
    const char* characters = value.c_str();
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &characters));
}

void Hdf5File::link(const std::string& path, const std::string& relative_file) {
    check(H5Lcreate_external(relative_file.c_str(), path.c_str(), file_, path.c_str(), H5P_DEFAULT,
                             H5P_DEFAULT));
}

void Hdf5File::close() {
    check(H5Fclose(file_.release()));
    complete_ = true;
}

void read_numbers(const std::filesystem::path& file, const std::string& path, double* values) {
    const Hdf5Handle source(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    const Hdf5Handle dataset(H5Dopen2(source, path.c_str(), H5P_DEFAULT), H5Dclose);
    if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        throw RunError(fmt::format("cannot read '{}': {}", file.string(), reason()));
}

} // namespace gault::core
