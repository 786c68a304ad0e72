// How many grains are somewhere, or are like something, and what they are like in the mean, over time.
#pragma once

#include <optional>
#include <string>

#include "engine/questions/answer.hpp"
#include "engine/questions/asked_moment.hpp"
#include "engine/run/replay/replay.hpp"

namespace grainreel {

struct SeriesRequest {
    std::string condition;
    std::string mean_of{};          // a quantity of a grain; empty: counts alone
    std::optional<double> every{};  // s: at each multiple of it; none: at every moment that was kept
    bool replay = false;  // with `every`: moments are brought back; else those kept nearest are taken
};

// A row a moment: its time, the periods of the drive, the grains of each species for which the condition
// holds, all of them, and the mean of the quantity over these, empty where there is none. Moments whose
// grains are damaged are left out, with a note. Throws UserError for what cannot be asked, and where the
// question takes what a kept moment lacks. watcher: of moments that are brought back.
Answer series_of(MomentFinder& finder, const Record& record, const SeriesRequest& request,
                 const ReplayWatcher& watcher);

}  // namespace grainreel
