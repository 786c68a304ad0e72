#include "render/app/options/option_groups.hpp"

#include <fstream>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

std::string trimmed(const std::string& text) {
    const std::size_t from = text.find_first_not_of(" \t\r"), to = text.find_last_not_of(" \t\r");
    return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

std::string triple(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

}  // namespace

void add_camera_file(CLI::App& verb, CameraFiles& files, bool keep) {
    const auto add = [&](const char* flag, std::optional<fs::path>& into, const char* about) {
        verb.add_option_function<std::string>(
                flag,
                [flag, &into](const std::string& text) {
                    check_typed(flag, text);
                    into = text;
                },
                about)
            ->type_name("FILE")
            ->check(not_empty());
    };
    add("--camera", files.use, "Look as this file says, which --keep-camera wrote");
    if (keep) add("--keep-camera", files.keep, "Write the camera to a file, for --camera with other runs");
}

void use_camera_file(const CameraFiles& files, Assignments& sets) {
    if (!files.use) return;
    std::ifstream in = read_plain(*files.use);
    if (!in)
        throw UserError(
            fmt::format("--camera {}: cannot be opened; is there such a file?", files.use->string()));
    constexpr int most_lines = 100;
    Assignments all;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        const std::string place = fmt::format("{}:{}", files.use->string(), ++number);
        if (number > most_lines)
            throw UserError(fmt::format("{}: is no file of a camera, which has few lines", place));
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty() || line == "[film.camera]") continue;
        const std::size_t equals = line.find('=');
        const std::string key = trimmed(line.substr(0, equals));
        const bool plain = equals != std::string::npos && !key.empty() &&
                           key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
        if (!plain)
            throw UserError(fmt::format("{}: '{}' is no key of a camera; a line is like: azimuth = 20", place,
                                        excerpt(line)));
        all.push_back({fmt::format("film.camera.{}={}", key, trimmed(line.substr(equals + 1))), place});
    }
    if (all.empty()) throw UserError(fmt::format("--camera {}: has no key of a camera", files.use->string()));
    all.insert(all.end(), sets.begin(), sets.end());
    sets = std::move(all);
}

void keep_camera_file(const CameraFiles& files, const Camera& camera) {
    if (!files.keep) return;
    std::error_code ignored;
    if (fs::exists(*files.keep, ignored))
        throw UserError(
            fmt::format("--keep-camera {}: exists already; choose another name", files.keep->string()));
    const fs::path folder = files.keep->parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored))
        throw UserError(fmt::format("--keep-camera {}: there is no folder {}; make it first",
                                    files.keep->string(), folder.string()));
    if (!camera.keys.empty())
        throw UserError(
            "--keep-camera: the camera moves by [[film.camera.key]], which no file of one camera holds");
    std::string text = "# A camera by grainreel: render RUN --camera THIS_FILE\n[film.camera]\n";
    if (camera.position) {
        text += fmt::format("position = {}\n", triple(*camera.position));
    } else {
        const char* frames[] = {"container", "bed", "reach"};
        text += fmt::format("azimuth = {}\nelevation = {}\nframe = \"{}\"\n", camera.azimuth,
                            camera.elevation, frames[static_cast<int>(camera.frame)]);
        if (camera.frame == CameraFrame::reach && camera.reach)
            text += fmt::format("reach = {}\n", *camera.reach);
    }
    if (camera.target) text += fmt::format("target = {}\n", triple(*camera.target));
    text += fmt::format("field_of_view = {}\nzoom = {}\nup = {}\nfollow = {}\n", camera.field_of_view,
                        camera.zoom, triple(camera.up), camera.follow);
    TextFile(*files.keep).write(text);
}

}  // namespace grainreel
