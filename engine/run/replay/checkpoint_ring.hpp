// The checkpoints of a run's way, from which each of its moments can be brought back. They lie in the folder
// `checkpoints` of the run, named by their steps, and cover the run evenly: where there would be too many of
// them, or too many bytes, the one goes whose neighbours are closest to each other. The first one stays.
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

// Those of a run's folder, checkpoint.grs among them, by rising step. Whether they are whole shows when they
// are read.
std::vector<KeptCheckpoint> kept_checkpoints(const std::filesystem::path& run);

// Where the ring of a run's folder has the checkpoint of a step.
std::filesystem::path place_in_ring(const std::filesystem::path& run, std::int64_t step);

class CheckpointRing {
  public:
    static constexpr std::size_t kMost = 20;
    static constexpr const char* kFolder = "checkpoints";

    // Checkpoints of a run from step `first` to `last`, of at most so many bytes. Takes over those up to
    // `first` that lie there, and removes those beyond it, which are of a future that will be run again.
    CheckpointRing(const std::filesystem::path& run, std::int64_t most_bytes, std::int64_t first,
                   std::int64_t last);

    // Whether the last one is so far back that the next is wanted.
    bool due(std::int64_t step) const;
    // `save` writes the checkpoint of this step to the file that it is given.
    void add(std::int64_t step, const std::function<void(const std::filesystem::path&)>& save);

    const std::vector<KeptCheckpoint>& kept() const { return kept_; }

  private:
    bool too_many() const;
    void remove(std::size_t index);

    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
    std::int64_t last_;
    std::vector<KeptCheckpoint> kept_;
    bool none_fits_ = false;  // a single one is larger than all may be
};

}  // namespace grainreel
