// The parts of a study file, in the order in which they are read. Internal to read_study. Each throws
// UserError with the place of the mistake.
#pragma once

#include <string>

#include "engine/scene/keys/document.hpp"
#include "render/app/study/study.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The seeds at that path, so many or a list; none where it is absent.
Seeds read_seeds(Document& document, const std::string& path);
// All [[variant]] become the first variation. To be read before the others.
void read_variants(Document& document, Study& study);
// One element of a list of tables, "vary[0]"; it is added to the study.
void read_variation(Document& document, const std::string& table, Study& study);
// scene: of the variant that runs longest; the species, and so the columns, are those of all members.
void read_measure(Document& document, const FilmedScene& scene, const std::string& table, Study& study);
void read_chart(Document& document, const std::string& table, Study& study);
// One for each measure, where the file asks for none.
void add_usual_charts(Study& study);

// A path that counts from the study's folder.
inline std::filesystem::path beside_study(const Study& study, const std::string& path) {
    return (study.file.parent_path() / path).lexically_normal();
}

}  // namespace grainreel
