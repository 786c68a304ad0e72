// What panels have in common, and the words that tell them apart.
#include "render/picture/panels/panels.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/plan/reach.hpp"
#include "render/picture/marks/marks.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

bool same_species(const Species& a, const Species& b) {
    return a.name == b.name && a.count == b.count && a.diameter == b.diameter;
}

bool close(double a, double b) {
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool same_wall_colours(const FilmWalls& a, const FilmWalls& b) {
    return a.colour == b.colour && (!a.coloured() || a.range == b.range);
}

bool same_clock(const Drive& a, const Drive& b) {
    return close(a.frequency, b.frequency) && a.phase == b.phase && a.ramp == b.ramp && a.stages == b.stages;
}

double g_level(const FilmedScene& scene) {
    return scene.drive.present ? scene.drive.g_level(scene.gravity.norm()) : 0;
}

bool all_alike(const std::vector<std::string>& words) {
    return std::all_of(words.begin(), words.end(), [&](const std::string& w) { return w == words.front(); });
}

std::vector<std::string> drive_captions(const std::vector<FilmedScene>& scenes) {
    const FilmedScene& first = scenes.front();
    bool frequency = false, level = false, amplitude = false;
    for (const FilmedScene& scene : scenes) {
        frequency |= scene.drive.stages != first.drive.stages;
        frequency |= !close(scene.drive.frequency, first.drive.frequency);
        level |= std::isfinite(g_level(scene)) && !close(g_level(scene), g_level(first));
        amplitude |= !close(scene.drive.amplitude, first.drive.amplitude);
    }
    std::vector<std::string> captions;
    for (const FilmedScene& scene : scenes) {
        const Wording& say = scene.film.wording;
        std::vector<std::string> parts;
        if (frequency && scene.drive.changes()) parts.push_back(say(Word::changing_drive));
        if (frequency) parts.push_back("f = " + frequency_text(scene.drive.frequency));
        if (level) parts.push_back(fmt::format("Γ = {:.3g}", g_level(scene)));
        if (amplitude && !level && !frequency) parts.push_back("a = " + length_text(scene.drive.amplitude));
        captions.push_back(scene.drive.present ? fmt::format("{}", fmt::join(parts, ", "))
                                               : say(Word::no_vibration));
    }
    return captions;
}

}  // namespace

FilmedScene marked_by(FilmedScene scene, const MarkKinds& kinds) {
    FilmShows& shows = scene.film.shows;
    if (!kinds.arrows) shows.arrows = {};
    if (!kinds.streamlines) shows.streamlines = {};
    if (!kinds.wall_forces) shows.wall_forces = {};
    if (!kinds.trails) shows.trails = {};
    if (!kinds.chains) shows.force_chains = false;
    if (!kinds.rings) shows.highlighted = {}, shows.highlight_if = {};
    return scene;
}

Common common_of(const std::vector<Panel>& panels) {
    Common common;
    const FilmedScene& first = panels.front().scene;
    for (const Panel& panel : panels) {
        const FilmedScene& scene = panel.scene;
        const bool driven = scene.drive.present && first.drive.present;
        common.clock = common.clock && driven && same_clock(scene.drive, first.drive);
        const bool same_stages = driven && scene.drive.stages == first.drive.stages;
        common.frequency =
            common.frequency && same_stages && close(scene.drive.frequency, first.drive.frequency);
        common.g_level = common.g_level && same_stages && std::isfinite(g_level(scene)) &&
                         close(g_level(scene), g_level(first));
        common.amplitude =
            common.amplitude && same_stages && close(scene.drive.amplitude, first.drive.amplitude);
        common.colours = common.colours && scene.film.shows.colour == first.film.shows.colour &&
                         same_wall_colours(scene.film.look.walls, first.film.look.walls);
        const FilmShows &x = scene.film.shows, &y = first.film.shows;
        common.marks.arrows = common.marks.arrows && x.arrows == y.arrows &&
                              (x.arrows.across == 0 || close(arrow_scale(scene), arrow_scale(first)));
        common.marks.streamlines = common.marks.streamlines && x.streamlines == y.streamlines;
        common.marks.wall_forces =
            common.marks.wall_forces && x.wall_forces == y.wall_forces &&
            (!x.wall_forces.wanted || close(wall_force_scale(scene), wall_force_scale(first)));
        common.marks.trails = common.marks.trails && x.trails == y.trails;
        common.marks.chains = common.marks.chains && x.force_chains == y.force_chains &&
                              (!x.force_chains || close(widest_force(scene), widest_force(first)));
        common.marks.rings =
            common.marks.rings && x.highlighted == y.highlighted && x.highlight_if == y.highlight_if;
        common.playback = common.playback && panel.playback == panels.front().playback;
        common.captions = common.captions && !scene.film.captions.empty() &&
                          !has_values(scene.film.captions) &&
                          scene.film.captions == first.film.captions;  // each panel tells its own values
        common.exaggerated = common.exaggerated && scene.film.exaggerate == first.film.exaggerate;
        common.species = common.species && scene.colours == first.colours &&
                         std::equal(scene.species.begin(), scene.species.end(), first.species.begin(),
                                    first.species.end(), same_species);
    }
    return common;
}

std::vector<Panel> without_common(std::vector<Panel> panels, const Common& common) {
    if (common.captions)
        for (Panel& panel : panels) panel.scene.film.captions.clear();
    return panels;
}

namespace {

void share_grain_colours(std::vector<Panel>& panels) {
    const auto colour = [](Panel& panel) -> GrainColouring& { return panel.scene.film.shows.colour; };
    GrainColouring common = colour(panels.front());
    for (Panel& panel : panels) {
        const GrainColouring& own = colour(panel);
        if (own.fixed || own.by != common.by || own.map != common.map || own.layers != common.layers) return;
        if (own.range[1] - own.range[0] > common.range[1] - common.range[0]) common.unit = own.unit;
        common.range = {std::min(common.range[0], own.range[0]), std::max(common.range[1], own.range[1])};
    }
    for (Panel& panel : panels) colour(panel) = common;
}

void share_wall_colours(std::vector<Panel>& panels) {
    const auto walls = [](Panel& panel) -> FilmWalls& { return panel.scene.film.look.walls; };
    std::array<double, 2> range = walls(panels.front()).range;
    for (Panel& panel : panels) {
        const FilmWalls& own = walls(panel);
        if (own.fixed || !own.coloured() || own.colour != walls(panels.front()).colour) return;
        range = {std::min(range[0], own.range[0]), std::max(range[1], own.range[1])};
    }
    for (Panel& panel : panels) walls(panel).range = range;
}

}  // namespace

void share_colours(std::vector<Panel>& panels) {
    share_grain_colours(panels);
    share_wall_colours(panels);
}

void share_reach(std::vector<Panel>& panels) {
    std::optional<double> highest;
    for (const Panel& panel : panels) {
        const Camera& camera = panel.scene.film.camera;
        if (camera.frame != FramingScope::reach) return;
        const std::optional<double> reach = camera.reach ? camera.reach : estimated_reach(panel.scene);
        if (!reach) return;
        highest = std::max(highest.value_or(*reach), *reach);
    }
    for (Panel& panel : panels) panel.scene.film.camera.reach = highest;
}

std::vector<std::string> captions_of(const std::vector<FilmedScene>& scenes) {
    std::vector<std::string> titles, names;
    for (const FilmedScene& scene : scenes) {
        titles.push_back(scene.film.title.empty() ? scene.title : scene.film.title);
        names.push_back(scene.name);
    }
    const auto differ = [](const std::vector<std::string>& words) {
        return std::set<std::string>(words.begin(), words.end()).size() == words.size();
    };
    const std::vector<std::string> drives = drive_captions(scenes);
    if (all_alike(titles) && differ(drives)) return drives;
    std::vector<std::string> both = titles;
    for (std::size_t i = 0; i < both.size() && !all_alike(drives); ++i)
        if (both[i].find(drives[i]) == std::string::npos) both[i] += "\n" + drives[i];
    if (differ(both)) return both;
    if (differ(names)) return names;
    for (std::size_t i = 0; i < both.size(); ++i) both[i] = fmt::format("{}, {}", i + 1, names[i]);
    return both;
}

}  // namespace grainreel
