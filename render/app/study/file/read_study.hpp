// Reads a study file. Here are also the keys that such a file may have, and the functions that read its
// parts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/app/study/study.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Throws UserError at the first mistake, "file:line:column: ...": a key that is unknown here or in the scene,
// a column that no run would have, a range without values. The values of the scene's keys are checked when
// members are made of them (members.hpp).
Study read_study(const std::filesystem::path& file);

// Gives the keys of a study file with their meanings, which docs/reference/studies.md lists.
const std::vector<Key>& study_keys();

// From here on: functions that read the parts of a study file. Only read_study() calls them, in this order.
// variations.cpp has those of seeds, variants and variations, and read_measures.cpp has the others. Each
// throws UserError with the place of the mistake.

// Reads the seeds at that path, given as a number of seeds or a list; none when the key is absent.
Seeds read_seeds(Document& document, const std::string& path);
// Makes all [[variant]] the first variation. To be called before the others are read.
void read_variants(Document& document, Study& study);
// Reads one element of a list of tables, "vary[0]", and adds it to the study.
void read_variation(Document& document, const std::string& table, Study& study);
// scene: the scene of the variant that runs longest. All members have the same species, so they have the same
// columns.
void read_measure(Document& document, const FilmedScene& scene, const std::string& table, Study& study);
void read_chart(Document& document, const std::string& table, Study& study);
// Adds a chart for each measure when the file asks for none.
void add_usual_charts(Study& study);

// The path of a file that is given relative to the study's folder.
inline std::filesystem::path beside_study(const Study& study, const std::string& path) {
    return (study.file.parent_path() / path).lexically_normal();
}

}  // namespace grainreel
