// A record that is asked questions, with the film that pictures of the answers are drawn by.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/questions/asked_run.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/sources/recorded_run.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct FilmedRecord {
    const Record* record = nullptr;
    const FilmedScene& scene() const { return run ? run->scene() : *film; }  // with its film

    std::unique_ptr<const RecordedRun> run;  // of a run's folder
    std::unique_ptr<const Record> state;     // of a single state
    std::optional<FilmedScene> film;         // of a single state
};

// A run's folder. sets: as for a RecordedRun. Throws UserError as above.
std::unique_ptr<const FilmedRecord> open_filmed_run(const std::filesystem::path& folder,
                                                    const Assignments& sets);

// A single state of a run, without the run's folder: a checkpoint, or a table of grains. A checkpoint holds
// its scene. A table takes that of the scene.toml beside it; without one its species are "type 1", "type 2"
// and so on, of unknown density, in no container. Throws UserError when the file cannot be read.
// Files of other programs are read as `reading` says.
std::unique_ptr<const FilmedRecord> open_filmed_state(const std::filesystem::path& file,
                                                      const Assignments& sets,
                                                      const ReadingOptions& reading = {});

}  // namespace grainreel
