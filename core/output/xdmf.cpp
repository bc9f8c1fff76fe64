#include "core/output/xdmf.hpp"

#include <fmt/format.h>

namespace gault::core {

namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += c;
        }
    }
    return out;
}

std::string data_item(std::size_t frame, const Dataset& field, std::size_t rows) {
    const std::string shape =
        field.components == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, field.components);
    return fmt::format(
        R"(<DataItem Format="HDF" NumberType="Float" Precision="8" Dimensions="{}">results.h5:{}/{}</DataItem>)",
        shape, frame_path(frame), escaped(field.info.name));
}

std::string field_element(std::size_t frame, const Dataset& field, std::size_t rows) {
    const std::string data = data_item(frame, field, rows);
    if (field.info.name == "position")
        return fmt::format("    <Geometry GeometryType=\"XYZ\">{}</Geometry>\n", data);
    const char* type = field.components == 1 ? "Scalar" : field.components == 3 ? "Vector" : "Matrix";
    return fmt::format("    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                       escaped(field.info.name), type, data);
}

} // namespace

std::string xdmf(const std::vector<FrameRecord>& frames, std::size_t point_count) {
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
                      "<Grid Name=\"points\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (std::size_t number = 0; number < frames.size(); ++number) {
        out += fmt::format(
            "  <Grid Name=\"{0}\" GridType=\"Uniform\">\n    <Time Value=\"{1}\"/>\n"
            "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{2}\" NodesPerElement=\"1\">"
            "<DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"8\" Dimensions=\"{2}\">"
            "results.h5:/point</DataItem></Topology>\n",
            frame_path(number), frames[number].time, point_count);
        for (const auto& field : frames[number].datasets)
            out += field_element(number, field, point_count);
        out += "  </Grid>\n";
    }
    return out + "</Grid>\n</Domain>\n</Xdmf>\n";
}

} // namespace gault::core
