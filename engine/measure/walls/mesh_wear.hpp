// Pressure and wear on the triangles of meshes, as in fields.nc and as films show them.
#pragma once

#include <string>
#include <vector>

#include "engine/measure/measures.hpp"

namespace grainreel {

struct Scene;  // engine/scene/scene.hpp

// Pressure and wear of one mesh, with a number for each triangle.
struct MeshWear {
    // Pa, normal force divided by area. It is a mean over the present record of fields.nc, from its beginning
    // until now. NaN if it is not known.
    std::vector<double> pressure;
    std::vector<double> wear;  // J/m2, work of rubbing divided by area, since the drive started
};
// Names of the two fields of a mesh in fields.nc. `name` is the mesh's name as face_names() gives it.
std::string pressure_field(const std::string& name);
std::string wear_field(const std::string& name);

// Finds the pressure and the wear of each mesh among the fields of all observers. `sets` says which fields
// each observer has, and `values` has their values in the same order. Without the instrument `wear`, the two
// vectors of each MeshWear are empty.
std::vector<MeshWear> wear_among(const Scene& scene, const std::vector<const FieldSet*>& sets,
                                 const std::vector<FieldValues>& values);

}  // namespace grainreel
