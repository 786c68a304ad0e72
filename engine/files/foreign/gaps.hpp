// Counts what the files of another program do not say although they have columns for it, and tells the user.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grainreel {

// What a frame does not say of its grains, although it has columns for it: numbers of grains,
// and the id of the first.
struct Gaps {
    std::int64_t velocities = 0, spins = 0, orientations = 0, masses = 0;
    std::int32_t first = -1;  // id of the first grain without a velocity or spin; -1: none
    void add(const Gaps& other);
    bool any() const { return velocities + spins + orientations + masses > 0; }
    // What the user should know of it, a line each. name: of the files. where: "run.dump: frame 3", where the
    // first grain is.
    std::vector<std::string> words(const std::string& name, const std::string& where) const;
};

}  // namespace grainreel
