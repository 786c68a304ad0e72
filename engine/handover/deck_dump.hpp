// Reads the dump that another engine writes for one of our decks, each frame as soon as it is whole. The
// reader is that of all dumps of LAMMPS (engine/files/foreign/dumps).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

class DeckDump {
  public:
    explicit DeckDump(std::filesystem::path file) : file_(std::move(file)) {}

    // The next frame if it is whole; none if it is not whole yet, or if there are no more. Step, ids (from 1)
    // and species (types less 1) are the engine's; a species may be none of the scene's. Throws UserError
    // where the file holds something else than the deck asks for, and RunError where it became shorter.
    std::optional<State> next();
    // Whether the file has become shorter than what was read of it.
    bool is_shorter() const;
    // Begins again with the first frame.
    void read_anew();

  private:
    bool look();
    bool is_given_up(std::size_t frame) const;
    void check_columns(const RawTable& table) const;
    State frame_of(const RawFrame& raw) const;

    std::filesystem::path file_;
    std::unique_ptr<RawFile> dump_;                  // null before there is a whole frame
    std::uintmax_t size_ = 0;                        // of the file when it was looked at last
    std::size_t next_ = 0;                           // number of the frame that next() gives
    bool checked_ = false;                           // whether its columns are those of the deck
    mutable std::vector<std::int64_t> least_after_;  // for each frame: the smallest step of those after it
};

// Cuts off a frame that is not whole, and the frames after a step of the engine, which will be written again.
// Throws UserError for a dump that does not fit the deck, RunError where it cannot be cut.
void trim_dump(const std::filesystem::path& dump, std::int64_t step);

}  // namespace grainreel
