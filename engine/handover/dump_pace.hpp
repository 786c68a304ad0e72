// At which steps an engine dumps. `dump ... N` knows multiples of N alone, and pictures lie at the steps
// nearest to even times; so a variable says the next step, and few runs serve thousands of pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grainreel {

// Dumps at from + floor(k every + 1/2), k = 0 ... count.
struct DumpPace {
    std::int64_t from = 0;
    double every = 1;  // steps, at least 1
    std::int64_t count = 0;
    std::int64_t at(std::int64_t k) const;
    std::int64_t end() const { return at(count); }
    // The step of the first dump behind `step`, as the deck's variable computes it.
    std::int64_t next(std::int64_t step) const;
    // That formula, for engines that count `shift` more steps.
    std::string next_text(std::int64_t shift) const;
};

// As few as go through rising steps, each beginning where the one before ends; none for less than two steps.
std::vector<DumpPace> dump_paces(const std::vector<std::int64_t>& steps);

}  // namespace grainreel
