#include "engine/scene/file/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/utf8.hpp"
#include "engine/scene/chapters/chapters.hpp"
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

// What the film shows is measured.
void take_instruments_of_film(Scene& scene) {
    std::vector<std::string>& taken = scene.output.instruments;
    const auto take_instrument = [&](const std::string& name) {
        if (std::find(taken.begin(), taken.end(), name) == taken.end()) taken.push_back(name);
    };
    const auto take = [&](const std::string& name) {
        for (const MeasureColumn& column : scene.measurable.columns)
            if (column.name == name && !column.instrument.empty()) take_instrument(column.instrument);
    };
    if (scene.film.shows.wall_forces.wanted) take_instrument("walls");
    for (const FilmPlot& plot : scene.film.shows.plots) take(plot.column);
    for (const LiveWords& words : scene.film.shows.live_words) take(words.column);
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const Assignments& sets, const MeasurableIn& measurable) {
    std::error_code ignored;
    if (!file.has_parent_path() && !std::filesystem::exists(file, ignored))
        if (const ShippedScene* shipped = shipped_scene(file.string()))
            return read_scene_text(shipped->text, shipped->name + ".toml", sets, measurable);
    return read_scene_text(load_scene_file(file, Pipes::taken), file, sets, measurable);
}

Scene read_scene_text(std::string_view text, const std::filesystem::path& file, const Assignments& sets,
                      const MeasurableIn& measurable) {
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
    shorten(document, scene);
    count_fed(document, scene);
    read_fields(document, scene);
    if (measurable) scene.measurable = measurable(scene);
    check_instruments(document, scene);
    read_film(document, scene);
    take_instruments_of_film(scene);
    size_empty_space(scene);
    document.check_all_read();
    check_scene(scene);
    return scene;
}

}  // namespace grainreel
