// measures.csv: one row a moment, every number a column, with the unit in the column's name.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {

// A last row without its end was cut off, and is left out.
struct MeasuresFile {
    std::shared_ptr<const MeasureTable> table;  // its rows; null when there is no file, or it is empty
    // "FILE:LINE: its time_s is no number but \"x\"": of the first row that is damaged. The table ends before
    // it.
    std::string fault;
};
MeasuresFile read_measures_file(const std::filesystem::path& path);
// The table alone.
std::shared_ptr<const MeasureTable> read_measures(const std::filesystem::path& path);

class MeasuresWriter {
  public:
    MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns);

    // Goes on with a file that is there, behind the rows of steps before `step`; what comes after them is cut
    // off. Throws UserError where it has other columns.
    MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns, std::int64_t step);

    // How many bytes stay of the file then. Throws UserError as above.
    static std::uintmax_t bytes_before(const std::filesystem::path& path,
                                       const std::vector<std::string>& columns, std::int64_t step) {
        return cut_before(path, columns, step).bytes;
    }

    // The row is on disk when this returns. Throws RunError when it could not be written.
    void write(const Measures& measures);

    const std::vector<std::string>& columns() const { return columns_; }
    std::int64_t rows() const { return rows_; }

  private:
    struct Cut {
        std::uintmax_t bytes = 0;
        std::int64_t rows = 0;
    };
    static Cut cut_before(const std::filesystem::path& path, const std::vector<std::string>& columns,
                          std::int64_t step);
    MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns, const Cut& cut);

    TextFile file_;
    std::vector<std::string> columns_;
    std::int64_t rows_ = 0;
};

}  // namespace grainreel
