// Masses as whole numbers, so that what has come, what is there and what has left agree to the last one, in
// whatever order they are summed; and what the feeds of a scene have given.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/step/geometry/wall_sums.hpp"

namespace grainreel {

// By species.
using MassCounts = std::vector<WideInt>;

WideInt total(const MassCounts& counts);

// kg, what a count is worth where no grain is heavier than `largest`: 2^-60 of that at least.
double mass_quantum(double largest);
WideInt mass_count(double mass, double quantum);

// kg, the largest that a grain of the scene may have.
double largest_mass(const Scene& scene);

class FedMass {
  public:
    // The scene must outlive it.
    explicit FedMass(const Scene& scene) : scene_(scene) {}

    // What the feeds have given when each has given so many: counts, by species.
    const MassCounts& of(std::span<const std::int64_t> given, double quantum);

  private:
    const Scene& scene_;
    double quantum_ = 0;
    std::vector<std::int64_t> given_;  // that are summed up already
    MassCounts sums_;
};

}  // namespace grainreel
