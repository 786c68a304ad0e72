#include "render/film/answers/filmed_record.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/state/checkpoint_file.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

void open_checkpoint(FilmedRecord& one, const fs::path& file, const Assignments& sets) {
    one.state = std::make_unique<RestoredCheckpoint>(file);
    one.film = scene_of_checkpoint_to_draw(file, sets);
}

void open_table(FilmedRecord& one, const fs::path& file, const Assignments& sets,
                const ReadingOptions& reading) {
    FrameRequest request;
    request.reading = reading;
    request.scene_of_run = [&](const fs::path& folder) {
        return one.film.emplace(scene_of_run(folder, sets));
    };
    one.state = std::make_unique<Record>(std::shared_ptr<const FrameArchive>(open_frames(file, request)));
    if (one.film) return;
    if (!sets.empty())
        throw UserError(fmt::format("{}: there is no scene.toml beside {}, so nothing of it can be set",
                                    sets.front().place(), file.string()));
    FilmedScene& film = one.film.emplace();
    static_cast<Scene&>(film) = one.state->scene();
    film.colours.resize(film.species.size());
}

}  // namespace

std::unique_ptr<const FilmedRecord> open_filmed_run(const fs::path& folder, const Assignments& sets) {
    auto one = std::make_unique<FilmedRecord>();
    const bool for_questions = true;
    one->run = std::make_unique<RecordedRun>(folder, sets, for_questions);
    one->record = &one->run->record();
    return one;
}

std::unique_ptr<const FilmedRecord> open_filmed_state(const fs::path& file, const Assignments& sets,
                                                      const ReadingOptions& reading) {
    auto one = std::make_unique<FilmedRecord>();
    is_checkpoint(file) ? open_checkpoint(*one, file, sets) : open_table(*one, file, sets, reading);
    one->record = one->state.get();
    return one;
}

}  // namespace grainreel
