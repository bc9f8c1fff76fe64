#include "tests/unit/output/support.hpp"
#include "core/output/hdf5_file.hpp"

#include <cstdlib>
#include <fstream>
#include <libxml/parser.h>
#include <libxml/tree.h>
#include <sstream>

namespace gault::core::test {

namespace fs = std::filesystem;

namespace {

hid_t check(hid_t id, const std::string& what) {
    if (id < 0) throw std::runtime_error("HDF5 cannot read " + what);
    return id;
}

Hdf5Handle open(const fs::path& file) {
    // As the writer does before it uses the library: a fork of this process may go on with a full disk.
    static const bool without_clean_up = H5dont_atexit() >= 0; // or the writer was first
    (void)without_clean_up;
    return {check(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), file.string()), H5Fclose};
}

std::string take(char* characters) {
    std::string result = characters;
    H5free_memory(characters);
    return result;
}

void collect(const xmlNode* node, std::vector<Reference>& found) {
    for (; node; node = node->next) {
        if (node->type == XML_ELEMENT_NODE &&
            std::string(reinterpret_cast<const char*>(node->name)) == "DataItem") {
            xmlChar* content = xmlNodeGetContent(node);
            xmlChar* shape = xmlGetProp(node, reinterpret_cast<const xmlChar*>("Dimensions"));
            const std::string place = reinterpret_cast<const char*>(content);
            const auto colon = place.find(':');
            std::istringstream sizes(reinterpret_cast<const char*>(shape));
            Reference reference{place.substr(0, colon), place.substr(colon + 1), {}};
            for (std::size_t size; sizes >> size;)
                reference.shape.push_back(size);
            found.push_back(reference);
            xmlFree(content);
            xmlFree(shape);
        }
        collect(node->children, found);
    }
}

} // namespace

Folder::Folder() {
    std::string name = fs::temp_directory_path() / "gault é XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path = name;
}

Folder::~Folder() {
    fs::remove_all(path);
}

const std::vector<ColumnInfo> columns{{"time", "s", "since the start"},
                                      {"load", "Pa", "compression positive"},
                                      {"settlement", "1", "relative"}};

std::vector<double> row(std::size_t number) {
    const auto n = static_cast<double>(number);
    return {0.1 * n, 1000.0 / (n + 1.0), n / 3.0};
}

double value(std::size_t frame, std::size_t entry) {
    return 1e6 * static_cast<double>(frame) + static_cast<double>(entry);
}

std::vector<Dataset> datasets(std::size_t frame, std::size_t points) {
    const auto filled = [&](const char* name, const char* unit, int components) {
        return Dataset{{name, unit, std::string("the ") + name}, components, [=](double* out) {
                           for (std::size_t i = 0; i < points * static_cast<std::size_t>(components); ++i)
                               out[i] = value(frame, i);
                       }};
    };
    return {filled("position", "m", 3), filled("stress", "Pa", 6), filled("volume", "m^3", 1)};
}

std::vector<FrameAttribute> attributes(std::size_t frame) {
    return {{"time", "s", 0.5 * static_cast<double>(frame)}, {"settlement", "1", 0.25}};
}

ResultWriter writer(const fs::path& folder, std::size_t points, bool replace) {
    return {folder, replace, columns, {"gault: 1\ntitle: µ\n", {{"program", "gault"}}}, points};
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error("cannot read " + file.string());
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> lines_of(const fs::path& file) {
    std::istringstream stream(text_of(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

std::vector<std::string> members(const fs::path& file, const std::string& group) {
    const Hdf5Handle opened = open(file);
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->push_back(name);
        return 0;
    };
    check(H5Literate_by_name(opened, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names,
                             H5P_DEFAULT),
          group);
    return names;
}

Numbers numbers(const fs::path& file, const std::string& dataset) {
    const Hdf5Handle opened = open(file);
    const Hdf5Handle data(check(H5Dopen2(opened, dataset.c_str(), H5P_DEFAULT), dataset), H5Dclose);
    const Hdf5Handle space(H5Dget_space(data), H5Sclose);
    std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    Numbers result{{shape.begin(), shape.end()},
                   std::vector<double>(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)))};
    check(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()), dataset);
    return result;
}

std::string text(const fs::path& file, const std::string& dataset) {
    const Hdf5Handle opened = open(file);
    const Hdf5Handle data(check(H5Dopen2(opened, dataset.c_str(), H5P_DEFAULT), dataset), H5Dclose);
    const Hdf5Handle type(H5Dget_type(data), H5Tclose);
    char* characters = nullptr;
    check(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &characters), dataset);
    return take(characters);
}

double attribute(const fs::path& file, const std::string& object, const std::string& name) {
    const Hdf5Handle opened = open(file);
    const Hdf5Handle held(
        check(H5Aopen_by_name(opened, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name),
        H5Aclose);
    double result = 0.0;
    check(H5Aread(held, H5T_NATIVE_DOUBLE, &result), name);
    return result;
}

std::string text_attribute(const fs::path& file, const std::string& object, const std::string& name) {
    const Hdf5Handle opened = open(file);
    const Hdf5Handle held(
        check(H5Aopen_by_name(opened, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name),
        H5Aclose);
    const Hdf5Handle type(H5Aget_type(held), H5Tclose);
    char* characters = nullptr;
    check(H5Aread(held, type, &characters), name);
    return take(characters);
}

std::vector<Reference> references(const fs::path& xdmf) {
    xmlDoc* document = xmlReadFile(xdmf.c_str(), nullptr, XML_PARSE_NOERROR | XML_PARSE_NOWARNING);
    if (!document) throw std::runtime_error(xdmf.string() + " is not XML");
    std::vector<Reference> found;
    collect(xmlDocGetRootElement(document), found);
    xmlFreeDoc(document);
    return found;
}

} // namespace gault::core::test
