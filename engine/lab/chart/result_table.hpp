// Results as they come, in a CSV file that a stopped chart goes on with.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "engine/base/plain_file.hpp"

namespace grainreel {

// As a cell: six digits.
std::string number(double value);

class ResultTable {
  public:
    // Opens `path`, or makes it with this header. The first `keys` columns tell the rows apart. Throws
    // UserError when the file is of another chart, RunError when it cannot be written.
    ResultTable(const std::filesystem::path& path, const std::string& header, std::size_t keys);

    // The rows so far, cell by cell.
    const std::vector<std::vector<std::string>>& rows() const { return rows_; }

    bool has(const std::vector<std::string>& key) const { return known_.count(join(key)) > 0; }
    // On disk when this returns.
    void add(const std::vector<std::string>& row);

  private:
    void note(const std::vector<std::string>& row);
    static std::string join(const std::vector<std::string>& cells);
    std::vector<std::vector<std::string>> rows_;
    std::set<std::string> known_;
    std::size_t keys_;
    TextFile file_;
};

}  // namespace grainreel
