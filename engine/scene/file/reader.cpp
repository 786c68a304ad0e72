#include "engine/scene/file/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/table_reader.hpp"
#include "engine/scene/drive/shorten.hpp"
#include "engine/scene/file/scene_file.hpp"
#include "engine/scene/shipped/shipped_scenes.hpp"

namespace grainreel {
namespace {

// It is the film's title and its folder's name when the scene has no other.
void check_name(const std::filesystem::path& file) {
    const std::string wrong = complaint_of_utf8(file.filename().string());
    if (!wrong.empty()) throw UserError(fmt::format("{}; rename the file", wrong));
    if (const auto control = first_control_character(file.filename().string()))
        throw UserError(fmt::format("{}: the file's name holds the control character U+{:04X}; rename it",
                                    file.string(), *control));
}

void check_instruments(const Document& document, const Scene& scene) {
    const std::vector<std::string>& known = scene.measurable.instruments;
    for (const std::string& name : scene.output.instruments)
        if (std::find(known.begin(), known.end(), name) == known.end())
            document.fail("output.instruments",
                          fmt::format("names \"{}\", which is no instrument; there is {}", excerpt(name),
                                      fmt::join(known, ", ")));
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const Assignments& sets, const MeasurableIn& measurable) {
    Scene scene;
    read_scene_into(scene, text_of_scene(file), sets, measurable);
    return scene;
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file, const Assignments& sets,
                      const MeasurableIn& measurable) {
    Scene scene;
    read_scene_into(scene, {std::string(text), file}, sets, measurable);
    return scene;
}

NamedText text_of_scene(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!file.has_parent_path() && !std::filesystem::exists(file, ignored))
        if (const ShippedScene* shipped = shipped_scene(file.string()))
            return {std::string(shipped->text), shipped->name + ".toml"};
    return {load_scene_file(file, Pipes::taken), file};
}

void read_scene_into(Scene& scene, const NamedText& from, const Assignments& sets,
                     const MeasurableIn& measurable, TableReader* further) {
    check_name(from.file);
    Document document(from.text, from.file.string(), further != nullptr ? further->keys() : scene_keys());
    for (const Assignment& assignment : sets) document.set(assignment);
    if (further == nullptr) scene.film_text = document.take_out("film");
    document.check_keys();

    scene.name = from.file.stem().string();
    scene.file = from.file.string();
    scene.written = document.written();
    read_top_level(document, scene);
    read_species(document, scene, further);
    read_meshes(document, scene);
    read_contact(document, scene);
    read_container(document, scene);
    read_walls(document, scene);
    read_exits(document, scene);
    read_feeds(document, scene);
    read_grains(document, scene);
    read_drive(document, scene);
    read_start(document, scene);
    read_run(document, scene);
    shorten(document, scene);
    count_fed(document, scene);
    read_fields(document, scene);
    if (measurable) scene.measurable = measurable(scene);
    check_instruments(document, scene);
    if (further != nullptr) further->read_tables(document);
    measure_meshes(scene);
    size_empty_space(scene);
    document.check_all_read();
    check_scene(scene);
    for (std::string& doubt : doubts_of_meshes(scene)) scene.notes.push_back(std::move(doubt));
    if (further != nullptr) further->check();
}

}  // namespace grainreel
