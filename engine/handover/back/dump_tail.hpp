// The dump of a deck of ours while an engine writes it: each frame once it is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

// Rows by rising id, as the engine counts them: from 1.
struct DumpRows {
    std::int64_t step = 0;  // of the engine
    std::vector<std::int64_t> id;
    std::vector<int> type;  // from 1
    std::vector<double> radius;
    std::vector<Vec3> position, velocity, spin;
    std::size_t size() const { return id.size(); }
};

class DumpTail {
  public:
    explicit DumpTail(std::filesystem::path file) : file_(std::move(file)) {}

    // The next frame that is whole; none so far, or ever. Throws UserError with the line where the file holds
    // something else, and RunError where it got shorter.
    std::optional<DumpRows> next();
    // Bytes of the file up to the end of the last frame that next() gave.
    std::uintmax_t taken() const { return place_ - text_.size(); }

  private:
    bool read_more();
    std::optional<std::string> line(std::size_t& at, std::int64_t& number) const;
    [[noreturn]] void wrong(std::int64_t line, const std::string& what) const;

    std::filesystem::path file_;
    std::string text_;          // read and not yet taken
    std::uintmax_t place_ = 0;  // of its end in the file
    std::int64_t line_ = 1;     // of its begin
};

}  // namespace grainreel
