#include "render/film/sources/live_shots.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/triangle_mesh.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_names.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

Span LiveShots::span() const {
    return {driver_.plan().clock.time(driver_.first_step()), scene_.run.duration};
}

std::vector<Due> LiveShots::shots_of(const Pictures& pictures) const {
    const Plan& plan = driver_.plan();
    return shots_at(pictures.instants, pictures.segments, plan.clock, plan.steps);
}

std::vector<State> LiveShots::moments(const Pictures& pictures) const {
    const Clock& clock = driver_.plan().clock;
    std::vector<State> moments;
    for (const Due& shot : shots_of(pictures)) {
        State& moment = moments.emplace_back();
        moment.step = shot.step;
        moment.time = clock.time(shot.step);
        moment.cycles = clock.cycles(shot.step);
        moment.phase = clock.phase(shot.step);
    }
    return moments;
}

void LiveShots::start(const Pictures& pictures) {
    const Clock& clock = driver_.plan().clock;
    shots_ = shots_of(pictures);
    segments_ = pictures.segments;
    bed_periods_.emplace(scene_, clock, shots_, segments_, pictures.may_leave_out);
    if (driver_.goes_on()) recall_bed_periods();
    parts_.emplace(scene_, clock, driver_.first_step());
    if (shows_wear(scene_)) read_wear_before();
    driver_.start(wishes());
    if (driver_.goes_on() && driver_.files()->keeps_film_moments()) read_earlier();
    // An upper limit: if the bed turns out to repeat itself only every few periods, some pictures are left
    // out.
    count_ = std::count_if(shots_.begin(), shots_.end(), [&](const Due& shot) {
        return shot.step >= driver_.first_step() && bed_periods_->shows(rule(shot.segment), shot);
    });
}

FilmWishes LiveShots::wishes() {
    FilmWishes wishes;
    for (const Due& shot : shots_) wishes.steps.push_back(shot.step);
    wishes.look = [this](const SimulatedBed& simulation) {
        look_at_bed_periods(simulation);
        if (shows_wear(scene_)) look_at_wear(simulation);
    };
    wishes.left_out = [this](std::int64_t step) { return due_at(step).empty(); };
    wishes.kept = wanted_moments();
    wishes.to_file = film_moments_bytes(scene_, driver_.plan(), std::ssize(shots_)) > 0;
    wishes.keep_rows = needs_measures(scene_.film);
    wishes.key_moments = keys_wanted_;
    for (const FilmCaption& caption : scene_.film.captions) wishes.key_times.push_back(caption.from);
    return wishes;
}

// The moments that must be kept, for every number of periods after which the bed may turn out to repeat
// itself.
KeptStates LiveShots::wanted_moments() const {
    KeptStates wanted;
    const std::vector<int> multiples = bed_periods_->possible();
    for (const Due& shot : shots_)
        for (const int periods : multiples)
            wanted.want(shot.step, parts_->moments(shot.step, rule(shot.segment), periods));
    return wanted;
}

std::optional<Taken> LiveShots::next(const GoOn& go_on) {
    if (std::optional<Taken> picture = waiting()) return picture;
    if (earlier_ && earlier_->next < driver_.frames_before()) {
        if (!go_on()) return std::nullopt;
        return next_earlier();
    }
    const std::shared_ptr<State> frame = driver_.next(go_on);
    if (!frame) return std::nullopt;
    waiting_ = due_at(frame->step);
    Shot shot(std::move(*frame));
    parts_->add(shot, rule(waiting_.back().segment), bed_periods_->shown(), beside_now(shot.time),
                [this](std::int64_t step) {
                    StatePtr kept = driver_.kept(step);
                    return kept ? kept : filed(step);
                });
    frame_ = std::make_shared<const Shot>(std::move(shot));
    return waiting();
}

Beside LiveShots::beside_now(double time) const {
    const FilmShows& shows = scene_.film.shows;
    Beside all;
    if (needs_touches(shows)) all.touches = touches_of(driver_.simulation());
    if (needs_measures(scene_.film)) {
        all.measures = driver_.files()->measures();
        all.measure_rows = all.measures->rows();
    }
    if (shows_wear(scene_)) all.worn = worn_;
    if (shows.outflow) all.flowed_out = driver_.files()->flowed_out(time);
    return all;
}

void LiveShots::read_earlier() {
    const std::shared_ptr<const MeasureTable> rows = read_measures(driver_.folder() / "measures.csv");
    GRAINREEL_CHECK(rows != nullptr);
    earlier_.emplace();
    earlier_->moments = open_frames(driver_.folder() / kFilmMoments, {.format = "trajectory"});
    earlier_->steps = rows->all("step");
    earlier_->periods = MeasuredPeriods(*rows);
}

// A moment that the film of a resumed run showed before the run was broken off; null where there is none.
StatePtr LiveShots::filed(std::int64_t step) const {
    if (!earlier_) return nullptr;
    const std::vector<State>& moments = earlier_->moments->moments();
    const auto moment =
        std::lower_bound(moments.begin(), moments.end(), step,
                         [](const State& one, std::int64_t wanted) { return one.step < wanted; });
    if (moment == moments.end() || moment->step != step) return nullptr;
    const auto index = static_cast<std::size_t>(moment - moments.begin());
    return std::make_shared<const State>(earlier_->moments->grains(index));
}

// Gives the next picture that the film of a resumed run had before the run was broken off, from the moment
// that was kept for it.
Taken LiveShots::next_earlier() {
    const StateArchive& moments = *earlier_->moments;
    const std::size_t index = earlier_->next++;
    // If a moment is damaged, the list lacks it, and without this check another moment would take its place.
    if (index >= moments.moments().size() || moments.place(index) != index)
        throw UserError(moments.damage().empty()
                            ? moments.path().string() + ": lacks a picture that it has had"
                            : moments.damage().front());
    Shot shot = moments.grains(index);
    add_planes(scene_.walls, shot.time, shot.bodies);
    const auto due = std::lower_bound(shots_.begin(), shots_.end(), shot.step,
                                      [](const Due& one, std::int64_t step) { return one.step < step; });
    GRAINREEL_CHECK(due != shots_.end() && due->step == shot.step);
    const int periods = scene_.film.periods > 0 ? scene_.film.periods : earlier_->periods.at(shot.step);
    Beside beside = beside_now(shot.time);
    if (beside.measures)
        beside.measure_rows = static_cast<std::size_t>(
            std::upper_bound(earlier_->steps.begin(), earlier_->steps.end(), static_cast<double>(shot.step)) -
            earlier_->steps.begin());
    if (wear_before_) beside.worn = wear_before_->until(shot.time);
    parts_->add(shot, rule(due->segment), periods, std::move(beside),
                [this](std::int64_t step) { return filed(step); });
    return {std::make_shared<const Shot>(std::move(shot)), due->segment, periods};
}

std::optional<Taken> LiveShots::waiting() {
    if (waiting_.empty()) return std::nullopt;
    const int segment = waiting_.front().segment;
    waiting_.erase(waiting_.begin());
    ShotPtr frame = waiting_.empty() ? std::move(frame_) : frame_;
    return Taken{std::move(frame), segment, bed_periods_->shown()};
}

std::vector<std::string> LiveShots::news() const {
    std::vector<std::string> news = driver_.news();
    if (bed_periods_) {
        const std::vector<std::string> of_bed = bed_periods_->news();
        news.insert(news.end(), of_bed.begin(), of_bed.end());
    }
    return news;
}

std::vector<Due> LiveShots::due_at(std::int64_t step) const {
    std::vector<Due> due;
    auto shot = std::lower_bound(shots_.begin(), shots_.end(), step,
                                 [](const Due& one, std::int64_t wanted) { return one.step < wanted; });
    for (; shot != shots_.end() && shot->step == step; ++shot)
        if (bed_periods_->shows(rule(shot->segment), *shot)) due.push_back(*shot);
    return due;
}

// What was found of the bed's periods before the run was broken off. Without it the warning would tell the
// time from which the run goes on, as if the bed had only begun to repeat itself otherwise.
void LiveShots::recall_bed_periods() {
    const std::shared_ptr<const MeasureTable> rows = read_measures(driver_.folder() / "measures.csv");
    if (rows == nullptr) return;
    const MeasuredPeriods before(*rows);
    for (const MeasuredPeriods::Row& row : before.rows())
        if (row.step <= static_cast<double>(driver_.simulation().step()))
            bed_periods_->note(static_cast<std::int64_t>(row.step), row.periods, row.difference);
}

void LiveShots::look_at_bed_periods(const SimulatedBed& simulation) {
    bed_periods_->note(simulation.step(), static_cast<int>(simulation.measure("bed_periods")),
                       simulation.measure("period_difference_m"));
}

// Takes pressure and wear at the ends of the records of fields.nc, so that a film made during the run and one
// made from its files are alike.
void LiveShots::look_at_wear(const SimulatedBed& simulation) {
    if (driver_.plan().fields.ends_record(simulation.step()))
        worn_ = std::make_shared<const std::vector<MeshWear>>(
            wear_among(scene_, simulation.field_sets(), simulation.fields()));
}

// Reads the pressure and wear that are shown before the first record of this run has ended.
void LiveShots::read_wear_before() {
    if (driver_.goes_on()) {
        wear_before_ = std::make_shared<const WearReader>(driver_.folder() / "fields.nc", scene_);
        worn_ = wear_before_->until(driver_.plan().clock.time(driver_.simulation().step()));
        return;
    }
    std::vector<MeshWear> none;
    for (const SceneMesh& mesh : scene_.meshes) {
        const auto triangles = mesh.shape().triangles.size();
        none.push_back({std::vector<double>(triangles, kUnknown), std::vector<double>(triangles, 0.0)});
    }
    worn_ = std::make_shared<const std::vector<MeshWear>>(std::move(none));
}

}  // namespace grainreel
