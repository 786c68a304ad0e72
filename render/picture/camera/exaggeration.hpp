// The container's motion drawn larger than it is, so that it can be seen.
#pragma once

#include "engine/frame.hpp"

namespace grainreel {

// Grains go with the container: seen from there every grain is where it is, so none is drawn inside a wall;
// only against the lab all of it moves `factor` times as far. That is right for a container that moves as a
// whole, and the scene's reader refuses any other.
class Exaggeration {
  public:
    explicit Exaggeration(double factor) : factor_(factor) {}

    // The frame itself for a factor of 1; else valid until the next call.
    const Frame& shown(const Frame& frame) {
        if (factor_ == 1) return frame;
        shown_ = frame;
        for (Vec3& position : shown_.position) position += (factor_ - 1) * frame.container().place;
        for (BodyPose& body : shown_.bodies) body.place *= factor_;
        return shown_;
    }

  private:
    const double factor_;
    Frame shown_;
};

}  // namespace grainreel
