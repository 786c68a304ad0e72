// The box of a dump: three lines below "ITEM: BOX BOUNDS", in one of three forms. Binary dumps have the same
// numbers.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/files/frames/world.hpp"

namespace grainreel {

// lo and hi along x, y, z, and the tilts xy, xz, yz. Bounds of a tilted box are those of the box around it,
// from which the tilts are taken off (LAMMPS, Howto_triclinic).
struct BoxBounds {
    std::array<double, 3> low{}, high{};
    double xy = 0, xz = 0, yz = 0;
    std::array<bool, 3> periodic{};
};
WorldCell cell_of(const BoxBounds& bounds);

// Line by line.
class BoxReader {
  public:
    // flags: what stands behind "BOX BOUNDS", "xy xz yz pp pp ff" or nothing in old dumps.
    explicit BoxReader(std::string_view flags);
    // One of the three lines. Returns what is wrong with it, or nothing.
    std::string take(std::string_view line);
    // After the third. `empty`: a box without grains may be inside out, as a shrink-wrapped one is.
    std::string finish(bool empty);
    const std::optional<WorldCell>& box() const { return box_; }

  private:
    std::size_t wanted() const;

    bool tilted_ = false, general_ = false;
    std::array<bool, 3> periodic_{};
    int lines_ = 0;
    std::array<std::array<double, 4>, 3> rows_{};
    std::optional<WorldCell> box_;
};

}  // namespace grainreel
