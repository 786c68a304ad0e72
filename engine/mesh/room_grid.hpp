// Answers for most places of a room at once: a grid of 32 x 32 x 32 cells. What one place of a cell without
// surface is, all are, and those of the cells beyond its sides at the same height.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/mesh/surface.hpp"

namespace grainreel {

class RoomGrid {
  public:
    enum class Answer : std::uint8_t { unknown, inside, outside };

    RoomGrid() = default;
    // `holds`: whether a place is in the room. It is asked for up to 64 places of each region of cells
    // without surface; where they differ (near a hole in a wall), that region stays unknown.
    RoomGrid(const Surface& surface, const Eigen::AlignedBox3d& box,
             const std::function<bool(const Vec3&)>& holds);

    Answer at(const Vec3& place) const;

  private:
    static constexpr int kAcross = 32, kCoarse = 4;
    void mark_free(const Surface& surface, const std::array<int, 3>& first, int size);
    void answer_region(std::int32_t seed, const std::function<bool(const Vec3&)>& holds, std::size_t most);
    Vec3 middle(const std::array<int, 3>& first, int size) const;

    Eigen::AlignedBox3d box_;
    Vec3 width_{0, 0, 0};          // m, of a cell
    std::vector<Answer> answers_;  // x fastest
    std::vector<char> free_;       // cells without surface that have no answer yet
};

}  // namespace grainreel
