// Figures of columns of measures.csv: means, deviations and slopes in a window of time, with honest
// intervals, or means of each period of the drive.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"

namespace grainreel {

class StoredRun;  // engine/run/stored/stored_run.hpp

// From one time to another, in s.
struct TimeWindow {
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
};

// "0.2s..0.8s", "0.2s..", "..0.8s". Throws UserError for anything else.
TimeWindow time_window(const std::string& text);

struct ColumnsRequest {
    std::vector<std::string> columns;
    TimeWindow window{};     // rows at its ends count
    bool slope = false;      // the slope too
    bool by_period = false;  // a row for each whole period of the drive, in place of one for all
};

// Throws UserError for a column that the run does not have, a window without rows, or a run without periods.
Answer columns_answer(const StoredRun& run, const ColumnsRequest& request);

}  // namespace grainreel
