// frames/NNNN.h5: one frame, complete as soon as it has its name.
#pragma once
#include "core/output/results.hpp"

namespace gault::core {

struct FrameRecord { // what results.h5 and results.xdmf must know of a frame
    struct Field {
        std::string name;
        int components;
    };
    double time; // s
    std::vector<Field> fields;
};

std::string frame_name(std::size_t number);      // "0003"
std::string frame_file_name(std::size_t number); // "frames/0003.h5", relative to the results
bool is_frame_file(const std::string& name);     // "0003.h5", or its temporary name

// Throws RunError: a value that is not finite (names the dataset and the row), no attribute `time`, a failed
// write. Nothing is left of a frame that failed.
FrameRecord write_frame(const std::filesystem::path& folder, std::size_t number, std::size_t point_count,
                        const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets);

} // namespace gault::core
