// Which glued grains are near a place. They are sorted into boxes once, at rest: each body that has some
// takes its boxes along.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/state/glued_grains.hpp"
#include "engine/step/grid/cells.hpp"
#include "engine/step/grid/neighbours.hpp"

namespace grainreel {

class GluedSearch {
  public:
    // Glued grains and faces must outlive the search. period: m, of x; 0 for none.
    GluedSearch(const GluedGrains& glued, const std::vector<Face>& faces, double period);

    // Calls each(number, distance) for all glued grains whose surface is closer to `centre` than `gap` (m),
    // at a pose of the drive; in no order.
    template <class Each>
    void near(const Vec3& centre, double gap, const Pose& pose, const Each& each) const {
        for (const OfBody& part : parts_) {
            const Vec3 at_rest = centre - part.body.place_at(pose);
            part.grid.near(at_rest, gap + largest_, false, [&](const std::int32_t* first, const auto* last) {
                for (; first != last; ++first)
                    if (const double distance = distance_to(*first, at_rest); distance < gap)
                        each(*first, distance);
            });
        }
    }

    // As list_walls(): under the grains [begin, end), by rising grain, then glued grain.
    void list(const Grains& grains, const Pose& pose, double skin, std::int32_t begin, std::int32_t end,
              std::vector<WallNeighbour>& part) const;

  private:
    struct OfBody {
        Body body;
        Grid grid;
    };
    // m, from a place to the surface, in the frame of the body.
    double distance_to(std::int32_t g, const Vec3& at_rest) const {
        Vec3 apart = at_rest - at_rest_[static_cast<std::size_t>(g)].position;
        apart.x() = wrapped(apart.x(), period_);
        return apart.norm() - at_rest_[static_cast<std::size_t>(g)].radius;
    }

    const GluedGrains& glued_;
    const double period_;
    double largest_ = 0;  // m, radius
    LargeArray<Place> at_rest_;
    std::vector<OfBody> parts_;
};

}  // namespace grainreel
