// Pressure and wear on the triangles of meshes, as fields.nc has them and as films show them.
#pragma once

#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// As it is drawn, and as fields.nc has it: a number for each triangle of one mesh.
struct MeshWear {
    std::vector<double>
        pressure;              // Pa, mean normal force over area since the last record began; NaN: not known
    std::vector<double> wear;  // J/m2, work of rubbing over area since the drive started
};
// The names of its fields. name: of the mesh, as face_names() has it.
std::string pressure_field(const std::string& name);
std::string wear_field(const std::string& name);

// Picks the wear of each mesh from what all observers give on grids. The vectors are empty where the
// instrument `wear` is not among them.
std::vector<MeshWear> wear_among(const Scene& scene, const std::vector<const FieldSet*>& sets,
                                 const std::vector<FieldValues>& values);

}  // namespace grainreel
