// Counts the grains of every dump against the scene. LIGGGHTS drops a grain that got out of its box without a
// word, and goes on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class GrainCount {
  public:
    // file: of the dump, for messages.
    GrainCount(const Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

    struct Change {
        std::vector<std::size_t> left;  // rows of the frame before: grains that have left since
        std::int64_t came = 0;
    };
    // What came and went between two frames that follow each other; before: null for the first. Throws
    // RunError naming step and id where a grain is missing that could not leave, or is there that was never
    // fed, and where one is not where it could be.
    Change compare(const Frame* before, const Frame& now) const;

  private:
    bool may_leave(const Frame& before, std::size_t row, double seconds) const;

    const Scene& scene_;
    std::string file_;
};

}  // namespace grainreel
