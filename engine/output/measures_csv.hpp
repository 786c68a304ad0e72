// measures.csv: one row a moment, every number a column, with the unit in the column's name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/text_file.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {

class MeasuresWriter {
  public:
    // species: their names, in the scene's order; each has its own columns.
    MeasuresWriter(const std::filesystem::path& path, const std::vector<std::string>& species);

    // The row is on disk when this returns. Throws RunError when it could not be written.
    void write(const Measures& measures);

    std::int64_t rows() const { return rows_; }

  private:
    TextFile file_;
    std::size_t species_;
    std::int64_t rows_ = 0;
};

}  // namespace grainreel
