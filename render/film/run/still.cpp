#include "render/film/run/still.hpp"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/questions/asked_moment.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/film/production/picture_files.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/picture/base/pdf_page.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// A free name beside the run: "wedge-1.250s.png" or ".pdf", with a number when that is taken.
fs::path free_name(const FilmedScene& scene, const fs::path& beside, double time, const char* ending) {
    const std::string stem = fmt::format("{}-{}s", scene.name, seconds_in_names(time));
    fs::path path = beside / (stem + ending);
    for (int number = 2; fs::exists(path); ++number)
        path = beside / fmt::format("{}-{}{}", stem, number, ending);
    return path;
}

void check_picture(const fs::path& path, bool pdf, bool force) {
    check_folder_around(path, "--out " + path.string());
    if (is_folder(path))
        throw UserError("--out {}: is a folder; with --at, name a PNG or PDF file", path.string());
    if (path.extension() != ".png" && path.extension() != ".pdf")
        throw UserError("--out {}: with --at, name a file that ends in .png or .pdf", path.string());
    if (pdf && path.extension() == ".png")
        throw UserError("--out {}: with --pdf, name a file that ends in .pdf", path.string());
    if (is_there(path) && !force)
        throw UserError("--out {}: exists already; choose another name, or --force to replace it",
                        path.string());
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
                "{}; the kept moment nearest to it is {:.6g} s, too far away to stand "
                "for it; choose that one",
                lack, time);
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

// The frame with a value for each grain.
ShotPtr with_own_values(const Shot& frame, const OwnColours& own) {
    if (own.id.empty() && own.value.size() != frame.size())
        throw UserError("{} values for the colours of {} grains; give one for each grain of {:.6g} s",
                        own.value.size(), frame.size(), frame.time);
    auto shot = std::make_shared<Shot>(frame);
    shot->own = own.value;
    if (own.id.empty()) return shot;
    shot->own.assign(frame.size(), kUnknown);
    for (std::size_t i = 0; i < frame.size(); ++i)
        if (const auto row = row_of_id(own.id, frame.id[i])) shot->own[i] = own.value[*row];
    return shot;
}

}  // namespace

std::string title_of_still(const FilmedScene& scene, const State& frame) {
    const std::string& title = scene.film.title.empty() ? scene.name : scene.film.title;
    return fmt::format("{}, {:.6g} s", title, frame.time);
}

std::string seconds_in_names(double time) {
    int digits = 3;
    for (double shown = time * 1e3; digits < 6 && std::abs(shown - std::round(shown)) > 1e-4; shown *= 10)
        ++digits;
    return fmt::format("{:.{}f}", time, digits);
}

void check_still(const FilmRequest& request, const RenderRequest& what) {
    if (request.to_stdout)
        throw UserError("--out -: with {}, name a file that ends in .png or .pdf",
                        what.frame ? "--frame" : "--at");
    if (request.out) check_picture(*request.out, what.print.pdf, request.force);
}

StillPainter::StillPainter(StoredShots& source, const FilmRequest& request, const PrintSize& print,
                           Listener& listener, std::shared_ptr<DrawingContext> kept)
    : source_(source),
      listener_(listener),
      gl_(request.gl),
      scene_(source.scene()),
      context_(std::move(kept)) {
    source.watch_replay(watcher_of(listener));
    fit_to_paper(scene_.film, print);
    settle_orbit(scene_.film.camera, static_cast<double>(source.film().shots().size()) / scene_.film.rate);
}

void StillPainter::tell_once(const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
        if (told_.insert(line).second) listener_.warning(line);
}

// Makes a renderer for these colours, unless the last one serves. What leaves trails is drawn by a new one.
// Returns false when told to stop.
bool StillPainter::prepare(std::int64_t step, const OwnColours* own, const ShotSource::GoOn& go_on) {
    FilmedScene scene = scene_;
    scene.film.shows.colour = own ? own->colouring : source_.scene().film.shows.colour;
    const bool same = scene.film.shows.colour == scene_.film.shows.colour;
    if (renderer_ && same && !scene.film.shows.trails.wanted()) return true;
    scene_ = std::move(scene);
    renderer_.reset();
    renderer_.emplace(scene_, drawing_threads(scene_.run.threads).raster, gl_, context_);
    context_ = renderer_->context();
    if (const std::string note = renderer_->gl_note(); !note.empty()) listener_.info("note: " + note);
    if (remember_what_was(*renderer_, step, source_, go_on)) return true;
    renderer_.reset();
    return false;
}

std::optional<StillPainter::Drawn> StillPainter::draw(const RenderRequest& what, const OwnColours* own,
                                                      PdfPage* page) {
    const Chosen chosen = choose(what, source_);
    tell_once(source_.news());
    if (chosen.instead) listener_.warning(*chosen.instead);
    tell_once(film_warnings(scene_, 1));
    const auto go_on = [&] { return listener_.stop_signal() == 0; };
    // A moving camera stands where it would be in the film.
    const FilmSchedule::Place place = source_.film().place_of(chosen.step);
    if (!prepare(chosen.step, own, go_on)) return std::nullopt;
    // Own values are those of one moment, so such a picture shows no exposure.
    const std::vector<FilmSegment> segments = source_.segments();
    source_.start({{chosen.step, place.segment}}, own ? of_single_moments(segments) : segments);
    const std::optional<Taken> taken = source_.next(go_on);
    if (!taken) return std::nullopt;
    const ShotPtr frame = own ? with_own_values(*taken->frame, *own) : taken->frame;
    const Picture* picture = nullptr;
    if (page)
        renderer_->draw_page(*page, *frame, "", place.time);
    else
        picture = &renderer_->draw(*frame, "", place.time);
    if (const std::string note = renderer_->last_note(); !note.empty()) listener_.info(note);
    return Drawn{picture, frame, chosen.from};
}

std::optional<fs::path> draw_still(const FilmRequest& request, const RenderRequest& what, Listener& listener,
                                   StoredShots& source) {
    check_still(request, what);
    PrintSize print = what.print;
    if (request.out && request.out->extension() == ".pdf") print.pdf = true;
    StillPainter painter(source, request, print, listener);
    const FilmedScene& scene = painter.scene();
    std::optional<PdfPage> page;
    if (print.pdf) page.emplace(scene.film.width, scene.film.height, dots_an_inch(print));
    const std::optional<StillPainter::Drawn> drawn = painter.draw(what, nullptr, page ? &*page : nullptr);
    if (!drawn) return std::nullopt;
    const fs::path run = source.run().path();
    const fs::path beside = what.beside.empty() ? run.parent_path() : what.beside;
    const fs::path path = request.out
                              ? *request.out
                              : free_name(scene, beside, drawn->frame->time, print.pdf ? ".pdf" : ".png");
    if (page)
        replace_file(path, page->finish(title_of_still(scene, *drawn->frame)));
    else
        write_png(path, *drawn->picture, texts_of(scene.name, scene.film.title, *drawn->frame, ""),
                  scene.film.transparent, dots_an_inch(print));
    listener.info(
        fmt::format("wrote {}: the run at {:.6g} s, {}", path.string(), drawn->frame->time, drawn->from));
    return path;
}

}  // namespace grainreel
