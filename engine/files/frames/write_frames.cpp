#include "engine/files/frames/write_frames.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"

// All writers, a line each: FrameFormat NAME_format() in engine/files/frames/writers.
#define GRAINREEL_FRAME_FORMATS(one)                                                             \
    one(trajectory) one(lammps_dump) one(lammps_data) one(xyz_writer) one(csv) one(vtk) one(stl) \
        one(gsd_writer) one(gltf) one(blender) one(grain_table)

namespace grainreel {

#define GRAINREEL_DECLARE(name) FrameFormat name##_format();
GRAINREEL_FRAME_FORMATS(GRAINREEL_DECLARE)
#undef GRAINREEL_DECLARE

const std::vector<FrameFormat>& frame_formats() {
#define GRAINREEL_LIST(name) name##_format(),
    static const std::vector<FrameFormat> all{GRAINREEL_FRAME_FORMATS(GRAINREEL_LIST)};
#undef GRAINREEL_LIST
    return all;
}

std::unique_ptr<FrameWriter> frame_writer(const std::string& format, const std::filesystem::path& path) {
    std::string known;
    for (const FrameFormat& one : frame_formats()) {
        if (format == one.name) return one.make(path);
        known += fmt::format("\n  {:<12}  {}", one.name, one.about);
    }
    throw UserError(fmt::format("'{}' is no format of frames. There are:{}", format, known));
}

}  // namespace grainreel
