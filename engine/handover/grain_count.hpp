// Counts the grains of each frame that another engine writes against the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

// Counts the grains of each frame against the scene. If a grain leaves the box, LIGGGHTS drops it without a
// message and goes on.
class GrainCount {
  public:
    // file: of the dump, for messages.
    GrainCount(const Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

    struct Change {
        std::vector<std::size_t> left;  // rows, in the frame before, of grains that have left
        std::int64_t came = 0;
    };
    // Which grains came and went between two frames that follow each other. before: null for the first frame.
    // Throws RunError where the first frame has too few grains, where a grain is missing that could not
    // leave, and where grains came, or are too many at first, in a scene without feeds.
    Change compare(const State* before, const State& now) const;

  private:
    bool may_leave(const State& before, std::size_t row, double seconds) const;

    const Scene& scene_;
    std::string file_;
};

}  // namespace grainreel
