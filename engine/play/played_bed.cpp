#include "engine/play/played_bed.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/play/knobs.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace {

constexpr int least_periods = 3;  // of a change of the drive

Scene scene_of(const std::string& planned, const std::string& open, const PlayedBed::Turned& turned) {
    if (turned.empty()) return read_scene_text(planned, "scene.toml", {}, measurable_in);
    Scene scene = read_scene_text(open, "scene.toml", {}, measurable_in);
    // A new frequency keeps the acceleration, so Γ comes after it.
    for (const auto& [key, value] : turned) turn_knob(scene, key, value);
    return with_choices(scene, make_plan(scene));
}

// Where a bed lies for a moment while its scene changes; a page's file system is its memory.
std::filesystem::path held_bed() {
    return std::filesystem::temp_directory_path() / fmt::format("grainreel-held-{}.grs", ::getpid());
}

bool is_of_drive(const std::string& key) {
    return key.starts_with("drive.");
}

}  // namespace

PlayedBed::PlayedBed(const std::string& planned, const std::string& open, const Turned& turned)
    : scene_(scene_of(planned, open, turned)),
      drive_(scene_.drive),
      own_(scene_.drive.stages),
      upright_(scene_.gravity),
      plan_(make_plan(scene_)) {
    drive_.stages.clear();
    bed_.emplace(scene_, plan_, 1);
}

PackingResult PlayedBed::pack(const PackingWatcher& watcher) {
    return bed_->pack(watcher);
}

void PlayedBed::advance(std::int64_t steps) {
    const std::int64_t until = std::min(plan_.steps, bed_->step() + steps);
    if (wanted_) follow_wishes();
    bed_->advance(until);
}

void PlayedBed::turn(const std::string& key, double value) {
    Scene changed = scene_;
    if (!is_of_drive(key)) {
        if (key == "gravity") {
            changed.gravity = upright_;
            turn_knob(changed, key, value);
            upright_ = changed.gravity;
            rebuild(std::move(changed));
            if (tilt_ != 0) tilt(tilt_);
            return;
        }
        turn_knob(changed, key, value);
        return rebuild(std::move(changed));
    }
    changed.drive = drive_;
    changed.gravity = upright_;
    turn_knob(changed, key, value);
    drive_ = changed.drive;
    wanted_ = true;
    if (wish_ == Shaking::rests) wanted_ = false;  // it stays at rest, and goes on with the new value
}

void PlayedBed::shake(Shaking shaking) {
    wish_ = shaking;
    wanted_ = true;
}

void PlayedBed::tilt(double angle) {
    Scene changed = scene_;
    tilt_ = angle;
    changed.gravity = AxisRotation{Vec3(1, 0, 0), angle}.quaternion() * upright_;
    rebuild(std::move(changed));
}

// The time (s) from which a further stage may begin.
double PlayedBed::free_from() const {
    const double now = plan_.clock.time(bed_->step());
    if (scene_.drive.stages.empty()) return std::max(now, scene_.drive.ramp / scene_.drive.frequency);
    const DriveSchedule schedule(scene_.drive);
    return std::max(now, schedule.settled(scene_.drive.stages.size()));
}

void PlayedBed::follow_wishes() {
    const double now = plan_.clock.time(bed_->step()), free = free_from();
    if (free > now) return;  // a change goes on; the wish is for when it is over
    if (rest_after_tap_) {
        rest_after_tap_ = false;
        wish_ = Shaking::rests;
    }
    DriveStage stage;
    stage.from = std::nextafter(now, 2 * now + 1);
    stage.over = least_periods;
    stage.frequency = drive_.frequency;
    stage.amplitude = drive_.amplitude;
    if (wish_ == Shaking::rests) {
        stage.kind = DriveStage::Kind::rest;
        stage.amplitude = 0;
    } else if (wish_ == Shaking::taps_once) {
        stage.kind = DriveStage::Kind::taps;
        stage.interval = 1 / stage.frequency;
        stage.amplitude /= 2;  // a tap goes up by twice as much
        rest_after_tap_ = true;
    }
    wanted_ = rest_after_tap_;
    add_stage(stage);
}

// Stages of the scene that have not begun give way.
void PlayedBed::add_stage(const DriveStage& stage) {
    Scene changed = scene_;
    std::vector<DriveStage>& stages = changed.drive.stages;
    std::erase_if(stages, [&](const DriveStage& one) { return one.from >= stage.from; });
    stages.push_back(stage);
    rebuild(std::move(changed));
}

// The bed as it is, with every contact's history, under another scene. Step and stiffness stay.
void PlayedBed::rebuild(Scene changed) {
    Plan plan = make_plan(changed);
    const std::filesystem::path held = held_bed();
    bed_->save_checkpoint(held);
    bed_ = SimulatedBed::at_checkpoint(changed, plan, held, 1, true);
    std::error_code ignored;
    std::filesystem::remove(held, ignored);
    scene_ = std::move(changed);
    plan_ = std::move(plan);
}

std::string PlayedBed::scene_text() const {
    Scene scene = scene_;
    scene.drive = drive_;
    scene.drive.stages = own_;
    return written_scene(scene);
}

}  // namespace grainreel
