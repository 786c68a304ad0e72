// The shapes of meshes in a trajectory's file: once, at rest. The names of variables and dimensions are in
// trajectory_layout.hpp.
#pragma once

#include <string>
#include <vector>

#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/files/trajectory.hpp"

namespace grainreel {

// In define mode, of meshes that have triangles. spatial, checksum: the numbers of the file's dimensions.
void define_meshes(NetcdfFile& file, const std::vector<TrajectoryMesh>& meshes, int spatial, int checksum);
void write_meshes(NetcdfFile& file, const std::vector<TrajectoryMesh>& meshes);

// None of a file without meshes. path: the file's; bodies: how many it has, container and floor counted.
// Throws UserError when they are damaged.
std::vector<TrajectoryMesh> read_meshes(const NetcdfFile& file, const std::filesystem::path& path,
                                        std::size_t bodies);

// Whether shapes and bodies are the same, bit by bit.
bool same_meshes(const std::vector<TrajectoryMesh>& a, const std::vector<TrajectoryMesh>& b);

}  // namespace grainreel
