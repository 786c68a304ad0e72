// What grains do to the surface of a mesh, triangle by triangle: how hard they press, the work of impacts and
// that of rubbing.
//
// The work of a contact with the normal force N and the tangential force T on the mesh, and the velocity u of
// the grain's surface against the mesh there: it presses with N; impacts do the work N max(0, u . n) dt, n
// into the mesh, which is what compresses the two; rubbing does T . u dt. All are looked at every second
// step, six times or more in a collision, and each look counts for the steps since the one before. The work
// of rubbing over the area is what Archard's law of wear is proportional to (J. F. Archard 1953, J. Appl.
// Phys. 24, 981, at a constant coefficient of friction), that of impacts what erodes (I. Finnie 1960, Wear 3,
// 87).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/measure/observer.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

inline constexpr std::int64_t kLookSteps = 2;

// One number for each triangle of one mesh, since the drive started.
struct WearSums {
    std::vector<double> press;   // N s, integral of the normal force
    std::vector<double> impact;  // J
    std::vector<double> shear;   // J
};

class WearTally {
  public:
    explicit WearTally(const Scene& scene);

    void begin() { seen_.clear(); }
    void contact(const Moment& m, const ContactView& c);
    // Adds what was seen since begin(), for so long (s). The same bits in whatever order it was seen.
    void add(double time);

    const std::vector<WearSums>& sums() const { return sums_; }  // a mesh each
    std::vector<WearSums>& sums() { return sums_; }
    bool fits(const std::vector<WearSums>& sums) const;  // whether they can be of these meshes

  private:
    struct Seen {
        std::size_t mesh, triangle;
        std::int32_t grain;           // its id
        double press, impact, shear;  // N, W, W
    };
    std::vector<Body> bodies_;
    std::size_t first_ = 0;  // number of the first mesh's body
    std::vector<WearSums> sums_;
    std::vector<Seen> seen_;
};

}  // namespace grainreel
