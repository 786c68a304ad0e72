// The files that a scene names for its meshes: where they lie, and what they hold. Internal to [[mesh]].
#pragma once

#include <memory>
#include <string>

#include "engine/scene/keys/document.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The most letters of a path, as Linux has it.
inline constexpr std::size_t kLongestPath = 4096;

// The file that a key names, absolute. A relative one counts from the scene's folder. A checkpoint's scene
// counts from the folder of its run, which is that of the checkpoint or one of the two above it. What the
// program ships ("shipped:drum.stl") has no folder. Throws UserError where the name is not UTF-8, or names no
// file.
std::string named_file(Document& document, const Scene& scene, const std::string& path);

// The surface of a mesh whose file and placement are read, and the hash of its file. Surfaces that are alike
// are one, and the last few stay in memory, since a scene may be read several times in a row. Throws
// UserError at the key `file` where the file cannot be used, or is not the one that mesh.hash says.
void load_surface(const Document& document, const std::string& table, SceneMesh& mesh);

// Loads the path of a mesh in the same way. Throws UserError at the key `path`.
void load_path(const Document& document, const std::string& table, SceneMesh& mesh);

// The room that a surface encloses. The last one stays in memory.
std::shared_ptr<const EnclosedRoom> room_of(const std::shared_ptr<const Surface>& surface);

}  // namespace grainreel
