// A run of another program as a record of frames: grains, contacts and walls from its files, in SI.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/foreign_walls.hpp"
#include "engine/files/foreign/grain_columns.hpp"
#include "engine/files/foreign/raw_series.hpp"
#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

// Frames without times come so many to a second; whoever shows them says that it is no time of the run.
inline constexpr double kUntimedRate = 25;  // 1/s

// Whether some reader of other programs' files takes what has that name: a file, a pattern, or a folder with
// such files that is no run of ours.
bool is_foreign(const std::filesystem::path& path);

class ForeignArchive final : public FrameArchive {
  public:
    // How many frames are looked at for the types that there are. some: all of small files, and 64 of others,
    // so that a question to one frame need not wait; a frame with another type throws UnknownType.
    enum class Looks { some, all };

    // path: a file, a pattern, or a folder. Throws UserError where nothing there can be read, and for what
    // its reader finds wrong.
    ForeignArchive(const std::filesystem::path& path, const ReadingOptions& options,
                   Looks looks = Looks::some);

    const std::filesystem::path& path() const override { return path_; }
    const World& world() const override { return world_; }
    FrameSupply supply() const override;
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override;
    std::optional<std::vector<Touch>> touches(std::size_t index) const override;
    bool has_contacts_of(std::size_t) const override { return has_contacts_; }
    std::vector<std::string> news() const override { return news_; }

    // Walls by their bodies, from kFirstPlaneBody on.
    const std::vector<MovingWall>& walls() const { return walls_; }
    // What a wall says of its triangles at a moment, a row each; null where it says nothing.
    const RawTable* wall_cells(std::size_t index, std::size_t wall) const;
    const UnitSystem& units() const { return meaning_->units(); }
    // All files that were read.
    const std::vector<std::filesystem::path>& files() const { return all_files_; }
    // "LAMMPS text dump".
    const std::string& format() const { return grains_->facts().format; }
    // Velocities come from the places of neighbouring moments.
    bool derived_velocities() const { return derived_; }

  private:
    void choose_files();
    void choose_from(const std::vector<std::filesystem::path>& files);
    void add_companions(const std::filesystem::path& file);
    void list_moments();
    void survey();
    std::size_t most_looks() const;
    void survey_contacts();
    void check_contact_columns();
    void make_world();
    void read_walls();
    void add_box();
    void match_walls();
    static void rest_at_first(MovingWall& wall, std::size_t first);
    void decide_velocities();
    Frame read(std::size_t index) const;
    void derive_velocities(std::size_t index, Frame& frame) const;

    std::filesystem::path path_;
    ReadingOptions options_;
    Looks looks_;
    std::unique_ptr<RawSeries> grains_,
        contacts_;  // contacts: null where the grains' files have them, or nobody
    std::vector<std::vector<std::filesystem::path>> wall_files_;
    std::vector<std::filesystem::path> all_files_;
    std::optional<GrainMeaning> meaning_;
    TypeList types_;
    World world_;
    std::vector<Frame> moments_;
    std::vector<std::int64_t> raw_steps_;              // of the moments, as the files have them
    std::map<std::int64_t, std::size_t> contacts_at_;  // step -> its place in contacts_
    std::vector<MovingWall> walls_;
    std::vector<WallMoment> wall_moments_;
    std::vector<std::vector<std::size_t>> wall_at_;  // of each moment and wall: which of its poses
    bool has_contacts_ = false, derived_ = false;
    std::vector<std::string> news_;
    mutable std::optional<std::pair<std::size_t, RawFrame>>
        last_;  // read last: grains and contacts of one moment
    const RawFrame& raw(std::size_t index) const;
};

}  // namespace grainreel
