#include "engine/scene/text/reader.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/utf8.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/text/scene_file.hpp"

namespace grainreel {
namespace {

// It is the film's title and its folder's name when the scene has no other.
void check_name(const std::filesystem::path& file) {
    const std::string wrong = complaint_of_utf8(file.filename().string());
    if (!wrong.empty()) throw UserError(fmt::format("{}; rename the file", wrong));
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const Assignments& sets) {
    return read_scene_text(load_scene_file(file), file, sets);
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file, const Assignments& sets) {
    check_name(file);
    Document document(text, file.string());
    for (const Assignment& assignment : sets) document.set(assignment);
    document.check_keys();

    Scene scene;
    scene.name = file.stem().string();
    scene.file = file.string();
    scene.written = document.written();
    read_top_level(document, scene);
    read_species(document, scene);
    read_contact(document, scene);
    read_container(document, scene);
    read_walls(document, scene);
    read_feeds(document, scene);
    read_grains(document, scene);
    read_drive(document, scene);
    read_start(document, scene);
    read_run(document, scene);
    count_fed(document, scene);
    read_film(document, scene);
    size_empty_space(scene);
    document.check_all_read();
    check_scene(scene);
    return scene;
}

}  // namespace grainreel
