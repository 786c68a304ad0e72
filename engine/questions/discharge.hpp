// How fast a hopper runs out: the rate with its interval, the time when it is empty, and what Beverloo's law
// expects of its outlet (engine/measure/flow/beverloo.hpp).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/questions/steadiness.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class StoredRun;  // engine/run/stored/stored_run.hpp

struct Discharge {
    double from = 0, to = 0;            // s, the part in which the rate is measured
    Estimate rate;                      // kg/s
    double mass = 0;                    // kg that has flowed out
    std::optional<double> emptied;      // s, when less than 1 % of all was left
    std::optional<double> would_empty;  // s, at this rate, if that is not known
};

// times (s) rise; gone: kg that have flowed out until then. all: kg that were inside; 0 where more comes in,
// so that no time of emptying is known. The rate is that between the moments at which 10 % and 70 % of all
// that flows out were out. None for fewer than 50 times.
std::optional<Discharge> discharge_of(const std::vector<double>& times, const std::vector<double>& gone,
                                      double all);

// The discharge of a run, from its outflow.csv, or from outflow_kg in its measures.csv where a tray catches
// the grains. None where no grain can leave, or too few have left.
std::optional<Discharge> discharge_in(const std::filesystem::path& folder, const Scene& scene);

// The lines with which a run ends: rate, time of emptying, law. Empty for none.
std::vector<std::string> discharge_lines(const std::filesystem::path& folder, const Scene& scene);

// Throws UserError where there is no discharge.
Answer discharge_answer(const StoredRun& run);

}  // namespace grainreel
