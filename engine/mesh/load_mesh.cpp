#include "engine/mesh/load_mesh.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>

#include "engine/mesh/file/mesh_bytes.hpp"
#include "engine/mesh/file/mesh_readers.hpp"
#include "engine/mesh/file/words.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

std::string hash_of(std::string_view bytes) {
    return fmt::format("{:016x}", XXH64(bytes.data(), bytes.size(), 0));
}

void place(TriangleMesh& mesh, const MeshPlacement& placement, const fs::path& file) {
    const Eigen::Matrix3d turn = placement.rotation.toRotationMatrix();
    const bool turned = !turn.isIdentity(0);
    for (Vec3& vertex : mesh.vertices) {
        vertex *= placement.scale;
        if (turned) vertex = turn * vertex;
        vertex += placement.position;
        if (!(vertex.cwiseAbs().maxCoeff() <= largest_coordinate))
            refuse_mesh(
                file,
                fmt::format("a corner would stand {:g} m from the origin; give another scale or position",
                            vertex.norm()));
    }
}

}  // namespace

LoadedMesh load_mesh(const fs::path& file, const MeshPlacement& placement) {
    const std::string bytes = mesh_bytes(file);
    const MeshFormat format = format_of(file, bytes);
    LoadedMesh loaded;
    loaded.hash = hash_of(bytes);
    loaded.facts.format = name_of(format);
    loaded.mesh = read_mesh(format, file, bytes);
    loaded.facts.read = static_cast<std::int64_t>(loaded.mesh.triangles.size());
    if (loaded.mesh.empty()) refuse_mesh(file, fmt::format("this {} has no triangles", loaded.facts.format));
    place(loaded.mesh, placement, file);
    mend(loaded.mesh, loaded.facts);
    if (loaded.mesh.empty()) refuse_mesh(file, "all triangles of this mesh are without area");
    return loaded;
}

std::string hash_of_file(const fs::path& file) {
    return hash_of(mesh_bytes(file));
}

}  // namespace grainreel
