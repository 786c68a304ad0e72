// The scene's feeds at work: which grains come, and when.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

// Feeds look every so many steps, so that lists are made anew no oftener. A grain comes at the first look
// after it is due. One that finds no place waits for the next look, and those behind it wait too.
class Feeder {
  public:
    // The scene and the surroundings must outlive it.
    Feeder(const Scene& scene, const Plan& plan, const Surroundings& around);

    // The first step after this one at which to look; far away where there are no feeds.
    std::int64_t next_look(std::int64_t step) const;

    // The grains that come at a step, which is one to look at. Throws RunError where grains have waited in
    // vain, because the place is full.
    std::vector<NewGrain> take(std::int64_t step, const Grains& grains);

    // How many each feed has given: what a checkpoint must hold.
    const std::vector<std::int64_t>& given() const { return given_; }
    void set_given(std::vector<std::int64_t> given) { given_ = std::move(given); }

  private:
    void check_patience(std::size_t feed, double time) const;

    const Scene& scene_;
    const Clock clock_;
    const Surroundings& around_;
    std::vector<std::int64_t> given_;  // by feed
    std::vector<bool> into_vessel_;    // by feed: its grains come in the room of a vessel of triangles
};

}  // namespace grainreel
