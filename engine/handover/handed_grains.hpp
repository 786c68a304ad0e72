// The grains that were handed over, as the data file has them. The dump that comes back must begin with them,
// or it is the dump of another run; and no grain may change its type or its radius.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/state/state.hpp"

namespace grainreel {

class HandedGrains {
  public:
    // data: the data file. Without it nothing is compared. Throws UserError with the line where it cannot be
    // read. dump: for messages.
    HandedGrains(const std::filesystem::path& data, std::string dump);

    // first: the first frame of the dump, with the engine's ids and steps, in the frame of the run. period:
    // m, of x; 0 for none. Throws UserError where a grain has another type or radius than was handed over. At
    // the engine's step 0 places, velocities and spins must be the same too.
    void check_first(const State& first, double period) const;

  private:
    struct Grain {
        std::int64_t id = 0;
        std::int32_t species = 0;
        double radius = 0;  // m
        Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};
    };
    void read(const std::filesystem::path& data);
    void check_moving(const State& first, std::size_t row, const Grain& grain, double period) const;
    [[noreturn]] void refuse(const State& first, std::size_t row, const std::string& what) const;

    std::string dump_, data_;
    std::vector<Grain> grains_;  // by rising id
};

// Throws RunError where a grain has another type or radius than in the frame before. Ids are ours.
void check_unchanged(const State& before, const State& now, const std::string& dump);

}  // namespace grainreel
