// Writes and reads trajectory.nc. It is classic NetCDF after the AMBER trajectory convention 1.0, extended as
// LAMMPS and OVITO extend it (id, type, radius, cell_origin, more variables for each grain). All variables
// are named in trajectory_layout.hpp and listed in docs/reference/run_files.md. Old files must stay readable.
//
// The file departs from the convention in three points, which its attribute `deviations` names. Units are SI
// (each variable has `units`) and not angstrom and picosecond. Time and coordinates are doubles and not
// floats, since an overlap at rest is smaller than the last digit of a float. Places for grains may be empty.
// cell_lengths is 0 where nothing is periodic. Whole numbers of 64 bits are doubles, because classic NetCDF
// has no such integer.
//
// The grains of a frame fill the first places, and the other places have id -1. In a file with traffic
// (grains come or go) a grain that leaves keeps its place, id and type, and `present` becomes 0. Programs
// that know neither id -1 nor `present` draw every place. An empty place therefore holds a grain that nobody
// sees: at rest in the container's lowest corner, with kAbsentRadius. (In files of earlier versions it holds
// fill values, or the last position of the grain that left.) Each frame has a checksum of its moment and
// poses and one of its grains.
//
// The shape of a mesh is in the file once, as it is at rest; each frame has the pose of its body. Rotation
// and spin of container and floor are in the file only where these turn.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/triangle_mesh.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/file_facts.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct Plan;   // engine/plan/plan.hpp
struct Scene;  // engine/scene/scene.hpp

// m. A nanometre is too small for any picture. It is not 0, because OVITO then draws its default radius of 1.
inline constexpr double kAbsentRadius = 1e-9;

// A body whose shape is a mesh.
struct TrajectoryMesh {
    std::size_t body = 0;  // its number; container and floor count
    TriangleMesh shape;    // at rest, m
};

// The box of a frame.
struct TrajectoryCell {
    Vec3 origin{0, 0, 0};     // m, the lowest corner
    Vec3 length{0, 0, 0};     // m along each edge, 0 where nothing is periodic
    Vec3 angles{90, 90, 90};  // degrees, between the second and third edge, first and third, first and second
    bool operator==(const TrajectoryCell&) const = default;
};

// What the header of the file says.
struct TrajectoryInfo {
    std::string title;
    std::string program_version;
    std::vector<std::string> species;
    std::size_t capacity = 0;            // number of places for grains; grains that come later count
    bool traffic = false;                // grains come and go; `present` says which are there
    std::vector<std::string> bodies;     // names of the bodies after container and floor
    std::vector<TrajectoryMesh> meshes;  // by rising number of their bodies
    bool container_turns = false;        // container and floor turn, and frames have their rotations
    bool orientation = false;
    bool shapes = false;  // grains are ellipsoids or superquadrics, and have orientations
    bool contact_numbers = false;
    bool masses = false;                   // grains have masses of their own
    bool velocities = true, spins = true;  // false where the files that were read have none
    bool checksums = true;     // false in a file of an earlier version, where damage may look like data
    TrajectoryCell cell = {};  // of the first frame, and of all if nobody says otherwise
    bool steps_known = true;   // false where the steps only number the frames
    int first_id = 0;          // 1 where grains are counted from 1
    FileFacts facts = {};      // in the info of a file that is read, only the densities
};

class TrajectoryWriter {
  public:
    // Throws RunError when the file cannot be written.
    TrajectoryWriter(const std::filesystem::path& path, const TrajectoryInfo& info);
    // Continues a file that was written with this info after its first `frames`; later frames are cut off.
    // The file decides whether there are contact numbers. Throws UserError where some of these frames are
    // missing.
    TrajectoryWriter(const std::filesystem::path& path, const TrajectoryInfo& info, std::size_t frames);
    ~TrajectoryWriter();

    // Whether a file can be continued: it must have as many places for grains. Throws UserError where it
    // cannot be read, or has other species, bodies, meshes or variables.
    static bool goes_on_with(const TrajectoryInfo& info, const std::filesystem::path& path);
    // How much of the file stays if its first `frames` are kept. Throws UserError where one of these frames
    // is damaged, if the writer will need it (in a file with traffic).
    static KeptRecords kept_of(const std::filesystem::path& path, std::size_t frames);
    // Writes the first `frames` of a file into a new one with this info. The old file decides whether there
    // are contact numbers.
    static void write_again(const std::filesystem::path& path, std::size_t frames,
                            const std::filesystem::path& to, TrajectoryInfo info);

    // The box of the frames that follow.
    void set_cell(const TrajectoryCell& cell);
    // The frame is in the file when this returns, and stays readable if the program is killed. Throws
    // RunError when it could not be written (disk full); earlier frames stay readable.
    void write(const State& frame);

    std::int64_t frames() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

class TrajectoryReader {
  public:
    // Throws UserError when the file is missing, is cut off before its last frame, has a damaged header or is
    // no such trajectory; the message says what is missing.
    explicit TrajectoryReader(const std::filesystem::path& path);
    ~TrajectoryReader();

    std::size_t frames() const;  // number of whole frames
    // Whether the last frame that the header counts is not whole, because the run was killed while it wrote
    // that frame or a copy of the file was cut off.
    bool cut_off() const;
    // Number of frames beyond those that the header counts. Either the count is damaged or the run is still
    // going on.
    std::size_t uncounted() const;
    const TrajectoryInfo& info() const;

    // A frame, 0 <= index < frames(). read() and read_moment() throw DamagedFrame, and UserError when the
    // file cannot be read.
    State read(std::size_t index) const;
    // The frame without its grains, which are most of the work: time, phase and poses only.
    State read_moment(std::size_t index) const;
    TrajectoryCell cell(std::size_t index) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The header for files of moments of a run: trajectory.nc, film_moments.nc, key_moments.nc. It has places for
// all grains that the plan expects.
TrajectoryInfo trajectory_info(const Scene& scene, const Plan& plan, const std::string& program_version);

}  // namespace grainreel
