// A bed that is played with: it packs, runs, and its knobs are turned while it moves. A page's worker has one
// (page_engine.cpp); tests have it without a browser.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class PlayedBed {
  public:
    using Turned = std::map<std::string, double>;  // knobs that were turned, in SI, by key

    // `planned` is the text of a scene in which everything is resolved, `open` that of the same scene without
    // stiffness and step. Without turned knobs the planned one is run, with the bits of `movie`; else the
    // open one is planned here with them. Throws UserError.
    PlayedBed(const std::string& planned, const std::string& open, const Turned& turned);

    // As SimulatedBed::pack().
    PackingResult pack(const PackingWatcher& watcher);

    // Goes on by so many steps, or to the scene's end. Drive changes that had to wait are made when they can
    // be.
    void advance(std::int64_t steps);
    bool is_over() const { return bed_->step() >= plan_.steps; }

    // Turns a knob that does not pack anew. The bed goes on from where it is. Frequency and Γ change over
    // three periods, as stages of a drive do, as soon as a change before has come to its end.
    void turn(const std::string& key, double value);
    // Lets the drive go on or rest, or gives one tap, likewise.
    enum class Shaking { goes_on, rests, taps_once };
    void shake(Shaking shaking);
    // Turns gravity about the x axis by an angle (rad) from where the scene has it.
    void tilt(double angle);

    const Scene& scene() const { return scene_; }
    const Plan& plan() const { return plan_; }
    const SimulatedBed& bed() const { return *bed_; }

    // The scene with all knobs as they stand, from its start on, for `movie`.
    std::string scene_text() const;

  private:
    void rebuild(Scene changed);
    void add_stage(const DriveStage& stage);
    void follow_wishes();
    double free_from() const;

    Scene scene_;                  // as it is run: with the stages that were added
    Drive drive_;                  // as the knobs stand
    std::vector<DriveStage> own_;  // the stages of the scene itself
    Vec3 upright_;                 // m/s2, gravity without tilt
    double tilt_ = 0;              // rad
    Plan plan_;
    std::optional<SimulatedBed> bed_;
    bool wanted_ = false;              // whether the drive is to change as soon as it can
    Shaking wish_ = Shaking::goes_on;  // what it is to do then
    bool rest_after_tap_ = false;
};

}  // namespace grainreel
