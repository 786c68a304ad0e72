#include "render/film/compare/comparison.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/compare/comparison_words.hpp"
#include "render/film/compare/vary.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

std::vector<FilmedScene> scenes_of(const Comparison& all) {
    std::vector<FilmedScene> scenes;
    for (const auto& member : all.members) scenes.push_back(member->scene());
    return scenes;
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == '|') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

// What a scene's captions say was written for its own value of the key. Those of the command line are for
// all.
void leave_out_captions(const CompareRequest& what, Comparison& all) {
    if (!what.vary) return;
    const std::vector<Assignment> values = read_vary(*what.vary);
    const bool given = std::any_of(what.sets.begin(), what.sets.end(), [](const Assignment& set) {
        return set.key().rfind("film.caption", 0) == 0;
    });
    if (given || !changes_the_scene(values.front()) || all.film.film.captions.empty()) return;
    all.film.film.captions.clear();
    for (Panel& panel : all.panels) panel.scene.film.captions.clear();
    all.warnings.push_back(
        fmt::format("film.caption: the scene's captions were written for one value of {} and are left out; "
                    "--set film.caption=[...] gives the comparison its own",
                    values.front().key()));
}

void make_panels(const CompareRequest& what, Comparison& all) {
    const std::vector<FilmedScene> scenes = scenes_of(all);
    std::vector<std::string> captions = all.labels.empty() ? captions_of(scenes) : all.labels;
    if (what.captions) captions = split(*what.captions);
    for (const std::string& caption : captions)
        if (letters_in(caption) > kMostLetters)
            throw UserError(fmt::format("--captions: one has {} characters, and the most are {}; shorten it",
                                        letters_in(caption), kMostLetters));
    if (captions.size() != scenes.size())
        throw UserError(
            fmt::format("--captions: has {} parts between its bars for {} panels; write one for each, "
                        "as in \"Γ = 1|Γ = 3\"",
                        captions.size(), scenes.size()));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        all.panels.push_back({scenes[i], captions[i], {}});
        // A still does not play.
        if (all.still)
            all.panels[i].playback.resize(all.pictures.segments.size());
        else
            all.panels[i].playback = playback_of(all.members[i]->source(), all);
        // All plots and clocks are of the time that is shown.
        if (all.film_end > 0) all.panels[i].scene.run.duration = all.film_end;
    }
    leave_out_captions(what, all);
    share_colours(all.panels);
    share_reach(all.panels);
    if (!common_of(all.panels).exaggerated)  // then each panel has to say so
        for (Panel& panel : all.panels)
            if (panel.scene.film.exaggerate != 1)
                panel.caption += fmt::format(", wall motion drawn {:.3g}×", panel.scene.film.exaggerate);
    const PanelLayout layout = layout_of(all.panels, all.film.film);
    if (layout.places.empty())
        throw UserError(fmt::format("{}: {}x{} is too small for {} panels; make it larger",
                                    all.film.where("film.size"), all.film.film.width, all.film.film.height,
                                    scenes.size()));
    warn_of_single_moments(all);
    warn_of_pace(all);
    warn_of_what_is_left_out(layout, all);
    warn_of_missing_letters(all);
}

// Name, title and film of the whole: those of the first, a title only when all have it.
FilmedScene whole(const std::vector<FilmedScene>& scenes) {
    FilmedScene film = scenes.front();
    film.name.clear();
    for (const FilmedScene& scene : scenes) {
        film.name += (film.name.empty() ? "" : "-vs-") + scene.name;
        if (scene.film.title != film.film.title) film.film.title.clear();
    }
    constexpr std::size_t longest_name = 80;
    if (film.name.size() > longest_name)
        film.name = fmt::format("{}-and-{}-more", scenes.front().name, scenes.size() - 1);
    film.title = film.film.title.empty() ? film.name : film.film.title;
    return film;
}

}  // namespace

bool Comparison::all_recorded() const {
    return std::all_of(members.begin(), members.end(), [](const auto& member) { return member->archive(); });
}

Comparison read_comparison(const CompareRequest& what, const FilmRequest& film) {
    if (!what.at && !film.film && !film.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
    Comparison all;
    read_members(what, all);
    all.film = whole(scenes_of(all));
    fit_to_paper(all.film.film, what.print);
    all.dots_an_inch = dots_an_inch(what.print);
    choose_moments(what, all);
    make_panels(what, all);
    return all;
}

}  // namespace grainreel
