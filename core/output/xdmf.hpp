// results.xdmf: how ParaView finds the frames of results.h5.
#pragma once
#include "core/output/frame_file.hpp"

namespace gault::core {

// A temporal collection of point clouds. The dataset `position` is the geometry; every other one is an
// attribute: Scalar, Vector, or Matrix. Six components are a Matrix rather than a Tensor6, because XDMF's
// Tensor6 is xx xy xz yy yz zz, while ours, xx yy zz xy yz zx, is what VTK and ParaView call a symmetric
// tensor.
std::string xdmf(const std::vector<FrameRecord>& frames, std::size_t point_count);

} // namespace gault::core
