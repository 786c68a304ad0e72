// The files of a study: its own, its scene, and tables of points from elsewhere. They lie on disk, or, of a
// study that comes with the program, in the program.
#pragma once

#include <filesystem>
#include <string>

#include "engine/scene/scene_file.hpp"
#include "render/app/study/study.hpp"

namespace grainreel {

// Reads the study's text. Where there is no such file, a name or words of it find a shipped study, as they
// find shipped scenes. Throws UserError.
void read_study_text(const std::filesystem::path& file, Study& study);

// The scene or table that the study names. Its path counts from the study's folder. Its text is empty, and so
// is its path, where there is none. Throws UserError for a file that cannot be read.
NamedText file_of_study(const Study& study, const std::string& name);

}  // namespace grainreel
