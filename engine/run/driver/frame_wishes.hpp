// What somebody wants of a run on its way beside the files that its scene asks for: a film, or a program that
// looks at the grains now and then.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/run/driver/kept_moments.hpp"
#include "engine/run/simulation/simulation.hpp"

namespace grainreel {

struct FrameWishes {
    // Steps at which frames are handed out (RunDriver::next()), rising. Those before the run's first step do
    // not come.
    std::vector<std::int64_t> steps;
    // Asked when the run has come to such a step: whether its frame is not wanted any more. None: all are
    // wanted.
    std::function<bool(std::int64_t step)> left_out;
    // Told of each step at which the run stops, before anything is done with it.
    std::function<void(const Simulation&)> look;
    // Earlier moments that those frames will want.
    KeptMoments kept;
    // Whether frames that are handed out go into film_moments.nc too. A run that goes on does what it did.
    bool to_file = false;
    // Whether the rows of measures.csv stay in memory too (RunFiles::measures()).
    bool keep_rows = false;
    // Whether key moments are kept with their contacts. A run that goes on does what it did.
    bool key_moments = false;
    // s of simulated time: key moments beside the usual ones.
    std::vector<double> key_times;
};

}  // namespace grainreel
