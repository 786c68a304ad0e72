// The box of a dump: three lines below "ITEM: BOX BOUNDS", in one of three forms. Binary dumps have the same
// numbers.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/files/foreign/raw_file.hpp"
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

// What text and binary dumps hold their grains to.

// Whether a grain cannot be without a finite number there: ids, places, radii. Computes and fixes may be nan.
bool must_be_finite(const std::string& column);

// A row whose id is no whole number, or one that a row before it has. `id` of a table of grains; none where
// it has no ids, or where all are good.
struct BadId {
    std::size_t row = 0;
    double id = 0;
    std::string words() const;
};
std::optional<BadId> bad_id(const RawTable& grains);

}  // namespace grainreel
