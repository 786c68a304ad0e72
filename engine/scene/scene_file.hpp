// The scene file: loading its text, reading it into a Scene, writing a Scene back, and the names of the files
// that a run keeps beside it. What a single key means is said in engine/scene/chapters and not here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Bytes: a hundred thousand grains listed one by one, and far more than any scene written by hand.
constexpr std::size_t largest_scene_file = 16u << 20;

// What may stand for a file. A pipe can be read once, and is waited for until something comes through it.
enum class Pipes { refused, taken };

// Throws UserError when there is no such file, when it is something else (a folder, a device that has no end,
// a pipe unless it is taken), when it is larger than that, or when it cannot be read; and when a signal comes
// while a pipe is waited for.
std::string load_scene_file(const std::filesystem::path& file, Pipes pipes = Pipes::refused);

// From a scene file to a Scene.

class TableReader;

// Reads a TOML file, or the shipped scene of that name where there is no such file. `sets` take precedence
// over it, "run.duration=2 s" or "species.big.count=30"; their values are TOML, or else taken as text. A
// relative start.file becomes absolute, counted from the scene's folder, and so do the files of meshes and
// paths, which are loaded. Throws UserError at the first mistake: an unknown or useless key, a value of the
// wrong kind, unit or size, or values that do not go together. measurable: what output.instruments may name
// (measurable_in() of engine/measure/columns.hpp); without it they may name nothing. [film], which must be a
// table, and the colours of species are kept as text and are not checked.
Scene read_scene(const std::filesystem::path& file, const Assignments& sets = {},
                 const MeasurableIn& measurable = nullptr);

// Reads a scene from text. `file` is its name in messages, and relative paths count from the folder of
// `file`.
Scene read_scene_text(std::string_view text, const std::filesystem::path& file, const Assignments& sets = {},
                      const MeasurableIn& measurable = nullptr);

// The text of a scene, and the name of its file for messages.
struct NamedText {
    std::string text;
    std::filesystem::path file;
};
// The text of a file, or of the shipped scene of that name. Throws UserError where there is neither.
NamedText text_of_scene(const std::filesystem::path& file);

// Reads a scene, and lets `further` read what the engine does not know (render/scene/read_scene.hpp).
void read_scene_into(Scene& scene, const NamedText& from, const Assignments& sets,
                     const MeasurableIn& measurable, TableReader* further = nullptr);

// Reasons for the values that the plan filled in. A reason is empty where the scene itself gives the value.
struct Reasons {
    std::string step;
    // Why a stiffness was filled in, or the modulus with Hertz. By kind of contact as in Contact; `glued`:
    // for contacts with grains glued to walls. Without an entry where nothing was filled in.
    std::vector<std::string> grain, wall, mesh, glued;
};

// From a Scene back to a scene file: scene.toml in the run's folder.

// Every value as resolved, in SI. read_scene gives the same Scene back, bit by bit. Values that have a reason
// get it as a comment.
std::string written_scene(const Scene& scene, const Reasons& reasons = {});

// The files of meshes and paths as a run keeps them, in the folder `meshes` of its own folder.

inline constexpr const char* kMeshFolder = "meshes";

struct KeptFile {
    std::string from, hash;  // path, and what is in it
    std::string name;        // "meshes/drum.stl", relative to the run's folder
};

// Each file once. Names are those of the files, with a number where two differ in nothing else. What the
// program ships is not kept.
std::vector<KeptFile> kept_files(const Scene& scene);

// The scene as it is written into its run's folder: it names the kept files. So do the scenes in checkpoints,
// and therefore a run's folder can be copied elsewhere.
Scene naming_kept_files(Scene scene);

}  // namespace grainreel
