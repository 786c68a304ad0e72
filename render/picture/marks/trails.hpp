// Where chosen grains have been in the frames drawn lately.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class Trails {
  public:
    explicit Trails(const FilmedScene& scene);

    // Frames in the order of time; one that is seen again adds nothing, one from before starts anew.
    void take(const Frame& frame);

    struct Point {
        double age;  // 0: now, 1: as old as trails get
        Vec3 at;     // m
    };
    // One a grain, the newest point first; broken where a grain left through a periodic wall and came back
    // at the other.
    std::vector<std::vector<Point>> paths() const;

  private:
    struct Moment {
        double time;
        std::vector<std::int32_t> id;  // rising
        std::vector<Vec3> at;
    };
    bool chosen(std::int32_t id, std::int32_t species) const;

    std::vector<bool> species_;
    std::vector<std::int32_t> grains_;
    double duration_, longest_jump_;
    std::deque<Moment> moments_;  // the newest first
};

}  // namespace grainreel
