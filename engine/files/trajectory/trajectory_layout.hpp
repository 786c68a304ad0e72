// Names the variables of trajectory.nc once for writer and reader, and writes and reads those with the shapes
// of meshes. A variable that is renamed or moved in these lists changes checksums and makes old files
// unreadable.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <netcdf.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/files/damage.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/files/trajectory/trajectory.hpp"

namespace grainreel {

struct TrajectoryVariable {
    const char* name;
    int type;               // one of the types in <netcdf.h>
    const char* dimension;  // the last dimension of a vector; null for a single number
    const char* units;      // as in UDUNITS, or in the convention's spelling
    const char* about;      // long_name
    const char* comment = "";
};

// Variables with one value for each frame, in the order in which they are written, read and added to
// `frame_checksum`.
inline constexpr std::array frame_variables{
    TrajectoryVariable{"time", NC_DOUBLE, nullptr, "second", "time since the drive started"},
    TrajectoryVariable{"cycles", NC_DOUBLE, nullptr, "1", "periods of the drive since it started",
                       "0 without a drive"},
    TrajectoryVariable{"phase", NC_DOUBLE, nullptr, "1", "phase of the drive",
                       "in turns, 0 to 1; the drive is at its sine's 0 at 0; 0 without a drive"},
    TrajectoryVariable{"step", NC_DOUBLE, nullptr, "1", "number of the time step", "a whole number"},
    TrajectoryVariable{"grains", NC_INT, nullptr, "1", "number of grains that are there",
                       "they have the first places, or, where there is `present`, those where it is 1"},
    TrajectoryVariable{
        "wall_offset", NC_DOUBLE, "spatial", "m", "displacement of the walls from their place at rest",
        "of the container as a whole where the drive moves it; 0 where it moves the floor alone"},
    TrajectoryVariable{"wall_velocity", NC_DOUBLE, "spatial", "m s-1", "velocity of the walls"},
    TrajectoryVariable{"floor_offset", NC_DOUBLE, "spatial", "m",
                       "displacement of the floor from its place at rest",
                       "that of the walls, where the drive moves the container"},
    TrajectoryVariable{"floor_velocity", NC_DOUBLE, "spatial", "m s-1", "velocity of the floor"},
    TrajectoryVariable{"cell_origin", NC_DOUBLE, "cell_spatial", "meter",
                       "lowest corner of the container at rest"},
    TrajectoryVariable{"cell_lengths", NC_DOUBLE, "cell_spatial", "meter", "period along each axis",
                       "0 where nothing is periodic"},
    TrajectoryVariable{"cell_angles", NC_DOUBLE, "cell_angular", "degree", "angles of the periodic cell"}};

// Variables with one value for each grain and frame, in the order in which they are written, read and added
// to `grain_checksum`. orientation, contact_number, mass, half_lengths, blockiness and present follow there.
inline constexpr std::array grain_variables{
    TrajectoryVariable{
        "id", NC_INT, nullptr, "1", "number of the grain",
        "from 0, the same in all frames and files of the run; -1 in a place that no grain has had"},
    TrajectoryVariable{"type", NC_INT, nullptr, "1", "species of the grain",
                       "from 1, in the order of the attributes; -1 in a place that no grain has had"},
    TrajectoryVariable{
        "radius", NC_DOUBLE, nullptr, "m", "radius of the grain",
        "its mass is 4/3 pi radius^3 times the density of its type; 1e-9 in a place without a grain"},
    TrajectoryVariable{"coordinates", NC_DOUBLE, "spatial", "meter", "place of the grain's centre",
                       "in the room; the container's lowest corner in a place without a grain"},
    TrajectoryVariable{"velocities", NC_FLOAT, "spatial", "m s-1", "velocity of the grain", "in the room"},
    TrajectoryVariable{"spin", NC_FLOAT, "spatial", "rad s-1", "angular velocity of the grain"}};

// Turns of container and floor, only in files of containers that turn. They follow frame_variables in
// `frame_checksum`.
inline constexpr std::array turn_variables{
    TrajectoryVariable{"wall_rotation", NC_DOUBLE, "quaternion", "1", "how far the walls have turned",
                       "x, y, z, w of a unit quaternion; about the scene's origin, before `wall_offset`"},
    TrajectoryVariable{"wall_spin", NC_DOUBLE, "spatial", "rad s-1", "angular velocity of the walls",
                       "`wall_velocity` is that of the point that was at the scene's origin"},
    TrajectoryVariable{"floor_rotation", NC_DOUBLE, "quaternion", "1", "how far the floor has turned",
                       "likewise, before `floor_offset`"},
    TrajectoryVariable{"floor_spin", NC_DOUBLE, "spatial", "rad s-1", "angular velocity of the floor"}};

// Poses of all bodies except container and floor. They come last in `frame_checksum`.
inline constexpr std::array body_variables{
    TrajectoryVariable{"body_place", NC_DOUBLE, "spatial", "m",
                       "displacement of a plane of the scene from its place at rest"},
    TrajectoryVariable{"body_rotation", NC_DOUBLE, "quaternion", "1", "how far a plane has turned",
                       "x, y, z, w of a unit quaternion"},
    TrajectoryVariable{"body_velocity", NC_DOUBLE, "spatial", "m s-1", "velocity of a plane"},
    TrajectoryVariable{"body_spin", NC_DOUBLE, "spatial", "rad s-1", "angular velocity of a plane"}};

// The same variables in files that have meshes.
inline constexpr std::array body_variables_with_meshes{
    TrajectoryVariable{"body_place", NC_DOUBLE, "spatial", "m",
                       "displacement of a plane or mesh of the scene from its place at rest",
                       "of the point that was at the scene's origin; a point of the body that was at x at "
                       "rest is at body_place + R x, R by body_rotation"},
    TrajectoryVariable{"body_rotation", NC_DOUBLE, "quaternion", "1", "how far a plane or mesh has turned",
                       "x, y, z, w of a unit quaternion; about the scene's origin, before `body_place`"},
    TrajectoryVariable{"body_velocity", NC_DOUBLE, "spatial", "m s-1", "velocity of a plane or mesh",
                       "of the point that was at the scene's origin"},
    TrajectoryVariable{"body_spin", NC_DOUBLE, "spatial", "rad s-1", "angular velocity of a plane or mesh"}};
static_assert(body_variables_with_meshes.size() == body_variables.size());

// The shapes of the meshes, once in each file. `mesh_checksum` adds them in this order.
inline constexpr TrajectoryVariable mesh_body_variable{
    "mesh_body",
    NC_INT,
    nullptr,
    "1",
    "body whose shape the mesh is",
    "0: the walls, 1: the floor, 2: the first of those that `body_place` names"};
inline constexpr TrajectoryVariable mesh_vertices_variable{"mesh_vertices", NC_INT, nullptr, "1",
                                                           "vertices of each mesh"};
inline constexpr TrajectoryVariable mesh_triangles_variable{"mesh_triangles", NC_INT, nullptr, "1",
                                                            "triangles of each mesh"};
inline constexpr TrajectoryVariable vertex_variable{
    "vertices", NC_DOUBLE, "spatial", "m", "places of the meshes' vertices at rest", "mesh after mesh"};
inline constexpr TrajectoryVariable triangle_variable{
    "triangles",
    NC_INT,
    "corner",
    "1",
    "the three vertices of each triangle",
    "mesh after mesh; from 0, of the mesh's own vertices; counter-clockwise seen from outside"};
inline constexpr const char *mesh_checksum = "mesh_checksum",
                            *mesh_checksum_about = "XXH64 of the shapes of the meshes";

// Only in files of runs that grains enter or leave: 1 where a place has a grain now. It is last in
// `grain_checksum`.
inline constexpr TrajectoryVariable present_variable{
    "present",
    NC_INT,
    nullptr,
    "1",
    "whether the place has a grain now",
    "1: it has; 0: its grain has left, or, where `id` is -1, not come yet"};

// Only in files for which orientations were asked for.
inline constexpr TrajectoryVariable orientation_variable{"orientation",
                                                         NC_FLOAT,
                                                         "quaternion",
                                                         "1",
                                                         "how far the grain has turned",
                                                         "x, y, z, w of a unit quaternion"};

// Files of earlier versions do not have it.
inline constexpr TrajectoryVariable contact_number_variable{
    "contact_number",       NC_INT, nullptr, "1", "contacts of the grain that carry force",
    "with grains and walls"};

// Only in files of other programs' runs whose grains have masses of their own.
inline constexpr TrajectoryVariable mass_variable{
    "mass", NC_DOUBLE,           nullptr,
    "kg",   "mass of the grain", "as its file has it; 0 in a place without a grain"};

// Only in files of other programs' runs whose grains are ellipsoids or superquadrics.
inline constexpr TrajectoryVariable half_lengths_variable{"half_lengths",
                                                          NC_FLOAT,
                                                          "spatial",
                                                          "m",
                                                          "half the lengths of the grain along its own axes",
                                                          "0 in a place without a grain"};
inline constexpr TrajectoryVariable blockiness_variable{
    "blockiness",
    NC_FLOAT,
    "power",
    "1",
    "powers of a superquadric, along its z and around it",
    "2 and 2: an ellipsoid; (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1"};

// An attribute of `velocities` and `spin`, only where the files that were read have no such numbers: then all
// are 0. A single number that is not known is NaN.
inline constexpr const char *unknown_attribute = "unknown",
                            *unknown_about = "the files that these frames come from do not say it";

// The names of axes that the convention asks for.
struct TrajectoryLabel {
    const char* name;
    const char* about;
};
inline constexpr std::array label_variables{
    TrajectoryLabel{"spatial", "names of the axes"},
    TrajectoryLabel{"cell_spatial", "names of the edges of the periodic cell"},
    TrajectoryLabel{"cell_angular", "names of the angles of the periodic cell"}};

// Attributes that only files made of other programs' frames have: of `step`, where these say no steps, and of
// `id`, where they count grains from another number than 0.
inline constexpr const char *kStepsOf = "counts",
                            *kStepsOfFrames = "frames, for the file that they come from says no steps",
                            *kFirstId = "first",
                            *kFromFirst =
                                "as in the files that the frames come from, which count from "
                                "`first`; -1 in a place that no grain has had";

inline constexpr const char *frame_checksum = "frame_checksum", *grain_checksum = "grain_checksum";

inline constexpr const char *frame_checksum_about = "XXH64 of the frame's own numbers",
                            *grain_checksum_about = "XXH64 of the numbers of the frame's grains",
                            *checksum_comment = "two words of 32 bits, the high one first; for grainreel";

// The beginning of both checksums of a frame. It depends on the frame's number and on what the file holds, so
// that a frame in the wrong place is noticed.
inline Checksum begin_checksum(std::size_t frame, std::size_t places, const std::vector<std::string>& species,
                               bool orientation) {
    Checksum sum;
    const std::array<std::uint64_t, 3> numbers{frame, places, orientation ? 1u : 0u};
    const std::string names = fmt::format("{}", fmt::join(species, "\n"));
    sum.add(numbers.data(), numbers.size());
    sum.add(names.data(), names.size());
    return sum;
}

// Defines the variables for meshes, all of which have triangles; the file is in define mode. spatial,
// checksum: numbers of the file's dimensions.
void define_meshes(NetcdfFile& file, const std::vector<TrajectoryMesh>& meshes, int spatial, int checksum);
void write_meshes(NetcdfFile& file, const std::vector<TrajectoryMesh>& meshes);

// The meshes of the file at `path`; none where it has none. bodies: number of bodies, including container and
// floor. Throws UserError when the meshes are damaged.
std::vector<TrajectoryMesh> read_meshes(const NetcdfFile& file, const std::filesystem::path& path,
                                        std::size_t bodies);

// Whether shapes and bodies are the same bit by bit.
bool same_meshes(const std::vector<TrajectoryMesh>& a, const std::vector<TrajectoryMesh>& b);

}  // namespace grainreel
