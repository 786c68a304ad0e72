// A single state of a run, without the run's folder: a checkpoint, or the table of grains of a final.csv.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/text/assignment.hpp"
#include "render/run/frames/record.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class SavedState final : public Record {
  public:
    // sets: changes to the scene as for a RecordedRun. A checkpoint holds its scene. A table of grains takes
    // that of the scene.toml beside it; without one its species are "type 1", "type 2" and so on, of unknown
    // density, in no container. Throws UserError when the file cannot be read.
    SavedState(const std::filesystem::path& file, const Assignments& sets);

    const FilmedScene& scene() const override { return scene_; }
    Supply supply() const override { return {false, false, false, !frame_.orientation.empty()}; }
    Span span() const override { return {frame_.time, frame_.time}; }
    const FrameArchive* archive() const override { return this; }
    std::vector<Frame> moments(const Pictures& pictures) const override;
    void start(const Pictures& pictures) override { pictures_ = pictures; }
    std::optional<Taken> next(const GoOn& go_on) override;
    std::vector<std::string> news() const override { return news_; }

    const std::filesystem::path& folder() const override { return file_; }
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t) const override { return frame_; }
    Frame frame(std::size_t) const override { return frame_; }
    int periods() const override { return 1; }
    const Clock& clock() const override { return clock_; }
    std::vector<KeptCheckpoint> checkpoints() const override { return checkpoints_; }
    bool has_contacts_of(std::size_t) const override { return false; }
    Frame first() const override { return Frame(); }
    std::optional<MeasuredRow> measured_near(std::size_t) const override { return measured_; }

  private:
    void read_checkpoint(const Assignments& sets);
    void read_table(const Assignments& sets);
    void check_all_are_there() const;

    std::filesystem::path file_;
    FilmedScene scene_;
    Frame frame_;
    std::vector<Frame> moments_;  // its moment, without grains
    Clock clock_;
    std::vector<KeptCheckpoint> checkpoints_;  // itself
    std::optional<MeasuredRow> measured_;
    std::vector<std::string> news_;
    Pictures pictures_;
    std::size_t next_ = 0;  // of them
};

}  // namespace grainreel
