// The scene file: loading its text, reading it into a Scene, writing a Scene back, and the names of the
// files that a run keeps beside it. engine/scene/chapters says what each single key means.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// In bytes: enough for a hundred thousand grains listed one by one, far more than a scene written by hand
// has.
constexpr std::size_t largest_scene_file = 16u << 20;

// Whether a pipe may stand for a file. A pipe can be read once, and the program waits until something comes
// through.
enum class Pipes { refused, taken };

// Reads the text of a scene file. Throws UserError when there is no such file, when it is something else (a
// folder, a device that has no end, a pipe where these are refused), when it is larger than
// largest_scene_file or cannot be read, and when a signal comes while the program waits for a pipe.
std::string load_scene_file(const std::filesystem::path& file, Pipes pipes = Pipes::refused);

class TableReader;

// Reads a TOML file, or the shipped scene of that name where there is no such file. `sets` take precedence
// over it: "run.duration=2 s" or "species.big.count=30"; their values are TOML, or else taken as text. A
// relative start.file becomes absolute, counted from the scene's folder, and so do the files of meshes and
// paths, which are loaded.
//
// Throws UserError at the first mistake: an unknown or useless key, a value of the wrong kind, unit or size,
// or values that do not go together. `measurable` gives what output.instruments may name (measurable_in() of
// engine/measure/columns.hpp); without it they may name nothing. [film], which must be a table, and the
// colours of species are kept as text without a check.
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

// Reads a scene, and lets `further` read the tables that the engine does not know
// (render/scene/filmed_scene.hpp).
void read_scene_into(Scene& scene, const NamedText& from, const Assignments& sets,
                     const MeasurableIn& measurable, TableReader* further = nullptr);

// Reasons for the values that the plan filled in. A reason is empty where the scene itself gives the value.
struct Reasons {
    std::string step;
    // Why a stiffness (with Hertz, the modulus) was filled in, by kind of contact as in Contact. `glued` is
    // for contacts with grains glued to walls. There is no entry where nothing was filled in.
    std::vector<std::string> grain, wall, mesh, glued;
};

// Writes a Scene as the text of a scene file, such as scene.toml in the run's folder, with every value as
// resolved, in SI. read_scene gives the same Scene back, bit by bit. A value with a reason gets it as a
// comment.
std::string written_scene(const Scene& scene, const Reasons& reasons = {});

// The files of meshes and paths as a run keeps them, in the folder `meshes` of its own folder.

inline constexpr const char* kMeshFolder = "meshes";

struct KeptFile {
    std::string from, hash;  // path of the file, and hash of its content
    std::string name;        // "meshes/drum.stl", relative to the run's folder
};

// Lists each file once. A file keeps its name, with a number if another file has the same name. Files that
// the program ships are not kept.
std::vector<KeptFile> kept_files(const Scene& scene);

// The scene as it is written into its run's folder, with the names of the kept files. Scenes in checkpoints
// use these names too, so a run's folder can be copied elsewhere.
Scene naming_kept_files(Scene scene);

}  // namespace grainreel
