// frames/NNNN.h5: one frame, complete as soon as it has its name. It holds the frame at the path that it has
// in results.h5, /frames/NNNN.
#pragma once
#include "core/output/hdf5_file.hpp"

namespace gault::core {

struct FrameRecord { // what is remembered of a written frame
    double time;     // s
    std::vector<FrameAttribute> attributes;
    std::vector<Dataset> datasets; // `fill` reads them back from the frame's file
};

std::string frame_path(std::size_t number);      // "/frames/0003", in HDF5 files
std::string frame_file_name(std::size_t number); // "frames/0003.h5", relative to the results
bool is_frame_file(const std::string& name);     // "0003.h5", or its temporary name

// Throws RunError: a value that is not finite (names the dataset and the row), no attribute `time`, a failed
// write. Nothing is left of a frame that failed.
FrameRecord write_frame(const std::filesystem::path& folder, std::size_t number, std::size_t point_count,
                        const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets);

// The same frame into another file, which has /frames.
void put_frame(Hdf5File& out, std::size_t number, std::size_t point_count,
               const std::vector<FrameAttribute>& attributes, const std::vector<Dataset>& datasets);

} // namespace gault::core
