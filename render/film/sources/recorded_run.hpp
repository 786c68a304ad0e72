// A run that lies on disk, as a source of pictures: its frames, with all that its film shows besides the
// grains.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/run_archive.hpp"
#include "engine/files/outflow_csv.hpp"
#include "engine/files/wear_file.hpp"
#include "engine/measure/measures.hpp"
#include "engine/questions/asked_run.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/film/sources/picture_parts.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What the film shows that no other engine tells, with what to do without it, for a message; none if it shows
// nothing of the kind.
std::optional<std::string> lacking_elsewhere(const FilmedScene& scene);

class RecordedRun final : public FrameSource, private PartSupply {
  public:
    // sets: changes to the scene that concern the drawing only: keys of [film], colours of species,
    // run.threads. Throws UserError for another key, when the folder has no scene.toml or no trajectory.nc
    // that holds a frame, when its files are of two runs, and when the film shows contacts or orientations
    // and the run kept none.
    //
    // Pictures are framed by how high the run's grains got (known_reach), or, with for_questions, as in the
    // run's own film, which did not know that height yet. With for_questions, contacts that cannot be used
    // are left out with a line in RunArchive::faults(), since they can be computed again. With alone, what
    // the kept frames lack cannot be had elsewhere, and missing parts are reported.
    struct Use {
        bool for_questions = false;
        bool alone = true;
    };
    RecordedRun(const std::filesystem::path& folder, const Assignments& sets, Use use);
    RecordedRun(const std::filesystem::path& folder, const Assignments& sets, bool for_questions = false)
        : RecordedRun(folder, sets, Use{for_questions, true}) {}
    RecordedRun(const RecordedRun&) = delete;
    RecordedRun& operator=(const RecordedRun&) = delete;

    // Leaves out damaged frames (RunArchive). brought_back: the caller computes their moments again.
    void leave_out_damaged(bool brought_back = false) { archive_->leave_out_damaged(brought_back); }
    // From now on the source is `alone`: what the kept frames lack cannot be had, and missing parts are
    // reported.
    void do_without_others();

    const FilmedScene& scene() const override { return scene_; }  // the scene is named after the folder
    Supply supply() const override;
    Span span() const override { return {moments().front().time, moments().back().time}; }
    const FrameArchive* archive() const override { return archive_.get(); }
    // For each picture, the kept moment that is nearest in time.
    std::vector<Frame> moments(const Pictures& pictures) const override;
    void start(const Pictures& pictures) override;
    std::optional<Taken> next(const GoOn& go_on) override;
    // Lines about what the film shows and the files lack.
    std::vector<std::string> news() const override { return archive_->news(); }

    // The archive that it reads, without the parts that a film adds.
    const RunArchive& frames() const { return *archive_; }
    const std::vector<Frame>& moments() const { return archive_->moments(); }
    const Clock& clock() const { return archive_->clock(); }
    // A frame with all that the scene's film shows. Throws as the archive does.
    Shot frame(std::size_t index) const;
    void add_parts(Shot& shot) const;  // the same for a moment of the archive
    // The archive for questions; it knows what frame() gives.
    const AskedRun& record() const { return *record_; }
    // What pictures may take from this run, and the object that adds it to them.
    const PartSupply& of_parts() const { return *this; }
    const PictureParts& parts() const { return *parts_; }

  private:
    FramePtr at(std::int64_t step) const override;
    std::vector<Touch> touches(const Frame& frame) const override;
    Measured measured(const Frame& frame) const override;
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override;
    std::shared_ptr<const std::vector<MeshWear>> worn(const Frame& frame) const override;

    void frame_what_is_reached();
    void read_measures_of_run();
    void leave_out_measures(const std::string& why);
    void check_columns() const;
    void read_outflow_of_run();
    // Whether the frames come from files of another program.
    bool is_import() const;
    // Whether another engine computed the run.
    bool is_elsewhere() const;
    void read_wear_of_run();
    void fit_range_of_import();
    void look_for_earlier_frames();
    const MeasureTable& table() const { return *archive_->measures(); }
    std::string name_of(const char* file) const { return archive_->name_of(file); }

    bool for_questions_;
    FilmedScene scene_;
    std::shared_ptr<RunArchive> archive_;
    std::unique_ptr<const AskedRun> record_;
    std::vector<double> measured_;        // s, times of the rows of measures
    std::optional<OutflowSums> outflow_;  // for a film that counts the outflow
    std::optional<WearReader> wear_;      // for a film whose walls are coloured by wear
    std::optional<PictureParts> parts_;

    Pictures pictures_;
    std::size_t next_ = 0;  // index of the next picture
};

}  // namespace grainreel
