// Pressure and wear on the triangles of meshes, as in fields.nc and as films show them.
#pragma once

#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Pressure and wear of one mesh, with a number for each triangle.
struct MeshWear {
    std::vector<double>
        pressure;  // Pa, mean normal force divided by area, since the last record began; NaN if not known
    std::vector<double> wear;  // J/m2, work of rubbing divided by area, since the drive started
};
// The names of its fields. `name` is the name of the mesh as in face_names().
std::string pressure_field(const std::string& name);
std::string wear_field(const std::string& name);

// Picks the wear of each mesh from the fields of all observers. The vectors are empty if the instrument
// `wear` is not among them.
std::vector<MeshWear> wear_among(const Scene& scene, const std::vector<const FieldSet*>& sets,
                                 const std::vector<FieldValues>& values);

}  // namespace grainreel
