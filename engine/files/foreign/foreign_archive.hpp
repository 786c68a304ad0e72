// A run of another program as a StateArchive: grains, contacts and walls from its files, in SI units. Four
// sources belong to it: foreign_files.cpp chooses the files, foreign_survey.cpp reads all moments once,
// foreign_walls.cpp follows walls, and foreign_archive.cpp does the rest. The formats are read elsewhere
// (raw_file.hpp); nothing here depends on a single format.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/grain_columns.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/raw_series.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/pose.hpp"

namespace grainreel {

// The walls at one moment. A file gives a surface either once, or again at each moment in its place at that
// moment.
struct WallMoment {
    std::optional<std::int64_t> step{};
    std::optional<double> time{};
    std::vector<RawWall> walls;
};

// A wall as a rigid body: its shape is kept once, and each moment has its pose.
struct MovingWall {
    std::string name;
    TriangleMesh shape;           // m, as it was at its first moment
    std::vector<BodyPose> poses;  // one for each WallMoment, with zero velocities
    bool moves = false;
    bool is_box = false;          // the sides of the box of the first frame
    std::vector<RawTable> cells;  // for each moment a row for each triangle; empty where there are none
};

// Follows the connected parts of each surface through all moments. Parts may move on their own, because
// LIGGGHTS writes all its meshes into one solid. A surface that changes its shape or its number of triangles
// stays as it was at first, with a line of news. unit: m. name: of the files, for news.
std::vector<MovingWall> follow_walls(const std::vector<WallMoment>& moments, double unit,
                                     const std::string& name, std::vector<std::string>& news);

// The rotation and displacement that move points to their present places, by least squares (Kabsch 1976, Acta
// Cryst. A 32, 922). residual: m, the largest distance that remains.
struct RigidMotion {
    BodyPose pose;
    double residual = 0;
};
RigidMotion rigid_motion(const std::vector<Vec3>& from, const std::vector<Vec3>& to);

// The rate of frames without times. Code that shows them says that this is not the time of the run.
inline constexpr double kUntimedRate = 25;  // 1/s

// Whether a path names files of other programs that can be read: a file, a pattern, or a folder with such
// files that is not a run of ours.
bool is_foreign(const std::filesystem::path& path);

class ForeignArchive final : public StateArchive {
  public:
    // The frames in which types are looked for. some: all frames of small files and 64 of others, so that a
    // question about one frame need not wait long. first: only the first frame with grains, for code that
    // reads all frames in order and calls take_types() before each. A frame with a type that was not found
    // throws UserError.
    enum class Looks { first, some };

    // path: a file, a pattern, or a folder. Throws UserError where nothing there can be read or its reader
    // finds something wrong.
    ForeignArchive(const std::filesystem::path& path, const ReadingOptions& options,
                   Looks looks = Looks::some);

    const std::filesystem::path& path() const override { return path_; }
    const StoredWorld& world() const override { return world_; }
    StateSupply supply() const override;
    const std::vector<State>& moments() const override { return moments_; }
    State grains(std::size_t index) const override;
    std::optional<std::vector<Link>> touches(std::size_t index) const override;
    bool has_contacts_of(std::size_t index) const override;
    std::optional<WorldCell> cell(std::size_t index) const override { return meaning_->cell(raw(index)); }
    std::optional<std::int64_t> written_step(std::size_t index) const override;
    std::vector<std::string> news() const override { return news_; }
    std::vector<std::string> news_of_frames() const override;

    // Looks for moments that were written since. Returns whether there is anything new; then the walls may be
    // others, and where steps and times depend on all moments, these too. Throws as RawSeries::grow() does.
    bool grow();
    // The number of moments to which nothing more can come. The last one may still be written.
    std::size_t whole_moments() const {
        return moments_.size() - (moments_.empty() || !grains_->moments().back().open ? 0 : 1);
    }

    // Adds the types of a frame, and of those beside it that its velocities come from, to the species of the
    // world. Returns whether any is new; then species that follow it have other numbers than before.
    bool take_types(std::size_t index);
    // The words that the files have for the types, in the order of the species.
    const std::vector<std::string>& types() const { return types_.words(); }
    // The first frame with grains; 0 where no frame has any.
    std::size_t first_with_grains() const { return first_with_grains_; }

    // The walls. Wall k is body kFirstPlaneBody + k.
    const std::vector<MovingWall>& walls() const { return walls_; }
    // The numbers of a wall's triangles at a moment, a row for each triangle; null where there are none.
    const RawTable* wall_cells(std::size_t index, std::size_t wall) const;
    const UnitSystem& units() const { return meaning_->units(); }
    // Whether there may be more to the walls with each moment.
    bool walls_come() const;
    // The name of the format: "LAMMPS text dump".
    const std::string& format() const { return grains_->facts().format; }
    // Whether State::step is the step of the files in all moments.
    bool keeps_steps() const;
    // How many contacts touches() left out so far: between walls, or without a finite force or ids.
    std::size_t contacts_passed_over() const { return contacts_passed_over_; }
    // Whether velocities are computed from the places of neighbouring moments.
    bool derived_velocities() const { return derived_; }

  private:
    void choose_files();
    void choose_from(const std::vector<std::filesystem::path>& files);
    void add_companions(const std::filesystem::path& file);
    std::vector<std::filesystem::path> contact_files() const;
    void find_walls();
    std::vector<std::filesystem::path> files_now(const std::vector<std::filesystem::path>& known) const;
    bool in_frames() const;
    void list_moments();
    void check_clock(const std::vector<double>& times) const;
    void survey();
    std::vector<std::size_t> looks() const;
    bool look_at(std::size_t index);
    void count_grains();
    void survey_contacts();
    std::optional<std::int64_t> step_for_contacts(const RawMoment& contacts, std::size_t moments) const;
    void check_contact_columns();
    void find_first_id_of_contacts();
    void make_world();
    void make_species();
    void name_walls();
    void read_walls();
    void add_box();
    void match_walls();
    static void rest_at_first(MovingWall& wall, std::size_t first);
    void decide_velocities();
    State read(std::size_t index) const;
    double usual_mass(const State& frame, std::size_t grain) const;
    void keep_gaps(std::size_t index, const Gaps& gaps) const;
    void derive_velocities(std::size_t index, State& frame) const;

    std::filesystem::path path_;
    ReadingOptions options_;
    Looks looks_;
    // The second is null where the grains' files have the contacts, or there are none.
    std::unique_ptr<RawSeries> grains_, contacts_;
    std::vector<std::vector<std::filesystem::path>> wall_files_;
    std::optional<GrainMeaning> meaning_;
    TypeList types_;
    StoredWorld world_;
    std::vector<State> moments_;
    std::vector<std::int64_t> raw_steps_;              // steps of the moments as in the files
    std::map<std::int64_t, std::size_t> contacts_at_;  // for each step: its place in contacts_
    std::vector<MovingWall> walls_;
    std::vector<WallMoment> wall_moments_;
    std::vector<std::vector<std::size_t>> wall_at_;  // for each moment and wall: the number of its pose
    bool has_contacts_ = false, derived_ = false;
    bool rows_of_contacts_from_0_ = false;  // contacts count the rows of grains without ids from 0
    bool alone_ = false;                    // whether a file is read without those of the same kind of name
    bool behind_ = false;                   // whether the files have grown and this object has not
    std::size_t first_with_grains_ = 0;
    std::vector<std::string> news_;
    mutable std::map<std::size_t, Gaps> gaps_;  // by the number of the frame; only where there are some
    mutable std::size_t contacts_passed_over_ = 0;
    // The frames that were read last, with their numbers: one, or three in a row where velocities come from
    // the frames beside each. Frame k is in slot k modulo their number.
    mutable std::array<std::optional<std::pair<std::size_t, RawFrame>>, 3> last_;
    const RawFrame& raw(std::size_t index) const;
};

}  // namespace grainreel
