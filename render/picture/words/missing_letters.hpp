// Finds letters that no font on this machine has. In a picture, boxes stand in place of such letters.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The missing letters of a script, each once, in the order of the text.
struct MissingLetters {
    std::string letters;
    std::string script;   // "Chinese", "Devanagari"
    std::string package;  // Debian's package with a font for them
};
std::vector<MissingLetters> missing_letters(const std::string& text);

// The warning about missing letters, "scene.toml:1:1: no font here has ..."; empty when none is missing.
// texts: pairs of a place and the text that stands there. The warning names the first place where letters are
// missing.
std::string missing_letters_warning(const std::vector<std::pair<std::string, std::string>>& texts);

// The texts of a scene that its film shows, each with the place where it is written.
std::vector<std::pair<std::string, std::string>> texts_of_film(const FilmedScene& scene);

// A sample of each script that the verb doctor checks.
struct ScriptSample {
    const char* name;
    const char* letters;
};
const std::vector<ScriptSample>& script_samples();

}  // namespace grainreel
