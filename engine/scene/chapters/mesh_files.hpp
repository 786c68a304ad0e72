// The files that a scene names for its meshes: where they lie, and what they hold. Internal to [[mesh]].
#pragma once

#include <memory>
#include <string>

#include "engine/scene/keys/document.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The largest number of characters of a path, as on Linux.
inline constexpr std::size_t kLongestPath = 4096;

// The file that a key names, as an absolute path. A relative path counts from the scene's folder. For a
// checkpoint's scene it counts from the folder of its run, which is that of the checkpoint or one of the
// two above it. A file that the program ships ("shipped:drum.stl") has no folder. Throws UserError where
// the name is not UTF-8, or where there is no such file.
std::string named_file(Document& document, const Scene& scene, const std::string& path);

// Loads the surface of a mesh whose file and placement have been read, and the hash of its file. Equal
// surfaces are kept once, and the last few stay in memory, since a scene may be read several times in a
// row. Throws UserError at the key `file` where the file cannot be used, or where its hash is not
// mesh.hash.
void load_surface(const Document& document, const std::string& table, SceneMesh& mesh);

// Loads the path of a mesh in the same way. Throws UserError at the key `path`.
void load_path(const Document& document, const std::string& table, SceneMesh& mesh);

// The room that a surface encloses. The last one stays in memory.
std::shared_ptr<const EnclosedRoom> room_of(const std::shared_ptr<const Surface>& surface);

}  // namespace grainreel
