// The dump of a deck of ours while an engine writes it: each frame once it is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/frame.hpp"
#include "engine/handover/carried_scene.hpp"
#include "engine/scene/scene.hpp"

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

// Prepares a dump for a run that goes on from an engine's restart file.

// The engine's step of the newest restart file in the folder of its deck; none without one.
std::optional<std::int64_t> newest_restart(const std::filesystem::path& folder, PeerEngine engine);

// Cuts off what the dump has of steps behind `step` of the engine, which will come again, and a frame that
// was broken off. Throws UserError for a dump that is not the deck's, RunError where it cannot be cut.
void trim_dump(const std::filesystem::path& dump, std::int64_t step);

// Counts the grains of every dump against the scene. LIGGGHTS drops a grain that got out of its box without a
// word, and goes on.

class GrainCount {
  public:
    // file: of the dump, for messages.
    GrainCount(const Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

    struct Change {
        std::vector<std::size_t> left;  // rows of the frame before: grains that have left since
        std::int64_t came = 0;
    };
    // What came and went between two frames that follow each other; before: null for the first. Throws
    // RunError naming step and id where a grain is missing that could not leave, or is there that was never
    // fed, and where one is not where it could be.
    Change compare(const Frame* before, const Frame& now) const;

  private:
    bool may_leave(const Frame& before, std::size_t row, double seconds) const;

    const Scene& scene_;
    std::string file_;
};

}  // namespace grainreel
