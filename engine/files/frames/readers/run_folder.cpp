// The folder of a run: its scene.toml, its trajectory.nc and what lies beside them.
#include <system_error>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/run_archive.hpp"
#include "engine/files/frames/saved_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

bool takes(const FileHead& head) {
    std::error_code ignored;
    return head.folder && (fs::exists(head.path / "scene.toml", ignored) ||
                           fs::exists(head.path / "trajectory.nc", ignored));
}

std::unique_ptr<FrameArchive> open(const fs::path& path, const FrameRequest& request) {
    const fs::path folder = folder_of_run(path);
    const bool for_questions = true;
    auto run = std::make_unique<RunArchive>(
        folder, request.scene_of_run ? request.scene_of_run(folder) : plain_scene_of_run(folder),
        for_questions);
    std::error_code ignored;
    if (fs::exists(folder / "contacts.nc", ignored)) run->read_contacts(true);
    return run;
}

}  // namespace

FrameReader run_folder_reader() {
    return {"run", "the folder of a run (scene.toml and trajectory.nc)", takes, open};
}

}  // namespace grainreel
