// Which grains take light from which: for each grain that is seen, those near it (ambient light) and those
// between it and the key light (shadows).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/spheres/light/light_grid.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

namespace grainreel {

class Neighbourhood {
  public:
    // shown: indices of the grains wanted. What is cut away takes no light.
    void update(const std::vector<ViewSphere>& spheres, const Cut& cut, const Lamp& lamp,
                const std::vector<std::uint32_t>& shown, Team& team);

    // What takes light from shown[slot]: occluders around it, and casters towards the lamp.
    NeighbourSpan occluders(std::size_t slot) const { return span(occluders_[slot]); }
    NeighbourSpan casters(std::size_t slot) const { return span(casters_[slot]); }

    // Radii from its surface up to which a grain takes ambient light from another.
    static constexpr float kReach = 1.0f;

  private:
    struct Range {
        std::uint32_t pool = 0, count = 0;
        std::size_t first = 0;
    };
    struct Pool {
        std::vector<NearGrain> all;
        std::vector<std::uint32_t> found;
        std::vector<std::uint64_t> met_by;  // of each grain: the number of the last search that came by it
        std::uint64_t search = 0;
        void forget_met() { ++search; }
        bool has_met(std::uint32_t j) { return std::exchange(met_by[j], search) == search; }
    };
    NeighbourSpan span(const Range& range) const {
        return {pools_[range.pool].all.data() + range.first, static_cast<int>(range.count)};
    }
    void find_occluders(std::size_t slot, std::uint32_t pool);
    void find_casters(std::size_t slot, std::uint32_t pool);
    float weight(const ViewSphere& own, const ViewSphere& other) const;

    // What the update that is under way works on.
    const std::vector<ViewSphere>* spheres_ = nullptr;
    const std::vector<std::uint32_t>* shown_ = nullptr;
    Cut cut_;
    Lamp lamp_;

    LightGrid grid_;
    std::vector<Pool> pools_;  // a thread
    std::vector<Range> occluders_, casters_;
};

}  // namespace grainreel
