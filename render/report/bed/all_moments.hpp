// All moments of a run that its folder has: those of trajectory.nc, and those of the film's pictures.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/output/trajectory.hpp"
#include "render/run/frames/recorded_run.hpp"

namespace grainreel {

class AllMoments final : public FrameArchive {
  public:
    // The run outlives it. Throws UserError when film_moments.nc is of another run or cannot be read.
    explicit AllMoments(const RecordedRun& run);

    const std::filesystem::path& folder() const override { return run_.folder(); }
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override;
    Frame frame(std::size_t index) const override;  // touches only of moments of the trajectory
    int periods() const override { return run_.periods(); }

    bool is_of_trajectory(std::size_t index) const { return !places_[index].of_film; }

    // Whether the run kept the film's moments.
    static bool has_more(const std::filesystem::path& folder);

  private:
    struct Place {
        bool of_film = false;
        std::size_t index = 0;  // in its file
    };
    const RecordedRun& run_;
    TrajectoryReader film_;
    std::vector<Frame> moments_;
    std::vector<Place> places_;  // of each
};

}  // namespace grainreel
