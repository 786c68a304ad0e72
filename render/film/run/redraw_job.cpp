#include "render/film/run/redraw_job.hpp"

#include <algorithm>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/typed_time.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// Throws when the film would go into the run's own folder, which is only read.
void check_out(const FilmRequest& request, const std::filesystem::path& run) {
    std::error_code error;
    if (request.out && std::filesystem::equivalent(*request.out, run, error))
        throw UserError("--out {}: is the run that is drawn; choose another name", request.out->string());
    if (!request.film && !request.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
}

std::vector<State> moments_of(const std::vector<Due>& shots, const FilmSchedule& film) {
    std::vector<State> moments;
    for (const Due& shot : shots) moments.push_back(film.moment(shot.step));
    return moments;
}

}  // namespace

RedrawJob::RedrawJob(const FilmRequest& request, const RenderRequest& what, Listener& listener,
                     StoredShots& source)
    : RedrawJob(request, what, listener, source, Folder::made) {}

void RedrawJob::check(const FilmRequest& request, const RenderRequest& what, Listener& listener,
                      StoredShots& source) {
    const RedrawJob checked(request, what, listener, source, Folder::none);
}

RedrawJob::RedrawJob(const FilmRequest& request, const RenderRequest& what, Listener& listener,
                     StoredShots& source, Folder folder)
    : FilmJob(request, listener),
      source_(source),
      scene_(source.scene()),
      named_(what.named.empty() ? source.run().path().string() : what.named),
      kept_alone_(what.every.has_value()) {
    check_out(request, source.run().path());
    check_times(what, source.run(), source.film().moment(source.film().last_step()).time);
    if (kept_alone_)
        choose_kept(what);
    else
        choose_pictures(what);
    film_.check(scene_, static_cast<std::int64_t>(shots_.size()));
    ThreadPlan threads = drawing_threads(scene_.run.threads);
    if (what.parts) {
        choose_parts(*what.parts);
        threads.encoder = encoder_threads_of_parts;
    }
    film_.use_threads(threads);
    if (folder == Folder::none) return;
    const std::filesystem::path beside =
        what.beside.empty() ? source.run().path().parent_path() : what.beside;
    const std::string which = parts_ ? parts_->folder_name() : "-render";
    make_folder({scene_.name + which, beside, request.out, request.force});
    for (const std::string& line : what.told) desk_.log->info(line);
}

void RedrawJob::choose_parts(const PartsWanted& wanted) {
    std::vector<double> times;
    for (const Due& shot : shots_) times.push_back(source_.film().moment(shot.step).time);
    parts_.emplace(wanted, film_.request(), scene_, std::move(times));
    film_.use_extent(parts_->extent(), parts_->here().frames);
}

std::vector<Due> RedrawJob::drawn() const {
    if (!parts_) return shots_;
    const auto first = shots_.begin() + parts_->here().first_picture;
    return {first, first + parts_->here().pictures};
}

// Chooses the film's pictures between two moments.
void RedrawJob::choose_pictures(const RenderRequest& what) {
    const FilmSchedule& film = source_.film();
    const std::vector<Due> all = film.shots();
    scene_.film.segments = source_.segments();
    // Pictures of one moment, as where segments meet, have no time between them.
    std::vector<double> times;
    for (const Due& shot : all)
        if (const double time = film.moment(shot.step).time; times.empty() || time > times.back())
            times.push_back(time);
    const std::vector<std::size_t> inside = typed_span(times, source_.clock().step, what.from, what.to);
    for (const Due& shot : all) {
        const double time = film.moment(shot.step).time;
        if (!inside.empty() && time >= times[inside.front()] && time <= times[inside.back()])
            shots_.push_back(shot);
    }
    if (shots_.empty() && !all.empty())
        throw UserError("{}: no picture of the film lies there; they go from {:.6g} to {:.6g} s",
                        what.from ? "--from" : "--to", film.moment(all.front().step).time,
                        film.moment(all.back().step).time);
    if (shots_.empty())
        throw UserError("{}: the run came to none of its film's pictures", source_.run().path().string());
    show_what_there_is();
}

// Replaces moments that cannot be had by the nearest kept moment. Each kept moment is shown once.
void RedrawJob::show_what_there_is() {
    std::vector<Due> shown;
    std::set<std::size_t> uneven;
    for (const Due& shot : shots_) {
        const std::int64_t step = source_.shown(shot.step);
        if (step == shot.step && source_.origin_of(step) == Origin::checkpoint && ++brought_back_ > 0)
            source_.prove(step);
        if (step != shot.step) uneven.insert(static_cast<std::size_t>(shot.segment));
        if (!shown.empty() && step <= shown.back().step) {
            ++left_out_;
            continue;
        }
        if (step != shot.step) ++replaced_;
        shown.push_back({step, shot.segment});
    }
    shots_ = std::move(shown);
    captions_.resize(segments_of(scene_.film).size());
    for (const std::size_t segment : uneven) {
        std::vector<Due> inside = shots_;
        std::erase_if(inside, [&](const Due& shot) { return shot.segment != static_cast<int>(segment); });
        captions_[segment] = pacing_caption(moments_of(inside, source_.film()), scene_.drive,
                                            scene_.film.rate, scene_.film.wording);
    }
}

// Chooses frames of the trajectory, which the film shows one after another at its rate.
void RedrawJob::choose_kept(const RenderRequest& what) {
    const std::vector<State> moments = chosen_moments(what, source_.run());
    const std::optional<FilmSegment> segment = pacing_of(moments, scene_.drive, scene_.film.rate);
    for (const State& moment : moments) shots_.push_back({moment.step, 0});
    scene_.film.segments = {segment.value_or(FilmSegment())};
    captions_ = {segment ? playback_caption(*segment, scene_.drive, scene_.film.rate, scene_.film.wording)
                         : ""};
}

std::vector<std::string> RedrawJob::warnings() const {
    const FilmedScene& scene = source_.scene();
    std::vector<std::string> warnings = source_.news();
    const auto add = [&](std::vector<std::string> lines) {
        std::move(lines.begin(), lines.end(), std::back_inserter(warnings));
    };
    if (auto warning = periods_warning(scene, source_.run())) warnings.push_back(std::move(*warning));
    if (kept_alone_) {
        add(single_moment_warnings(scene,
                                   "--every draws frames of the trajectory, which are single moments"));
    } else if (replaced_ + left_out_ == 0) {
        add(pace_warnings(scene, source_.clock()));
        add(strobe_warnings(scene.film, scene.drive, scene.run.duration));
    }
    if (kept_alone_ || replaced_ > 0) {
        if (auto warning = pacing_warning(moments_of(shots_, source_.film()), scene.drive))
            warnings.push_back(std::move(*warning));
    }
    if (replaced_ + left_out_ > 0)
        warnings.push_back(fmt::format(
            "of the film's {} pictures {} {} not kept: {} the kept moment that is nearest, {} left out; {}",
            shots_.size() + left_out_, replaced_ + left_out_, replaced_ + left_out_ == 1 ? "was" : "were",
            replaced_ == 1 ? "1 shows" : fmt::format("{} show", replaced_),
            left_out_ == 1 ? "1 is" : fmt::format("{} are", left_out_), source_.why_not_all()));
    add(film_warnings(scene_, static_cast<std::int64_t>(shots_.size())));
    if (parts_) add(parts_->warnings());
    return warnings;
}

std::string RedrawJob::caption_of(const Taken& picture) const {
    const auto segment = static_cast<std::size_t>(picture.segment);
    if (kept_alone_ || !captions_.at(segment).empty()) return captions_.at(segment);
    return pace_caption(segments_of(scene_.film).at(segment), picture.periods, scene_.drive, scene_.film.rate,
                        source_.clock(), scene_.film.wording);
}

// The frame of the film's first picture, from which start heights are counted. A film that shows only a part
// may lack that picture.
StatePtr RedrawJob::first_of_film(const ShotSource::GoOn& go_on) {
    if (kept_alone_) return std::make_shared<const State>(source_.run().first_whole());
    return source_.grains(source_.shown(source_.film().shots().front().step), go_on);
}

bool RedrawJob::work() {
    mark_begun();
    const std::vector<State> moments = moments_of(drawn(), source_.film());
    if (parts_ && parts_->is_part()) desk_.record.part = parts_->record();
    desk_.record.scene_file = scene_.file;
    desk_.record.drawn = {{source_.run().path().string(), static_cast<std::int64_t>(moments.size()),
                           moments.front().time, moments.back().time}};
    begin_record(warnings());
    if (brought_back_ > 0)
        desk_.listener.info(fmt::format(
            "{} of {} pictures were not kept and are brought back from checkpoints; --no-replay does without",
            brought_back_, shots_.size()));
    const auto go_on = [this] {
        if (desk_.listener.stop_signal() != 0) return false;
        desk_.folder->lock().check_there();
        return true;
    };
    const StatePtr start = first_of_film(go_on);
    if (!start) return false;
    if (desk_.record.part) {
        identify_part();
        scene_.film.sheet = {0, 0};
    }
    film_.open(scene_, static_cast<std::int64_t>(shots_.size()), start);
    source_.watch_replay([this](double) { return film_.show_progress(), true; });
    const std::int64_t first = parts_ ? parts_->here().first_picture : 0;
    std::int64_t number = parts_ ? parts_->known_from() : 0;  // number of the next picture in the film
    const std::vector<Due> seen(shots_.begin() + number, shots_.begin() + first + std::ssize(moments));
    source_.start(seen, segments_of(scene_.film));
    const auto next = [&] {
        const auto timer = desk_.times.during("reading");
        return source_.next(go_on);
    };
    while (std::optional<Taken> picture = next()) {
        const auto timer = desk_.times.during("waiting for the film");
        if (number++ < first) {
            film_.maker().remember(std::move(picture->frame));
            continue;
        }
        const std::string caption = caption_of(*picture);
        film_.note(*picture->frame);
        film_.maker().take(std::move(picture->frame), caption);
        film_.show_progress();
    }
    return desk_.listener.stop_signal() == 0;
}

void RedrawJob::identify_part() {
    const StoredRun& run = source_.run();
    desk_.record.part->run = checksum_of_run(run, checksum_of_file(run.path() / "scene.toml"));
    desk_.record.part->settings = checksum_of_settings(scene_, shots_, captions_);
}

// Adds the checksum of a part whose film is complete.
void RedrawJob::side_work_closed() {
    if (!desk_.record.part) film_.write_times();
    if (!desk_.record.part || !film_.made() || !film_.result().complete || film_.result().file.empty())
        return;
    desk_.record.part->checksum = checksum_of_file(folder() / film_.result().file);
}

std::string RedrawJob::stopped_text() const {
    return fmt::format("stopped at frame {} of {}", film_.result().frames, film_.frames_planned());
}

void RedrawJob::report_written() {
    const FilmSchedule& film = source_.film();
    const std::vector<Due> shots = drawn();
    desk_.listener.info(fmt::format("wrote {}: {}run.json, log.txt", folder().string(), film_.files_text()));
    desk_.listener.info(
        fmt::format("took {}: {} of {}, from {:.6g} to {:.6g} s", duration_text(desk_.watch.seconds()),
                    counted(film_.result().frames, "frame"), named_, film.moment(shots.front().step).time,
                    film.moment(shots.back().step).time));
}

}  // namespace grainreel
