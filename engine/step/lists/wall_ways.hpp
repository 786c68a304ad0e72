// How far and how fast the points of walls move. Lists last until they may have moved too far.
#pragma once

#include <vector>

#include "engine/step/surroundings.hpp"

namespace grainreel {

class WallWays {
  public:
    // The surroundings must outlive it, and their meshes stay the same.
    explicit WallWays(const Surroundings& around);

    // m, the largest displacement of any point of any wall between two poses, relative to a frame displaced
    // by `flown`.
    double farthest(const Pose& before, const Pose& now, const Vec3& flown) const;
    // m/s, the largest velocity of any point of any wall relative to a frame with this velocity.
    double fastest(const Pose& now, const Vec3& frame) const;

  private:
    // A body's points lie within `radius` (m) of an axis through `centre`, about which it turns.
    struct Swing {
        Vec3 centre{0, 0, 0};  // m, at rest
        double radius = 0;
    };
    static Swing swing_of(const Face& face);
    static Swing swing_of(const MeshWall& mesh);

    const Surroundings& around_;
    std::vector<Swing> of_meshes_;
};

}  // namespace grainreel
