// STL, OBJ and PLY: read, mended, and prepared for questions as a wall of a scene is.
#include "engine/base/error.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/surface.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace grainreel::fuzz {

namespace {

void attempt_mesh(std::string_view bytes) {
    const std::filesystem::path file = scratch().write("input", bytes);
    try {
        LoadedMesh loaded = load_mesh(file);
        const Surface surface(std::move(loaded.mesh), loaded.facts, loaded.hash);
        surface.size();
    } catch (const UserError&) {
    }
}

}  // namespace

Target mesh_target() {
    return {"mesh", "STL, OBJ and PLY", attempt_mesh};
}

}  // namespace grainreel::fuzz
