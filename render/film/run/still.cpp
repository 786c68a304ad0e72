#include "render/film/run/still.hpp"

#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/questions/asked_moment.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/film/production/picture_files.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// A free name beside the run: "wedge-1.250s.png", with a number when that is taken.
fs::path free_name(const FilmedScene& scene, const fs::path& beside, double time) {
    const std::string stem = fmt::format("{}-{}s", scene.name, seconds_in_names(time));
    fs::path path = beside / (stem + ".png");
    for (int number = 2; fs::exists(path); ++number) path = beside / fmt::format("{}-{}.png", stem, number);
    return path;
}

void check_png(const fs::path& path, bool force) {
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

// The moment that is drawn, and the words about it.
struct Chosen {
    std::int64_t step = 0;
    std::string from;                    // "frame 4 of 7 of trajectory.nc"
    std::optional<std::string> instead;  // a warning, when the moment stands for the one that was asked for
};

// Chooses the moment. A kept moment may stand for the wanted one only if it is no farther from it in time
// than kept moments are from each other.
Chosen choose(const RenderRequest& what, const StoredShots& source) {
    const StoredRun& run = source.run();
    MomentRequest request{.at = what.at, .frame = what.frame, .frame_of_file = what.frame_of_file};
    request.held = [holds = CaptionHolds(source.scene().film)](double time) mutable {
        return holds.begin_at(time);
    };
    const AskedMoment asked = find_moment(run, request);
    Chosen chosen{source.shown(asked.step), "", std::nullopt};
    const double time = source.film().moment(chosen.step).time;
    if (chosen.step != asked.step) {
        const std::string lack =
            fmt::format("{}: {:.6g} s was not kept ({})", what.frame ? "--frame" : "--at",
                        what.at.value_or(asked.time), source.why_not_all());
        if (std::abs(time - asked.time) > run.mean_interval())
            throw UserError(
                fmt::format("{}; the kept moment nearest to it is {:.6g} s, too far away to stand "
                            "for it; choose that one",
                            lack, time));
        chosen.instead = fmt::format("{}; {:.6g} s is drawn, the kept moment that is nearest", lack, time);
    }
    const std::size_t index = run.nearest(time);
    if (run.moments()[index].step == chosen.step)
        chosen.from = fmt::format("frame {} of {} of trajectory.nc", index + 1, run.moments().size());
    else
        chosen.from = source.origin_of(chosen.step) == Origin::checkpoint ? "brought back from a checkpoint"
                                                                          : "from film_moments.nc";
    return chosen;
}

ReplayWatcher watcher_of(Listener& listener) {
    return replay_progress([&listener](const Progress& progress) { listener.progress(progress); });
}

// Steps of the film's pictures before `step`, back to where its trails begin. Those that cannot be had are
// left out.
std::vector<std::int64_t> before(std::int64_t step, double duration, const StoredShots& source) {
    constexpr double room = 1.001;
    std::vector<std::int64_t> steps;
    const double from = source.film().moment(step).time - room * duration;
    for (const Due& shot : source.film().shots())
        if (shot.step < step && source.film().moment(shot.step).time >= from && source.has(shot.step))
            steps.push_back(shot.step);
    return steps;
}

// Gives the renderer what the picture shows of the film before it: where grains were at first, and trails.
// Returns false when told to stop.
bool remember_what_was(Renderer& renderer, std::int64_t step, StoredShots& source,
                       const ShotSource::GoOn& go_on) {
    const std::vector<Due> film = source.film().shots();
    const StatePtr start = film.empty() ? std::make_shared<const State>(source.run().first_whole())
                                        : source.grains(source.shown(film.front().step), go_on);
    if (!start) return false;
    renderer.start_from(*start);
    const FilmTrails& trails = source.scene().film.shows.trails;
    if (!trails.wanted()) return true;
    for (const std::int64_t earlier : before(step, trails.duration, source)) {
        const StatePtr frame = source.grains(earlier, go_on);
        if (!frame) return false;
        renderer.remember(*frame);
    }
    return true;
}

}  // namespace

std::string seconds_in_names(double time) {
    int digits = 3;
    for (double shown = time * 1e3; digits < 6 && std::abs(shown - std::round(shown)) > 1e-4; shown *= 10)
        ++digits;
    return fmt::format("{:.{}f}", time, digits);
}

void check_still(const FilmRequest& request, const RenderRequest& what) {
    if (request.to_stdout)
        throw UserError(
            fmt::format("--out -: with {}, name a file that ends in .png", what.frame ? "--frame" : "--at"));
    if (request.out) check_png(*request.out, request.force);
}

std::optional<fs::path> draw_still(const FilmRequest& request, const RenderRequest& what, Listener& listener,
                                   StoredShots& source) {
    check_still(request, what);
    const Chosen chosen = choose(what, source);
    for (const std::string& line : source.news()) listener.warning(line);
    if (chosen.instead) listener.warning(*chosen.instead);
    for (const std::string& line : film_warnings(source.scene(), 1)) listener.warning(line);
    source.watch_replay(watcher_of(listener));
    const auto go_on = [&] { return listener.stop_signal() == 0; };
    // A moving camera stands where it would be in the film.
    const FilmSchedule::Place place = source.film().place_of(chosen.step);
    FilmedScene scene = source.scene();
    fit_to_paper(scene.film, what.print);
    settle_orbit(scene.film.camera, static_cast<double>(source.film().shots().size()) / scene.film.rate);
    Renderer renderer(scene, drawing_threads(scene.run.threads).raster, request.gl);
    if (const std::string note = renderer.gl_note(); !note.empty()) listener.info("note: " + note);
    if (!remember_what_was(renderer, chosen.step, source, go_on)) return std::nullopt;
    source.start({{chosen.step, place.segment}}, source.segments());
    const std::optional<Taken> picture = source.next(go_on);
    if (!picture) return std::nullopt;
    const fs::path run = source.run().path();
    const fs::path beside = what.beside.empty() ? run.parent_path() : what.beside;
    const fs::path path = request.out ? *request.out : free_name(scene, beside, picture->frame->time);
    write_png(path, renderer.draw(*picture->frame, "", place.time),
              texts_of(scene.name, scene.film.title, *picture->frame, ""), scene.film.transparent,
              dots_an_inch(what.print));
    if (const std::string note = renderer.last_note(); !note.empty()) listener.info(note);
    listener.info(
        fmt::format("wrote {}: the run at {:.6g} s, {}", path.string(), picture->frame->time, chosen.from));
    return path;
}

}  // namespace grainreel
