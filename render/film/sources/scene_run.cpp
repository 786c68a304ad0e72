#include "render/film/sources/scene_run.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/triangle_mesh.hpp"
#include "engine/files/run_names.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/walls/mesh_wear.hpp"

namespace grainreel {

// What pictures may take from the run. Of other moments it has those that were kept for pictures.
class SceneRun::Parts final : public PartSupply {
  public:
    Parts(const RunDriver& driver, std::shared_ptr<const std::vector<MeshWear>> worn)
        : driver_(driver), worn_(std::move(worn)) {}
    FramePtr at(std::int64_t step) const override { return driver_.kept(step); }
    std::vector<Touch> touches(const Frame&) const override {
        std::vector<Touch> touches;
        for (const SavedContact& contact : driver_.simulation().contacts())
            touches.push_back({contact.first, contact.second, contact.normal});
        return touches;
    }
    Measured measured(const Frame&) const override {
        const std::shared_ptr<const MeasureTable> table = driver_.files()->measures();
        return {table, table->rows()};
    }
    std::shared_ptr<const std::vector<MeshWear>> worn(const Frame&) const override { return worn_; }
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override {
        return driver_.files()->flowed_out(frame.time);
    }

  private:
    const RunDriver& driver_;
    const std::shared_ptr<const std::vector<MeshWear>> worn_;
};

Span SceneRun::span() const {
    return {driver_.plan().clock.time(driver_.first_step()), scene_.run.duration};
}

std::vector<Due> SceneRun::shots_of(const Pictures& pictures) const {
    const Plan& plan = driver_.plan();
    return shots_at(pictures.instants, pictures.segments, plan.clock, plan.steps);
}

std::vector<Frame> SceneRun::moments(const Pictures& pictures) const {
    const Clock& clock = driver_.plan().clock;
    std::vector<Frame> moments;
    for (const Due& shot : shots_of(pictures)) {
        Frame& moment = moments.emplace_back();
        moment.step = shot.step;
        moment.time = clock.time(shot.step);
        moment.cycles = clock.cycles(shot.step);
        moment.phase = clock.phase(shot.step);
    }
    return moments;
}

void SceneRun::start(const Pictures& pictures) {
    const Clock& clock = driver_.plan().clock;
    shots_ = shots_of(pictures);
    segments_ = pictures.segments;
    bed_periods_.emplace(scene_, clock, shots_, segments_, pictures.may_leave_out);
    parts_.emplace(scene_, clock, driver_.first_step());
    if (shows_wear(scene_)) read_wear_before();
    driver_.start(wishes());
    if (driver_.goes_on() && driver_.files()->keeps_film_moments())
        earlier_.emplace(scene_, clock, driver_.folder(), shots_, driver_.frames_before(),
                         driver_.files()->measures(), *driver_.files(), wear_before_);
    // An upper limit: if the bed turns out to repeat itself only every few periods, some pictures are left
    // out.
    count_ = std::count_if(shots_.begin(), shots_.end(), [&](const Due& shot) {
        return shot.step >= driver_.first_step() && bed_periods_->shows(rule(shot.segment), shot);
    });
}

FrameWishes SceneRun::wishes() {
    FrameWishes wishes;
    for (const Due& shot : shots_) wishes.steps.push_back(shot.step);
    wishes.look = [this](const Simulation& simulation) {
        look_at_bed_periods(simulation);
        if (shows_wear(scene_)) look_at_wear(simulation);
    };
    wishes.left_out = [this](std::int64_t step) { return leaves_out(step); };
    wishes.kept = wanted_moments();
    wishes.to_file = film_moments_bytes(scene_, driver_.plan(), std::ssize(shots_)) > 0;
    wishes.keep_rows = needs_measures(scene_.film.shows);
    wishes.key_moments = keys_wanted_;
    for (const FilmCaption& caption : scene_.film.captions) wishes.key_times.push_back(caption.from);
    return wishes;
}

// The moments that must be kept, for every number of periods after which the bed may turn out to repeat
// itself.
KeptMoments SceneRun::wanted_moments() const {
    KeptMoments wanted;
    const std::vector<int> multiples = bed_periods_->possible();
    for (const Due& shot : shots_)
        for (const int periods : multiples)
            wanted.want(shot.step, parts_->moments(shot.step, rule(shot.segment), periods));
    return wanted;
}

std::optional<Taken> SceneRun::next(const GoOn& go_on) {
    if (std::optional<Taken> picture = waiting()) return picture;
    if (earlier_ && !go_on()) return std::nullopt;
    if (earlier_)
        if (std::optional<Taken> picture = earlier_->next()) return picture;
    earlier_.reset();
    const std::shared_ptr<Frame> frame = driver_.next(go_on);
    if (!frame) return std::nullopt;
    Shot shot(std::move(*frame));
    parts_->add(shot, rule(segments_waiting_.back()), bed_periods_->shown(), Parts(driver_, worn_));
    frame_ = std::make_shared<const Shot>(std::move(shot));
    return waiting();
}

std::optional<Taken> SceneRun::waiting() {
    if (segments_waiting_.empty()) return std::nullopt;
    const int segment = segments_waiting_.front();
    segments_waiting_.erase(segments_waiting_.begin());
    ShotPtr frame = segments_waiting_.empty() ? std::move(frame_) : frame_;
    return Taken{std::move(frame), segment, bed_periods_->shown()};
}

std::vector<std::string> SceneRun::news() const {
    std::vector<std::string> news = driver_.news();
    if (bed_periods_) {
        const std::vector<std::string> of_bed = bed_periods_->news();
        news.insert(news.end(), of_bed.begin(), of_bed.end());
    }
    return news;
}

bool SceneRun::leaves_out(std::int64_t step) {
    segments_waiting_.clear();
    auto shot = std::lower_bound(shots_.begin(), shots_.end(), step,
                                 [](const Due& one, std::int64_t wanted) { return one.step < wanted; });
    for (; shot != shots_.end() && shot->step == step; ++shot)
        if (bed_periods_->shows(rule(shot->segment), *shot)) segments_waiting_.push_back(shot->segment);
    return segments_waiting_.empty();
}

void SceneRun::look_at_bed_periods(const Simulation& simulation) {
    bed_periods_->note(simulation.step(), static_cast<int>(simulation.measure("bed_periods")),
                       simulation.measure("period_difference_m"));
}

// Takes pressure and wear at the ends of the records of fields.nc, so that a film made during the run and one
// made from its files are alike.
void SceneRun::look_at_wear(const Simulation& simulation) {
    if (driver_.plan().fields.ends_record(simulation.step()))
        worn_ = std::make_shared<const std::vector<MeshWear>>(
            wear_among(scene_, simulation.field_sets(), simulation.fields()));
}

// Reads the pressure and wear that are shown before the first record of this run has ended.
void SceneRun::read_wear_before() {
    if (driver_.goes_on()) {
        wear_before_ = std::make_shared<const WearReader>(driver_.folder() / "fields.nc", scene_);
        worn_ = wear_before_->until(driver_.plan().clock.time(driver_.simulation().step()));
        return;
    }
    std::vector<MeshWear> none;
    for (const SceneMesh& mesh : scene_.meshes) {
        const auto triangles = mesh.shape().triangles.size();
        none.push_back({std::vector<double>(triangles, kNoValue), std::vector<double>(triangles, 0.0)});
    }
    worn_ = std::make_shared<const std::vector<MeshWear>>(std::move(none));
}

}  // namespace grainreel
