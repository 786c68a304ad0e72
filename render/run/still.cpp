#include "render/run/still.hpp"

#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/draw/camera/camera_path.hpp"
#include "render/draw/picture/renderer.hpp"
#include "render/film/files/film_limits.hpp"
#include "render/film/files/picture_files.hpp"
#include "render/run/redraw_run.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// Beside the run: "wedge-1.250s.png", and a number when that is taken.
fs::path free_name(const Scene& scene, const FrameArchive& run, double time) {
    const std::string stem = fmt::format("{}-{:.3f}s", scene.name, time);
    const fs::path beside = run.folder().parent_path();
    fs::path path = beside / (stem + ".png");
    for (int number = 2; fs::exists(path); ++number) path = beside / fmt::format("{}-{}.png", stem, number);
    return path;
}

void check_free(const fs::path& path, bool force) {
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw UserError(
            fmt::format("--out {}: there is no folder {}; make it first", path.string(), folder.string()));
    if (fs::is_directory(path, error))
        throw UserError(fmt::format("--out {}: is a folder; with --at, name a PNG file", path.string()));
    if (path.extension() != ".png")
        throw UserError(fmt::format("--out {}: with --at, name a file that ends in .png", path.string()));
    if (fs::exists(path, error) && !force)
        throw UserError(fmt::format("--out {}: exists already; choose another name, or --force to replace it",
                                    path.string()));
}

// --at beyond the run by more than its frames are apart.
void check_at(const FrameArchive& run, double at) {
    const double first = run.moments().front().time, last = run.moments().back().time;
    const double apart =
        run.moments().size() > 1 ? (last - first) / static_cast<double>(run.moments().size() - 1) : 0;
    if (at >= first - apart - 1e-9 && at <= last + apart + 1e-9) return;
    throw UserError(
        fmt::format("--at {:.6g} s: the run has frames from {:.6g} to {:.6g} s; choose a time in between", at,
                    first, last));
}

}  // namespace

fs::path draw_still(const FilmRequest& request, double at, RunListener& listener, const FrameSource& source) {
    const FrameArchive& run = *source.archive();
    check_at(run, at);
    const std::size_t index = run.nearest(at);
    const Frame frame = run.frame(index);
    if (request.out) check_free(*request.out, request.force);
    const fs::path path = request.out ? *request.out : free_name(source.scene(), run, frame.time);
    // A camera that moves is where it would be in the film of all the run's frames.
    Scene scene = source.scene();
    const auto seconds = [&](std::size_t frames) { return static_cast<double>(frames) / scene.film.rate; };
    settle_orbit(scene.film.camera, seconds(run.moments().size()));
    Renderer renderer(scene, drawing_threads(scene.run.threads).raster, request.gl);
    if (const std::string note = renderer.gl_note(); !note.empty()) listener.info(note);
    for (const std::string& line : source.news()) listener.warning(line);
    for (const std::string& line : film_warnings(scene, 1)) listener.warning(line);
    renderer.start_from(run.first_whole());
    const FilmTrails& trails = scene.film.shows.trails;
    if (trails.wanted())
        for (const std::size_t earlier : run.before(index, trails.duration))
            renderer.remember(run.grains(earlier));
    write_png(path, renderer.draw(frame, "", seconds(index)),
              texts_of(scene.name, scene.film.title, frame, ""), scene.film.transparent);
    if (const std::string note = renderer.colour_note(); !note.empty()) listener.info(note);
    listener.info(fmt::format("wrote {}: frame {} of {}, at {:.6g} s", path.string(), index + 1,
                              run.moments().size(), frame.time));
    return path;
}

}  // namespace grainreel
