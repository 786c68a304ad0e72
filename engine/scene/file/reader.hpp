// From a scene file to a Scene.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class TableReader;

// Reads a TOML file, or the shipped scene of that name where there is no such file. `sets` take precedence
// over it, "run.duration=2 s" or "species.big.count=30"; their values are TOML, or else taken as text. A
// relative start.file becomes absolute, counted from the scene's folder, and so do the files of meshes and
// paths, which are loaded. Throws UserError at the first
// mistake: keys that are unknown or of no use, values of the wrong kind, unit or size, and what does not go
// together. measurable: what output.instruments may name (measurable_in() of engine/measure/columns.hpp);
// without it, nothing. [film], which must be a table, and the species' colours are kept as text,
// whatever they say.
Scene read_scene(const std::filesystem::path& file, const Assignments& sets = {},
                 const MeasurableIn& measurable = nullptr);

// Likewise from text; `file` is the name for messages, and its folder the one that paths count from.
Scene read_scene_text(std::string_view text, const std::filesystem::path& file, const Assignments& sets = {},
                      const MeasurableIn& measurable = nullptr);

// The text of a scene, and the name of its file for messages.
struct NamedText {
    std::string text;
    std::filesystem::path file;
};
// The text of a file, or of the shipped scene of that name. Throws UserError where there is neither.
NamedText text_of_scene(const std::filesystem::path& file);

// Likewise, and `further` reads what the engine does not know (render/scene/read_scene.hpp).
void read_scene_into(Scene& scene, const NamedText& from, const Assignments& sets,
                     const MeasurableIn& measurable, TableReader* further = nullptr);

}  // namespace grainreel
