// trajectory.nc: frames in a classic NetCDF file after the AMBER trajectory convention 1.0, extended as
// LAMMPS and OVITO extend it (id, type, radius, cell_origin, further variables a grain).
//
// Departures from the convention, each said in the file: SI units (every variable carries `units`; the
// convention has angstrom and picosecond); time and coordinates in double precision (the convention has
// float), since an overlap at rest is smaller than a float's last place; as the recent convention asks,
// cell_lengths is 0 where nothing is periodic.
//
// docs/reference/scenes.md lists all dimensions and variables. Numbers of a frame that need 64 bits are
// doubles: classic NetCDF has no such integer. A frame's grains fill the first places, the rest hold id -1.
// In a file with traffic a grain keeps its place, id and type when it has gone, and `present` is 0. Programs
// that know neither of id -1 nor of `present` draw every place, so a place without a grain has a grain that
// nobody sees: at rest in the container's lowest corner, with kAbsentRadius. Files of earlier versions have
// fill values there, or the last place of a grain that has gone. Every frame has a checksum of its moment and
// pose and one of its grains.
//
// The shape of a mesh is in the file once, as it is at rest; where the body is then says each frame, as of a
// plane. Rotation and spin of container and floor are there only where these turn.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/file_facts.hpp"
#include "engine/files/frame_faults.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/frame.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

// m, a nanometre: too small to be seen in any picture. Not 0, in whose place OVITO draws its usual radius
// of 1.
inline constexpr double kAbsentRadius = 1e-9;

// A body whose shape is a mesh.
struct TrajectoryMesh {
    std::size_t body = 0;  // its number, container and floor counted
    TriangleMesh shape;    // at rest, m
};

struct TrajectoryInfo {
    std::string title;
    std::string program_version;
    std::vector<std::string> species;
    std::size_t capacity = 0;  // the most grains that the file can hold, all that ever come counted
    bool traffic = false;      // grains come and go: each keeps its place, and `present` says who is there
    std::vector<std::string> bodies;     // names of those beyond container and floor
    std::vector<TrajectoryMesh> meshes;  // by rising number of the body
    bool container_turns = false;        // with its floor: frames then have how far
    bool orientation = false;
    bool contact_numbers = false;
    bool checksums = true;          // false in a file of an earlier version: there damage may look like data
    Vec3 cell_origin{0, 0, 0};      // m
    Vec3 periodic_length{0, 0, 0};  // m, 0 where nothing is periodic
    FileFacts facts = {};           // of what is read, densities alone
};

class TrajectoryWriter {
  public:
    // Throws RunError when the file cannot be written.
    TrajectoryWriter(const std::filesystem::path& path, const TrajectoryInfo& info);
    // Goes on with a file that was written with this info, behind its first `frames`; what comes after them
    // is cut off. Whether there are contact numbers the file decides. Throws UserError where the file lacks
    // some of them.
    TrajectoryWriter(const std::filesystem::path& path, const TrajectoryInfo& info, std::size_t frames);
    ~TrajectoryWriter();

    // Whether a file can be gone on with: it has as many places, and the same variables. Throws UserError
    // where it cannot be read, or is of other grains.
    static bool goes_on_with(const TrajectoryInfo& info, const std::filesystem::path& path);
    // How much of it the first `frames` are. Reads these where that will be needed. Throws UserError.
    static KeptRecords kept_of(const std::filesystem::path& path, std::size_t frames);
    // The first `frames` of a file, in a new one with this info, as if they had been written to that one from
    // the first. Whether there are contact numbers the old file decides.
    static void write_again(const std::filesystem::path& path, std::size_t frames,
                            const std::filesystem::path& to, TrajectoryInfo info);

    // The frame is in the file when this returns; a program killed later leaves it readable. Throws RunError
    // when it could not be written (disk full); the frames before stay readable.
    void write(const Frame& frame);

    std::int64_t frames() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

class TrajectoryReader {
  public:
    // Throws UserError when the file is missing, lacks more than its last frame, has a damaged header, or is
    // no such trajectory: then it says what it lacks.
    explicit TrajectoryReader(const std::filesystem::path& path);
    ~TrajectoryReader();

    std::size_t frames() const;  // whole ones
    // Whether the last frame that the header counts is not whole. The run was killed while it wrote that
    // frame, or a copy of the file was cut off there.
    bool cut_off() const;
    // Frames that lie in the file beyond those that its header counts: that count is damaged, or the run that
    // writes the file goes on.
    std::size_t uncounted() const;
    const TrajectoryInfo& info() const;

    // 0 <= index < frames(). Throw DamagedFrame, and UserError when the file cannot be read.
    Frame read(std::size_t index) const;
    // Likewise, but without the grains, which are most of the work: time, phase and pose alone.
    Frame read_moment(std::size_t index) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
