// A start by rain: grains appear one after the other above the bed, fall on it and come to rest. Also finds
// free places for new grains.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

struct RainReport {
    bool finished = true;  // false when the watcher stopped it
    std::int64_t steps = 0;
};

// Lets all grains of the scene rain into the container at rest, at rain_rate(). The species come mixed at
// random, in proportion to their counts. A grain appears at rest at a random place in a layer above the
// bed, where it touches nothing; the layer rises with the bed. `grains` is empty at first and `loop`
// belongs to it. watcher gets the share that has come and the steps so far; it stops the rain by returning
// false. Throws RunError when the grains find no room.
RainReport rain(const Scene& scene, const Plan& plan, const Surroundings& around, Grains& grains,
                StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher);

// Places for new grains in which they touch nothing.

// Rain and feeds look for places only once in so many steps, because the neighbour lists are made anew each
// time that grains come.
constexpr std::int64_t kStepsPerLook = 200;

// The box from low to high (m), with what is near it at one moment.
class FreePlaces {
  public:
    // largest (m) is the largest radius of the grains to come. The surroundings must outlive this object.
    FreePlaces(const Surroundings& around, const DrivePose& pose, const Grains& grains, const Vec3& low,
               const Vec3& high, double largest);

    // Draws places evenly from the box until a grain of this radius (m) is farther from every other grain
    // and every wall than a thousandth of its radius. Returns none when too many draws have failed. The
    // grain counts as being there from now on.
    std::optional<Vec3> take(double radius, Random& random);

    // Adds one more grain that is there and must not be touched.
    void add(const Place& place) { near_.push_back(place); }
    // Allows from now on only places for which the condition holds.
    void only_where(std::function<bool(const Vec3&)> holds) { holds_ = std::move(holds); }

  private:
    bool is_free(const Vec3& place, double radius) const;

    const Surroundings& around_;
    const DrivePose pose_;
    const Vec3 low_, high_;
    std::vector<Place> near_;
    std::vector<BodyPose> meshes_;  // poses of the surroundings' meshes
    std::function<bool(const Vec3&)> holds_;
};

}  // namespace grainreel
