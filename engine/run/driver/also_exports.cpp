#include "engine/run/driver/also_exports.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/stored/stored_run.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

const WriteFormat& format_called(const std::string& name) {
    const std::vector<WriteFormat>& all = frame_formats();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const WriteFormat& f) { return name == f.name; });
    GRAINREEL_CHECK(found != all.end());
    return *found;
}

std::vector<std::string> names_of(const AlsoFormats& also) {
    std::vector<std::string> names;
    for (std::size_t format = 0; format < kAlsoFormats.size(); ++format)
        if (also.has(format)) names.emplace_back(kAlsoFormats[format]);
    return names;
}

// Removes unfinished files of an earlier run that was killed.
void remove_parts(const fs::path& also) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(also, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with('.') && name.find(".part") != std::string::npos)
            fs::remove_all(entry.path(), ignored);
    }
}

}  // namespace

void check_also(const Scene& scene) {
    const std::vector<std::string> also = names_of(scene.output.also);
    if (contains(also, "stl") && surfaces_of(world_of(scene)).empty())
        throw UserError("{}: 'also' names \"stl\", which has walls alone, and this scene has none; remove it",
                        scene.where("output.also"));
}

std::string name_in_also(const std::string& format) {
    const std::string ending = format_called(format).ending;
    return ending.starts_with('-') ? format : format + ending;
}

std::string write_also(const fs::path& run, const Scene& scene,
                       const std::function<bool(const std::string& format, double done)>& watcher) {
    std::string written;
    const std::vector<std::string> formats = names_of(scene.output.also);
    if (formats.empty()) return written;
    const fs::path also = run / kAlsoFolder;
    if (const std::error_code error = make_plain_folder(also); error)
        throw RunError("{}: cannot be made: {}", also.string(), error.message());
    remove_parts(also);
    const StoredRun frames(run);
    double begin = 0;
    for (const std::string& format : formats) {
        bool goes_on = true;
        const auto go_on = [&](double done) {
            return goes_on = watcher(format, (begin + done) / static_cast<double>(formats.size()));
        };
        const bool replace = true;
        const std::string name = name_in_also(format);
        if (!go_on(0)) break;
        try {
            export_frames(frames, format, also / name, {}, replace, go_on);
        } catch (const RunError&) {
            if (goes_on) throw;
            break;
        }
        written += fmt::format("{}{}/{}", written.empty() ? "" : ", ", kAlsoFolder, name);
        ++begin;
    }
    return written;
}

}  // namespace grainreel
