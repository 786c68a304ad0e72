// The checkpoints of a run, from which each of its moments can be computed again. They are in the folder
// `checkpoints` of the run, named by their steps, and cover the run evenly. If there are too many of them, or
// too many bytes, the one whose neighbours are closest to each other is removed. The first one stays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace grainreel {

struct KeptCheckpoint {
    std::int64_t step = 0;
    std::filesystem::path file;
    std::uintmax_t bytes = 0;
};

// The checkpoints of a run's folder, including checkpoint.grs, by rising step. They may be damaged; that
// shows only when they are read.
std::vector<KeptCheckpoint> kept_checkpoints(const std::filesystem::path& run);

// Path of the checkpoint of a step in the ring of a run's folder.
std::filesystem::path place_in_ring(const std::filesystem::path& run, std::int64_t step);

class CheckpointRing {
  public:
    static constexpr std::size_t kMost = 20;
    static constexpr const char* kFolder = "checkpoints";

    // The ring of a run from step `first` to `last`, with at most `most_bytes` bytes. Existing checkpoints up
    // to `first` are taken over. Later ones are removed, because these steps will be run again.
    CheckpointRing(const std::filesystem::path& run, std::int64_t most_bytes, std::int64_t first,
                   std::int64_t last);

    // Whether the last checkpoint is so far back that the next one is due.
    bool due(std::int64_t step) const;
    // Adds the checkpoint of a step. `save` writes it to the given file.
    void add(std::int64_t step, const std::function<void(const std::filesystem::path&)>& save);

    const std::vector<KeptCheckpoint>& kept() const { return kept_; }

  private:
    bool too_many() const;
    void remove(std::size_t index);

    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
    std::int64_t last_;
    std::vector<KeptCheckpoint> kept_;
    bool none_fits_ = false;  // a single checkpoint exceeds the limit for all
};

}  // namespace grainreel
