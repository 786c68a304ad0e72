// Checks the health of a run that another engine makes. Each frame of its dump is checked as a state of our
// own runs is (engine/measure/health.hpp), with the same limits and words. Contacts are found from places.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/measure/deepest_contact.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

class ReturnedHealth {
  public:
    // scene, plan: those that were handed over; they must outlive this object.
    ReturnedHealth(const Scene& scene, const Plan& plan);
    ~ReturnedHealth();

    // Looks at the next frame, whose grains are where they are in the lab. Returns the largest overlap,
    // divided by the smaller radius. Throws RunError, with step and grain, where a grain went through a wall,
    // overlaps too far or is too fast for the step, and where the grains gained more energy than walls can
    // give.
    double look(const State& frame);

    // The contact that overlapped most in the frames so far, and a line about it where it overlapped far more
    // than planned; else empty.
    const DeepestContact& deepest() const;
    std::string overlap_text() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Finds the grains that overlap from their places alone, because frames of other engines have no lists. Calls
// see() once for each pair, with their indices and the overlap (m). period: of x in m; 0 for none. Places may
// lie beyond the period. The order of the pairs depends only on the places.
void for_overlapping(const std::vector<Place>& places, double period,
                     const std::function<void(std::int32_t, std::int32_t, double)>& see);

}  // namespace grainreel
