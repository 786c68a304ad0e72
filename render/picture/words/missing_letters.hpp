// Letters that no font on this machine has: words on a picture have boxes in their place.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Each once, in the order of the text; letters of one script that follow each other are one piece.
struct MissingLetters {
    std::string letters;
    std::string script;   // "Chinese", "Devanagari"
    std::string package;  // of Debian, that has a font for them
};
std::vector<MissingLetters> missing_letters(const std::string& text);

// What is said of the letters that texts lack: "no font here has ..., so the film has boxes in their place".
// Empty when none is missing. texts: what to call the place of each ("scene.toml:1:1"; the first that lacks
// letters is named), and the text.
std::string missing_letters_warning(const std::vector<std::pair<std::string, std::string>>& texts);

// Texts of a scene that its film shows, each with the place where it is written.
std::vector<std::pair<std::string, std::string>> texts_of_film(const FilmedScene& scene);

// A sample of each script that doctor asks for.
struct ScriptSample {
    const char* name;
    const char* letters;
};
const std::vector<ScriptSample>& script_samples();

}  // namespace grainreel
