// The list of grains that an answer is about, and series over time.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/questions/asked_moment.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/run/replay/replay.hpp"

namespace grainreel {

struct ListedColumn {
    AnswerColumn column;
    std::function<AnswerCell(std::size_t)> of;  // a grain's place in the frame
};

// Puts the ids of all grains found into the answer, for a picture, and adds a table of the first `most` of
// them with id, species, place, and the columns in `more`. There is no table where `most` is 0.
void add_grain_list(Answer& answer, const Snapshot& snapshot, const std::vector<std::size_t>& found,
                    std::size_t most, const std::vector<ListedColumn>& more);

// How many grains fulfil a condition, and the mean of a quantity over them, moment by moment.

struct SeriesRequest {
    std::string condition;
    std::string mean_of{};          // a quantity of a grain; empty: only counts
    std::optional<double> every{};  // s: at each multiple of it; empty: at every kept moment
    bool replay = false;  // with `every`: moments are brought back; else the nearest kept ones are taken
};

// One row for each moment: its time, the periods of the drive, the grains of each species for which the
// condition holds, all of them, and the mean of the quantity over these, empty where there is none. Moments
// whose grains are damaged are left out, with a note. Throws UserError for what cannot be asked, and where
// the question needs what a kept moment lacks. `watcher` follows the moments that are brought back.
Answer series_of(StoredRun& run, const SeriesRequest& request, const ReplayWatcher& watcher);

}  // namespace grainreel
