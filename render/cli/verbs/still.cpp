#include "render/cli/verbs/still.hpp"

#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/cli/report/result.hpp"
#include "render/draw/camera/camera_path.hpp"
#include "render/draw/picture/renderer.hpp"
#include "render/film/files/film_limits.hpp"
#include "render/film/files/picture_files.hpp"
#include "render/run/redraw_run.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// Beside the run: "wedge-1.250s.png", and a number when that is taken.
fs::path free_name(const FinishedRun& run, double time) {
    const std::string stem = fmt::format("{}-{:.3f}s", run.scene().name, time);
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

// The frames before `index` that trails reach back to.
std::vector<std::size_t> within_trails(const FinishedRun& run, std::size_t index) {
    const FilmTrails& trails = run.scene().film.shows.trails;
    std::vector<std::size_t> frames;
    if (!trails.wanted()) return frames;
    const double from = run.moments()[index].time - 1.001 * trails.duration;
    for (std::size_t i = 0; i < index; ++i)
        if (run.moments()[i].time >= from) frames.push_back(i);
    return frames;
}

// --at beyond the run by more than its frames are apart.
void check_at(const FinishedRun& run, double at) {
    const double first = run.moments().front().time, last = run.moments().back().time;
    const double apart =
        run.moments().size() > 1 ? (last - first) / static_cast<double>(run.moments().size() - 1) : 0;
    if (at >= first - apart - 1e-9 && at <= last + apart + 1e-9) return;
    throw UserError(
        fmt::format("--at {:.6g} s: the run has frames from {:.6g} to {:.6g} s; choose a time in between", at,
                    first, last));
}

}  // namespace

int draw_still(const FilmRequest& options, double at, Reporter& reporter, const FinishedRun& run) {
    check_at(run, at);
    const std::size_t index = run.nearest(at);
    const Frame frame = run.frame(index);
    if (options.out) check_free(*options.out, options.force);
    const fs::path path = options.out ? *options.out : free_name(run, frame.time);
    // A camera that moves is where it would be in the film of all the run's frames.
    Scene scene = run.scene();
    const auto seconds = [&](std::size_t frames) { return static_cast<double>(frames) / scene.film.rate; };
    settle_orbit(scene.film.camera, seconds(run.moments().size()));
    Renderer renderer(scene, drawing_threads(run.scene().run.threads).raster, options.gl);
    if (const std::string note = renderer.gl_note(); !note.empty()) reporter.info(note);
    for (const std::string& line : run.warnings()) reporter.warning(line);
    for (const std::string& line : film_warnings(scene, 1)) reporter.warning(line);
    renderer.start_from(run.first_whole());
    const std::string& title = run.scene().film.title;
    for (const std::size_t earlier : within_trails(run, index)) renderer.remember(run.grains(earlier));
    write_png(path, renderer.draw(frame, "", seconds(index)), texts_of(run.scene().name, title, frame, ""),
              run.scene().film.transparent);
    reporter.info(fmt::format("wrote {}: frame {} of {}, at {:.6g} s", path.string(), index + 1,
                              run.moments().size(), frame.time));
    print_result(path.string() + "\n");
    return 0;
}

}  // namespace grainreel
