// The folder of a run as something to draw from: its scene and its trajectory.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/measure_table.hpp"
#include "engine/output/contacts_file.hpp"
#include "engine/output/trajectory.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class FinishedRun {
  public:
    // sets: changes to the scene, of what is drawn only: keys of [film], colours of species, run.threads.
    // Throws UserError for another key, and when the folder has no scene.toml or no trajectory.nc that goes
    // with it and holds a frame. A run that was stopped or killed will do.
    FinishedRun(const std::filesystem::path& folder, const std::vector<std::string>& sets);

    const std::filesystem::path& folder() const { return folder_; }
    const Scene& scene() const { return scene_; }  // named after the folder
    const TrajectoryReader& trajectory() const { return trajectory_; }
    std::filesystem::path measures() const { return folder_ / "measures.csv"; }  // may be missing

    // Every frame without its grains, in order of time.
    const std::vector<Frame>& moments() const { return moments_; }
    // With what the film wants beside the grains: measures until then, contacts, and the displacements over a
    // period when the trajectory has that moment.
    Frame frame(std::size_t index) const;
    // What the film wants and the run's files lack, a line each.
    const std::vector<std::string>& warnings() const { return warnings_; }
    // The frame nearest in time.
    std::size_t nearest(double time) const;

  private:
    void check_grains() const;
    void read_contacts();
    void read_measures_of_run();
    std::optional<std::size_t> a_period_before(std::size_t index) const;
    void look_for_earlier_frames();

    std::filesystem::path folder_;
    Scene scene_;
    TrajectoryReader trajectory_;
    std::optional<ContactsReader> contacts_;  // of a film that wants them
    std::vector<Frame> moments_;
    std::shared_ptr<const MeasureTable> measures_;  // null unless the film plots some
    std::vector<double> measured_;                  // s, their times
    std::vector<std::string> warnings_;
};

}  // namespace grainreel
