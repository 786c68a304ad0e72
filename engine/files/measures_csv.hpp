// measures.csv: a row for each moment and a column for each number, with the unit in the column's name. It is
// written row by row and read as a MeasureTable.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {

// The content of a file. If the last line has no line end, its row was cut off, and it is left out.
struct MeasuresFile {
    std::shared_ptr<const MeasureTable> table;  // the rows; null when there is no file or it is empty
    // What is wrong with the first damaged row, "FILE:LINE: its time_s is no number but \"x\"". The table
    // ends before that row.
    std::string fault;
};
MeasuresFile read_measures_file(const std::filesystem::path& path);
// Reads only the table of a file.
std::shared_ptr<const MeasureTable> read_measures(const std::filesystem::path& path);

class MeasuresWriter {
  public:
    MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns);

    // Continues a file. The rows of steps before `step` stay, and later rows are cut off. Throws UserError
    // where the file has other columns.
    MeasuresWriter(const std::filesystem::path& path, std::vector<std::string> columns, std::int64_t step);

    // How many bytes of the file stay if it is continued. Throws UserError as above.
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
