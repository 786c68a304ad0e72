#include "render/run/frames/recorded_scene.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/measure/columns.hpp"
#include "render/scene/purposes.hpp"
#include "render/scene/read_scene.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// The run is over: what would have made it another run must not look as if it had.
void check_sets(const Assignments& sets) {
    for (const Assignment& set : sets) {
        const std::string key = set.key();
        const bool of_species = key.rfind("species", 0) == 0 && (ends_with(key, ".colour"));
        if (key.rfind("film.", 0) == 0 || of_species || key == "run.threads") continue;
        if (key == "title") throw UserError("--set title: a film drawn again has its title in film.title");
        throw UserError(
            fmt::format("{}: the run is over; only keys of [film] and the colours of species "
                        "can be changed, or run the scene again with `movie`",
                        set.place()));
    }
}

// The scene of a run names all its values, so that defaults of a purpose would change nothing: they are set.
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

}  // namespace

Assignments sets_for_drawing(const Assignments& sets) {
    check_sets(sets);
    return with_purpose(sets);
}

fs::path folder_of_run(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw UserError(fmt::format("{}: no such folder; give the folder of a run", folder.string()));
    const fs::path normal = folder.lexically_normal();
    if (normal.has_filename() && normal.filename() != "." && normal.filename() != "..") return normal;
    return normal.has_filename() || !normal.has_parent_path() ? fs::canonical(folder) : normal.parent_path();
}

fs::path file_of_run(const fs::path& folder, const char* name, const char* advice) {
    if (const std::string other = other_than_file(folder / name, true); !other.empty())
        throw UserError(
            fmt::format("{}: is {}, not a file of a run; {}", (folder / name).string(), other, advice));
    std::error_code error;
    if (fs::exists(folder / name, error)) return folder / name;
    throw UserError(fmt::format("{}: has no {}; {}", folder.string(), name, advice));
}

FilmedScene scene_of_run(const fs::path& folder, const Assignments& sets) {
    FilmedScene scene =
        read_filmed_scene(file_of_run(folder, "scene.toml", "give the folder of a run of `movie`"),
                          sets_for_drawing(sets), measurable_in);
    scene.name = folder.filename().string();
    return scene;
}

}  // namespace grainreel
