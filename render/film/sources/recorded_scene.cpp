#include "render/film/sources/recorded_scene.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/import/import_ranges.hpp"
#include "engine/state/checkpoint_file.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/purposes.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Refuses changes that would have made another run: the run is over, and its pictures must not look as if
// they had been in effect.
void check_sets(const Assignments& sets) {
    for (const Assignment& set : sets) {
        const std::string key = set.key();
        const bool of_species = key.rfind("species", 0) == 0 && (ends_with(key, ".colour"));
        if (key.rfind("film.", 0) == 0 || of_species || key == "run.threads") continue;
        if (key == "title") throw UserError("--set title: a film drawn again has its title in film.title");
        throw UserError(
            "{}: the run is over; only keys of [film] and the colours of species "
            "can be changed, or run the scene again with `movie`",
            set.place());
    }
}

// Adds the settings that the purpose of a film implies. They must be set, because the scene of a run names
// all its values, so that new defaults would have no effect.
Assignments with_purpose(const Assignments& sets) {
    Assignments all;
    for (const Assignment& set : sets) {
        const Purpose* purpose = set.key() == "film.for" ? find_purpose(set.value()) : nullptr;
        if (purpose == nullptr) continue;
        all.clear();
        for (std::string& text : assignments_of(*purpose)) all.push_back({std::move(text), set.place()});
    }
    all.insert(all.end(), sets.begin(), sets.end());
    return all;
}

// Files of other programs have no scene that says how fast grains are. Where a colour needs a range and the
// user gives none, the range comes from the frames.
Assignments with_range_of_frames(const fs::path& folder, Assignments sets) {
    const Assignment* by = nullptr;
    bool has_range = false;
    for (const Assignment& set : sets) {
        has_range = has_range || set.key() == "film.colour.range";
        if (set.key() == "film.colour.by") by = &set;
    }
    if (by == nullptr) return sets;
    if (import_lacks(folder, by->value()))
        throw UserError("{}: the files say nothing of \"{}\", or nothing but 0; colour by something else",
                        by->place(), by->value());
    if (has_range) return sets;
    if (const auto range = imported_range(folder, by->value()))
        sets.push_back(
            {fmt::format("film.colour.range=[{:.6g}, {:.6g}]", (*range)[0], (*range)[1]), by->place()});
    return sets;
}

}  // namespace

Assignments sets_for_drawing(const Assignments& sets) {
    check_sets(sets);
    return with_purpose(sets);
}

FilmedScene scene_of_run(const fs::path& folder, const Assignments& sets) {
    FilmedScene scene =
        read_filmed_scene(file_of_run(folder, "scene.toml", "give the folder of a run of `movie`"),
                          with_range_of_frames(folder, sets_for_drawing(sets)), measurable_in);
    scene.name = folder.filename().string();
    return scene;
}

namespace {

// The scene of a checkpoint as it was used, with changes to the drawing; named after the file.
FilmedScene scene_to_draw(const fs::path& checkpoint, const Assignments& sets) {
    auto [text, all] = scene_in_checkpoint(checkpoint);
    for (const Assignment& set : sets_for_drawing(sets)) all.push_back(set);
    FilmedScene scene = read_filmed_scene_text(text.text, text.file, all, measurable_in);
    scene.name = checkpoint.stem().string();
    return scene;
}

}  // namespace

FilmedRun open_filmed(const fs::path& path, const Assignments& sets, StoredRunRequest request) {
    FilmedRun filmed;
    bool has_scene = is_checkpoint(path);
    if (has_scene) filmed.scene = scene_to_draw(path, sets);
    request.scene_of_run = [&](const fs::path& folder) -> Scene {
        has_scene = true;
        return filmed.scene = scene_of_run(folder, sets);
    };
    filmed.run = std::make_unique<StoredRun>(path, request);
    if (!has_scene && !sets.empty())
        throw UserError("{}: there is no scene.toml beside {}, so nothing of it can be set",
                        sets.front().place(), path.string());
    if (!has_scene) {
        static_cast<Scene&>(filmed.scene) = filmed.run->known_scene();
        filmed.scene.colours.resize(filmed.scene.species.size());
    }
    if (filmed.scene.film.periods > 0) filmed.run->set_periods(filmed.scene.film.periods);
    return filmed;
}

namespace {

constexpr double most_grains = 2e7;  // limit for the grains that are read, over all frames
constexpr double strays = 0.01;      // share of the grains that may be higher than the reach

}  // namespace

std::optional<double> reach_of(const State& frame) {
    std::vector<double> tops;
    tops.reserve(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) tops.push_back(frame.position[i].z() + frame.radius[i]);
    if (tops.empty()) return {};
    const auto higher = static_cast<std::ptrdiff_t>(strays * static_cast<double>(tops.size()));
    const auto top = tops.end() - 1 - higher;
    std::nth_element(tops.begin(), top, tops.end());
    return *top;
}

std::optional<double> known_reach(const StateArchive& archive) {
    const std::size_t frames = archive.moments().size();
    const double grains = static_cast<double>(frames) *
                          static_cast<double>(std::max<std::size_t>(1, archive.world().most_grains));
    const auto stride = static_cast<std::size_t>(std::max(1.0, grains / most_grains));
    std::optional<double> reach;
    for (std::size_t i = 0; i < frames; i += stride) {
        try {
            const std::optional<double> here = reach_of(archive.grains(i));
            if (here && (!reach || *here > *reach)) reach = here;
        } catch (const DamagedFrame&) {
            continue;  // the code that draws it reports the damage
        }
    }
    return reach;
}

}  // namespace grainreel
