// How fast a hopper runs out: the rate with its interval, the time when it is empty, and what Beverloo's law
// expects of its outlet.
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

// The rate (kg/s) of the law of Beverloo, Leniger and van de Velde (Chem. Eng. Sci. 15, 260, 1961). A round
// hole of diameter D has W = 0.58 rho sqrt(g) (D - 1.4 d)^(5/2); a slot of width B and length L has W = 1.03
// rho sqrt(g) (L - 1.4 d) (B - 1.4 d)^(3/2) (Nedderman, Statics and Kinematics of Granular Materials, 1992,
// ch. 10), with L in place of L - 1.4 d where the slot has no ends (periodic depth). d is the mean diameter,
// and rho is 0.6 of the mean density of the grains. None without an outlet in a container's floor, without
// gravity straight down on it, or where the outlet is narrower than the law can tell.
std::optional<double> beverloo_rate(const Scene& scene);
// The law in words, with its numbers: "for a slot of 18 mm, W = 1.03 rho ...".
std::string beverloo_words(const Scene& scene);

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
