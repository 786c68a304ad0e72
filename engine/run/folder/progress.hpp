// How far a run has come.
#pragma once

#include <cstdint>
#include <string>

namespace grainreel {

struct Progress {
    enum class Stage {
        growing,
        raining,
        settling,
        vibrating,
        charting,
        timing,
        drawing,
        studying,
        replaying,
        paging,
        exporting
    };
    Stage stage = Stage::growing;
    double done = 0;                              // of this stage, 0 to 1
    std::string what;                             // while charting, timing or studying
    double time = 0, end = 0;                     // s simulated, while vibrating
    double particle_steps_per_second = 0;         // 0: not known yet
    std::int64_t frames = 0, frames_planned = 0;  // of the film; planned 0: no film
    double elapsed = 0;                           // s of wall time since the run began
    double remaining = -1;                        // s of wall time; negative: not known yet
};

// "0.4 s", "45 s", "1 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);

}  // namespace grainreel
