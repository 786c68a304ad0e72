// The folder of a run as a record of frames: its trajectory, and what lies beside it. One that was stopped,
// was killed or still goes on will do: what is whole is read. All its files must be of one run.
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
#include "engine/files/trajectory.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// In the folder of a run that was made of another program's files: what was guessed and derived, a line each.
inline constexpr const char* kImportNews = "import_news.txt";

class RunArchive final : public FrameArchive {
  public:
    // folder: as folder_of_run() gives it. scene: that of the folder. Throws UserError when there is no
    // trajectory.nc that holds a frame, and when the files are of two runs.
    //
    // for_questions: what is missing beside the trajectory is a fault, and contacts that cannot be used are
    // left out with a line of faults(): they can be brought back.
    RunArchive(const std::filesystem::path& folder, const Scene& scene, bool for_questions);

    // Contacts are read when somebody wants them. alone: what the kept frames lack is to be had nowhere else,
    // and is complained of: throws UserError when there are none.
    void read_contacts(bool alone);
    // Reads all there is and leaves out the frames whose grains are damaged, with a line of news, so that no
    // damage shows up when half a film is made. Throws UserError when none is left, or contacts are damaged.
    // brought_back: their moments are had from elsewhere.
    void leave_out_damaged(bool brought_back);
    // Somebody says after how many periods the bed repeats itself.
    void set_periods(int periods) { periods_ = periods; }
    // A line of news that whoever uses it has found.
    void note(std::string line) { news_.push_back(std::move(line)); }

    const std::filesystem::path& path() const override { return folder_; }
    const std::filesystem::path& folder() const { return folder_; }
    const World& world() const override { return world_; }
    FrameSupply supply() const override;
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override;
    std::optional<std::vector<Touch>> touches(std::size_t index) const override;
    std::optional<std::vector<ContactRecord>> contacts(std::size_t index) const override;
    bool has_contacts_of(std::size_t index) const override;
    std::shared_ptr<const FieldsReader> fields() const override;
    // The row of measures.csv that is nearest to the moment; none without rows.
    std::optional<MeasuredRow> measured_near(std::size_t index) const override;
    std::size_t place(std::size_t index) const override { return places_.at(index); }
    int periods() const override { return periods_; }
    Frame first() const override { return first_whole(); }
    const Scene* scene() const override { return &scene_; }
    std::vector<std::string> news() const override;

    const Clock& clock() const { return clock_; }
    // Damage of the files, which makes answers poorer than the run was. They are among the news too.
    const std::vector<std::string>& faults() const { return faults_; }
    // Whether contacts are read.
    bool has_contacts() const { return contacts_.has_value(); }
    // Rows of measures.csv; null when there are none.
    const std::shared_ptr<const MeasureTable>& measures() const { return measures_; }
    // The moment at that time (s), when there is one: frames lie on steps, and so do moments that are wanted.
    std::optional<std::size_t> index_at(double time) const;
    std::string name_of(const char* file) const { return (folder_ / file).string(); }

  private:
    void make_world();
    void read_moments();
    // Reads each of places_ and keeps those that are not damaged.
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
    std::vector<std::size_t> places_;  // in the trajectory, of the moments
    std::vector<Frame> moments_;
    Clock clock_;
    int periods_ = 1;
    std::shared_ptr<const MeasureTable> measures_;  // null when there are none
    std::vector<std::string> faults_, news_;
};

}  // namespace grainreel
