// A run that lies on disk, as a source of frames: its scene, its trajectory, and what lies beside them. One
// that was stopped, was killed or still goes on will do: what is whole is read.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/contacts_file.hpp"
#include "engine/files/outflow_record.hpp"
#include "engine/files/trajectory.hpp"
#include "engine/measure/measure_table.hpp"
#include "engine/run/replay/own_checkpoints.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/assignment.hpp"
#include "render/run/frames/picture_parts.hpp"
#include "render/run/frames/record.hpp"

namespace grainreel {

class RecordedRun final : public Record, private PartSupply {
  public:
    // sets: changes to the scene, of what is drawn only: keys of [film], colours of species, run.threads.
    // Throws UserError for another key, when the folder has no scene.toml or no trajectory.nc that holds a
    // frame, when its files are of two runs, and when the film shows contacts or orientations and the run
    // kept none.
    //
    // Pictures are framed by how high the run's grains got (known_reach), or, for_questions, as the run's own
    // film was, which did not know that yet. For questions, contacts that cannot be used are left out with a
    // line of faults(): they can be brought back. alone: what the kept frames lack is to be had nowhere else,
    // and is complained of.
    struct Use {
        bool for_questions = false;
        bool alone = true;
    };
    RecordedRun(const std::filesystem::path& folder, const Assignments& sets, Use use);
    RecordedRun(const std::filesystem::path& folder, const Assignments& sets, bool for_questions = false)
        : RecordedRun(folder, sets, Use{for_questions, true}) {}

    // Reads all there is and leaves out the frames whose grains are damaged, with a line of news, so that no
    // damage shows up when half a film is made. Throws UserError when none is left, or contacts are damaged.
    // brought_back: their moments are had from elsewhere.
    void leave_out_damaged(bool brought_back = false);
    // From now on it is alone, and complains.
    void do_without_others();

    const Scene& scene() const override { return scene_; }  // named after the folder
    Supply supply() const override;
    Span span() const override { return {moments_.front().time, moments_.back().time}; }
    const FrameArchive* archive() const override { return this; }
    // Of each picture the kept moment that is nearest in time.
    std::vector<Frame> moments(const Pictures& pictures) const override;
    void start(const Pictures& pictures) override;
    std::optional<Taken> next(const GoOn& go_on) override;
    // What the film shows and the files lack.
    std::vector<std::string> news() const override;
    std::vector<std::string> faults() const override { return faults_; }

    const std::filesystem::path& folder() const override { return folder_; }
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override;
    Frame frame(std::size_t index) const override;
    int periods() const override { return periods_; }
    const Clock& clock() const override { return clock_; }
    std::vector<KeptCheckpoint> checkpoints() const override { return own().kept; }
    std::vector<std::string> checkpoint_news() const override { return own().news; }
    bool has_contacts_of(std::size_t index) const override;
    Frame first() const override { return first_whole(); }
    // Rows of measures.csv; null when there are none.
    const std::shared_ptr<const MeasureTable>& measures() const { return measures_; }
    // What pictures may take from it, and what adds that to them.
    const PartSupply& of_parts() const { return *this; }
    const PictureParts& parts() const { return *parts_; }
    // The row of measures.csv that is nearest to the moment; none without rows.
    std::optional<MeasuredRow> measured_near(std::size_t index) const override;

  private:
    FramePtr at(std::int64_t step) const override;
    std::vector<Touch> touches(const Frame& frame) const override;
    Measured measured(const Frame& frame) const override;
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override;

    void read_moments();
    // Reads each of places_ and keeps those that are not damaged.
    void keep_those(const std::function<void(std::size_t)>& read, bool brought_back = false);
    void check_same_run() const;
    void frame_what_is_reached();
    void read_contacts(bool alone);
    void read_contacts_for_questions();
    const OwnCheckpoints& own() const;
    void leave_out_unfinished_contacts();
    void check_contacts_of_run() const;
    void read_measures_of_run();
    void look_at_measures();
    void leave_out_measures(const std::string& why);
    void check_columns() const;
    void read_outflow_of_run();
    void find_periods();
    std::optional<std::size_t> index_at(double time) const;  // s
    void look_for_earlier_frames();
    std::string name_of(const char* file) const { return (folder_ / file).string(); }

    bool for_questions_;
    std::filesystem::path folder_;
    Scene scene_;
    TrajectoryReader trajectory_;
    std::optional<ContactsReader> contacts_;  // of a film that wants them
    std::vector<std::size_t> places_;         // in the trajectory, of the frames that are drawn
    std::vector<Frame> moments_;              // theirs
    Clock clock_;
    int periods_ = 1;
    std::shared_ptr<const MeasureTable> measures_;  // null when there are none
    std::vector<double> measured_;                  // s, their times
    std::optional<OutflowRecord> outflow_;          // of a film that counts it
    std::optional<PictureParts> parts_;
    std::vector<std::string> faults_, news_;
    mutable std::optional<OwnCheckpoints> own_;  // once they were asked for

    Pictures pictures_;
    std::size_t next_ = 0;  // of them
};

}  // namespace grainreel
