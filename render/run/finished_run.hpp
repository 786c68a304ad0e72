// The folder of a run as something to draw from: its scene and its trajectory.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/measure_table.hpp"
#include "engine/output/contacts_file.hpp"
#include "engine/output/trajectory.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/assignment.hpp"

namespace grainreel {

class FinishedRun {
  public:
    // sets: changes to the scene, of what is drawn only: keys of [film], colours of species, run.threads.
    // Throws UserError for another key, and when the folder has no scene.toml or no trajectory.nc that goes
    // with it and holds a frame. A run that was stopped or killed will do.
    FinishedRun(const std::filesystem::path& folder, const Assignments& sets);

    const std::filesystem::path& folder() const { return folder_; }
    const Scene& scene() const { return scene_; }                                // named after the folder
    std::filesystem::path measures() const { return folder_ / "measures.csv"; }  // may be missing

    // Reads all there is and leaves out the frames whose grains are damaged, with a warning, so that no
    // damage shows up when half a film is made. Throws UserError when none is left, or contacts are damaged.
    void leave_out_damaged();

    // Every frame without its grains, in order of time; without those whose moment is damaged, of which there
    // is a warning. Indices below are of this list.
    const std::vector<Frame>& moments() const { return moments_; }
    // The frame as it was kept. Throws UserError when it is damaged.
    Frame grains(std::size_t index) const;
    Frame first_whole() const;  // the first that is not damaged
    // With what the film wants beside the grains: measures until then, contacts, and the displacements a
    // period over the last periods() when the trajectory has that moment.
    Frame frame(std::size_t index) const;
    // What the film wants and the run's files lack, a line each.
    const std::vector<std::string>& warnings() const { return warnings_; }
    // Periods of the drive that displacements and locked frames go by: the film's, or those after which the
    // bed repeated itself at the run's end.
    int periods() const { return periods_; }
    // The frame nearest in time.
    std::size_t nearest(double time) const;

  private:
    void read_moments();
    // Reads each of places_ and keeps those that are not damaged.
    void keep_those(const std::function<void(std::size_t)>& read);
    void check_grains() const;
    void frame_what_is_reached();
    void tell_what_is_left_out();
    void read_contacts();
    void read_measures_of_run();
    void find_periods();
    std::optional<std::size_t> before_these_periods(std::size_t index) const;
    void look_for_earlier_frames();

    std::filesystem::path folder_;
    Scene scene_;
    TrajectoryReader trajectory_;
    std::optional<ContactsReader> contacts_;        // of a film that wants them
    std::vector<std::size_t> places_;               // in the trajectory, of the frames that are drawn
    std::vector<Frame> moments_;                    // theirs
    int periods_ = 1;                               // after which the bed repeats itself
    std::shared_ptr<const MeasureTable> measures_;  // null unless the film plots some
    std::vector<double> measured_;                  // s, their times
    std::vector<std::string> warnings_;
};

}  // namespace grainreel
