// Writes frames in any format that there is.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/frames/frame_writer.hpp"

namespace grainreel {

const std::vector<FrameFormat>& frame_formats();

// Throws UserError, with a list of the names, where there is no such format.
std::unique_ptr<FrameWriter> frame_writer(const std::string& format, const std::filesystem::path& path);

}  // namespace grainreel
