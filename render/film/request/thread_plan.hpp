// How many threads each part gets, planned together so that engine, rasteriser and encoder share the machine.
#pragma once

#include <cstdint>

namespace grainreel {

struct ThreadPlan {
    int engine = 1;
    int raster = 1;           // of the software rasteriser, beside the drawing thread
    int encoder = 1;          // of x264
    bool take_turns = false;  // the engine rests while pictures are made: there are no processors for both
};

// processors: as many as the run may keep busy. With a film, about a third of the work is drawing and
// encoding. A thread with too few grains waits longer than it works.
ThreadPlan plan_threads(int processors, bool film, std::int64_t grains);

// The threads of a film that has the machine for itself. wanted: 0 for as many as the machine gives.
ThreadPlan drawing_threads(int wanted);

}  // namespace grainreel
