// Reads the dump that another engine writes, each frame as soon as it is whole. Also counts its grains
// against the scene, and cuts it for a run that continues.
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

// A frame with rows by rising id. Ids are the engine's, from 1.
struct DumpRows {
    std::int64_t step = 0;  // the engine's step
    std::vector<std::int64_t> id;
    std::vector<int> type;  // from 1
    std::vector<double> radius;
    std::vector<Vec3> position, velocity, spin;
    std::size_t size() const { return id.size(); }
};

// Reads a dump while it grows.
class DumpTail {
  public:
    explicit DumpTail(std::filesystem::path file) : file_(std::move(file)) {}

    // The next frame if it is whole; none if it is not whole yet, or if there are no more. Throws UserError
    // with the line where the file holds something else, and RunError where it became shorter.
    std::optional<DumpRows> next();
    // Whether the file has become shorter than what was read of it.
    bool is_shorter() const;
    // Begins again with the first frame.
    void read_anew();
    // Number of bytes up to the end of the last frame that next() gave.
    std::uintmax_t taken() const { return place_ - text_.size(); }

  private:
    bool read_more();
    std::optional<std::string> line(std::size_t& at, std::int64_t& number) const;
    [[noreturn]] void wrong(std::int64_t line, const std::string& what) const;

    std::filesystem::path file_;
    std::string text_;          // text that was read, without the frames that next() gave
    std::uintmax_t place_ = 0;  // place of the text's end in the file
    std::int64_t line_ = 1;     // number of the text's first line
};

// The step of the newest restart file in the folder of a deck; none where there is no restart file.
std::optional<std::int64_t> newest_restart(const std::filesystem::path& folder, PeerEngine engine);

// When a signal asks LIGGGHTS to end, it writes a restart file under another name. If the output says that
// this file is whole, the function gives it the name of the others, so that the run goes on from there.
// Otherwise it removes the file.
void take_forced_restarts(const std::filesystem::path& folder, const std::filesystem::path& output);

// Cuts off a frame that is not whole, and the frames after a step of the engine, which will be written again.
// Throws UserError for a dump that does not fit the deck, RunError where it cannot be cut.
void trim_dump(const std::filesystem::path& dump, std::int64_t step);

// Counts the grains of each frame against the scene. If a grain leaves the box, LIGGGHTS drops it without a
// message and goes on.
class GrainCount {
  public:
    // file: of the dump, for messages.
    GrainCount(const Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}

    struct Change {
        std::vector<std::size_t> left;  // rows, in the frame before, of grains that have left
        std::int64_t came = 0;
    };
    // Which grains came and went between two frames that follow each other. before: null for the first frame.
    // Throws RunError where the first frame has too few grains, where a grain is missing that could not
    // leave, and where grains came in a scene without feeds.
    Change compare(const Frame* before, const Frame& now) const;

  private:
    bool may_leave(const Frame& before, std::size_t row, double seconds) const;

    const Scene& scene_;
    std::string file_;
};

}  // namespace grainreel
