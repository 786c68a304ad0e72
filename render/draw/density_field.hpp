// How crowded it is around each grain: a smooth field of solid fraction, for soft darkening inside the bed.
#pragma once

#include <array>
#include <vector>

#include "engine/frame.hpp"

namespace grainreel {

// The solid fraction met a little outside a grain, as a function of the direction n: level + slope . n.
struct Crowding {
    double level = 0;
    Vec3 slope{0, 0, 0};
};

class DensityField {
  public:
    // Rebuilds the field from the grains and samples it around each; cost is linear in grains and cells.
    // The field is continuous in the positions, so nothing flickers.
    const std::vector<Crowding>& update(const Frame& frame);

  private:
    void place_cells(const Frame& frame);
    void deposit(const Vec3& centre, double radius);
    void deposit_small(const Vec3& at, double volume);
    void deposit_large(const Vec3& at, double radius);
    double sample(const Vec3& point) const;

    double cell_ = 1;  // m
    Vec3 origin_{0, 0, 0};
    std::array<int, 3> cells_{};
    std::vector<float> fraction_;
    std::vector<Crowding> crowding_;
};

}  // namespace grainreel
