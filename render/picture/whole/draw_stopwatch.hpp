// Measures the stages of a picture (DrawTimes).
#pragma once

#include <chrono>

#include "render/picture/gl/opengl.hpp"
#include "render/picture/whole/renderer.hpp"

namespace grainreel {

// Adds up the times of the stages of a frame. It does nothing where `times` is null.
class DrawStopwatch {
  public:
    DrawStopwatch(const gl::Functions& gl, DrawTimes* times) : gl_(gl), times_(times) {}
    // The time since the last call, or since the watch was made, belongs to `stage`.
    void lap(double DrawTimes::*stage) {
        if (!times_) return;
        gl_.Finish();
        const auto now = std::chrono::steady_clock::now();
        times_->*stage += std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
    }

  private:
    const gl::Functions& gl_;
    DrawTimes* times_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace grainreel
