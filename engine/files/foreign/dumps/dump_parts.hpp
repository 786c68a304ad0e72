// Parts that the readers of text and of binary dumps share: the box, and the checks of ids and places. In
// text the box is three lines below "ITEM: BOX BOUNDS" in one of three forms; binary dumps have the same
// numbers.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

// lo and hi along x, y and z, and the tilts xy, xz and yz. For a tilted box the file has the bounds of the
// box around it, from which the tilts are subtracted (LAMMPS, Howto_triclinic).
struct BoxBounds {
    std::array<double, 3> low{}, high{};
    double xy = 0, xz = 0, yz = 0;
    std::array<bool, 3> periodic{};
};
WorldCell cell_of(const BoxBounds& bounds);

// Reads the box line by line.
class BoxReader {
  public:
    // flags: the text after "BOX BOUNDS", such as "xy xz yz pp pp ff"; it is empty in old dumps.
    explicit BoxReader(std::string_view flags);
    // Takes one of the three lines. Returns what is wrong with it, or nothing.
    std::string take(std::string_view line);
    // Makes the box after the third line. Returns what is wrong with it, or nothing. empty: the frame has no
    // grains; then a shrink-wrapped box may end before it begins, and there is no box().
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

// Whether a column must have finite numbers: ids, places, radii, diameters. Columns of LAMMPS's computes and
// fixes may be nan.
bool must_be_finite(const std::string& column);

// A row whose id is not a whole number or is also in an earlier row.
struct BadId {
    std::size_t row = 0;
    double id = 0;
    std::string words() const;
};
// A bad id in a table of grains; none where all are good or there are no ids.
std::optional<BadId> bad_id(const RawTable& grains);

}  // namespace grainreel
