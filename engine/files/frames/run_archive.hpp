// RunArchive reads a run's folder as an archive of frames: its trajectory, contacts, fields and measures. The
// run may have been stopped or killed, or may still be going on; all that is whole is read. All files must be
// of one run.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

// A file in the folder of an imported run that says what was guessed and derived, a line for each.
inline constexpr const char* kImportNews = "import_news.txt";

class RunArchive final : public FrameArchive {
  public:
    // `folder` comes from folder_of_run(), and `scene` is the scene in this folder. Throws UserError when
    // there is no trajectory.nc with a frame, and when the files are of two runs.
    //
    // for_questions: if other files are missing, or contacts cannot be used, nothing is thrown. These faults
    // become lines of faults(). The caller can compute contacts by running parts of the scene again.
    RunArchive(const std::filesystem::path& folder, const Scene& scene, bool for_questions);

    // Makes contacts available. alone: there is no other source of contacts, so this throws UserError when
    // there are none.
    void read_contacts(bool alone);
    // Reads all frames and leaves out those with damaged grains, with a line of news, so that damage is found
    // before a film is half made. Throws UserError when no frame is left or contacts are damaged.
    // brought_back: the caller computes these moments again, and the news says so.
    void leave_out_damaged(bool brought_back);
    // Sets after how many periods the bed repeats itself, if the caller knows better.
    void set_periods(int periods) { periods_ = periods; }
    // Adds a line of news that the caller has found.
    void note(std::string line) { news_.push_back(std::move(line)); }

    const std::filesystem::path& path() const override { return folder_; }
    const std::filesystem::path& folder() const { return folder_; }
    const World& world() const override { return world_; }
    FrameSupply supply() const override;
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override;
    std::optional<std::vector<Touch>> touches(std::size_t index) const override;
    std::optional<std::vector<SavedContact>> contacts(std::size_t index) const override;
    bool has_contacts_of(std::size_t index) const override;
    std::shared_ptr<const FieldsReader> fields() const override;
    // The row of measures.csv nearest to the moment; none without rows.
    std::optional<MeasuredRow> measured_near(std::size_t index) const override;
    std::size_t place(std::size_t index) const override { return places_.at(index); }
    int periods() const override { return periods_; }
    Frame first() const override { return first_whole(); }
    const Scene* scene() const override { return &scene_; }
    std::vector<std::string> news() const override;

    const Clock& clock() const { return clock_; }
    // Damage of the files, because of which something of the run is missing. It is also among the news.
    const std::vector<std::string>& faults() const { return faults_; }
    // Whether contacts are available.
    bool has_contacts() const { return contacts_.has_value(); }
    // The rows of measures.csv; null when there are none.
    const std::shared_ptr<const MeasureTable>& measures() const { return measures_; }
    // The moment at exactly that time (s), if there is one. Frames and wanted times both lie on steps.
    std::optional<std::size_t> index_at(double time) const;
    std::string name_of(const char* file) const { return (folder_ / file).string(); }

  private:
    void make_world();
    void read_moments();
    // Calls `read` for each of places_ and keeps those that are not damaged.
    void keep_those(const std::function<void(std::size_t)>& read, bool brought_back = false);
    void check_same_run() const;
    void use_contacts(bool alone);
    void leave_out_unfinished_contacts();
    void check_contacts_of_run() const;
    void look_at_measures();
    void find_periods();

    const bool for_questions_;
    std::filesystem::path folder_;
    Scene scene_;
    TrajectoryReader trajectory_;
    World world_;
    std::optional<ContactsReader> contacts_;
    std::vector<std::size_t> places_;  // number of each moment's frame in the trajectory
    std::vector<Frame> moments_;
    Clock clock_;
    int periods_ = 1;
    std::shared_ptr<const MeasureTable> measures_;  // null when there are none
    std::vector<std::string> faults_, news_;
};

}  // namespace grainreel
