// Finds grains that are ellipsoids or superquadrics by the columns of their file. A name that another program
// has for such a column is added in names.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/state/grain_shape.hpp"

namespace grainreel {

// The columns that say the shape of each grain.
class ShapeColumns {
  public:
    ShapeColumns() = default;
    // table: of the first frame that has rows. file: for messages. Throws UserError where a column that the
    // user names is not there.
    ShapeColumns(const RawTable& table, const ReadingOptions& options, const std::string& file);

    // The names of the columns by which grains of the table are no spheres; empty if all are spheres.
    const std::vector<std::string>& telling() const { return telling_; }
    bool has_extents() const { return extent_.has_value(); }
    bool any_blockiness() const { return blockiness_; }
    // The columns that shape() reads.
    std::vector<std::size_t> all() const;
    // The shape of the grain in a row. unit: m, of the file's lengths. It may be one that no grain has
    // (is_possible).
    GrainShape shape(const RawTable& table, std::size_t row, double unit) const;

  private:
    std::optional<std::array<std::size_t, 3>> extent_;
    double share_ = 1;  // of the half length in the column
    std::array<std::optional<std::size_t>, 2> power_;
    bool blockiness_ = false;
    std::vector<std::string> telling_;
};

}  // namespace grainreel
