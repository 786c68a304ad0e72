#include "engine/files/frames/clock_of.hpp"

#include <cmath>

#include "engine/plan/drive_clock.hpp"

namespace grainreel {

Clock clock_of_steps(const Scene& scene, double step) {
    Clock clock;
    clock.step = step;
    if (!scene.drive.present || clock.step <= 0) return clock;
    return drive_clock(scene.drive, clock.step, std::llround(1 / (scene.drive.frequency * clock.step)));
}

Clock clock_of(const Scene& scene, const std::vector<Frame>& moments) {
    double step = 0;
    for (const Frame& moment : moments)
        if (moment.step != 0) step = moment.time / static_cast<double>(moment.step);
    // To the last bit, where both mean the same.
    if (scene.run.step && std::abs(step - *scene.run.step) <= 1e-12 * step) step = *scene.run.step;
    return clock_of_steps(scene, step);
}

}  // namespace grainreel
