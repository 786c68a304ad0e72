// A StateArchive holds the frames of a run on disk, whatever their format. They can be read in any order.
// Code that draws frames or answers questions takes them from here and need not know their format.
//
// A new format of frames as we keep them is a ReadFormat: a file in engine/files/frames/readers and a line
// in the list of open_frames.cpp. A format of another program is a RawFile
// (engine/files/foreign/raw_file.hpp).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

class FieldsReader;  // engine/files/fields_file.hpp
struct Scene;        // engine/scene/scene.hpp

// What the frames of an archive have beside ids, species, radii and places.
struct StateSupply {
    bool velocities = true;        // Frame::velocity; else they are zero
    bool spins = true;             // Frame::spin; else they are zero
    bool masses = false;           // Frame::mass
    bool orientations = false;     // Frame::orientation
    bool shapes = false;           // Frame::shape
    bool contact_numbers = false;  // Frame::contact_number
    bool contacts = false;         // touches()
    bool measures = false;         // measured_near()
};

// What the run's observers measured at one moment: a row of measures.csv.
struct MeasuredRow {
    double time = 0;  // s
    std::vector<std::string> columns;
    std::vector<double> values;  // NaN where nothing was measured
};

class StateArchive {
  public:
    virtual ~StateArchive() = default;

    // The path as the user gave it. Messages and run.json name it.
    virtual const std::filesystem::path& path() const = 0;
    virtual const StoredWorld& world() const = 0;
    virtual StateSupply supply() const = 0;

    // The moments of all frames, without their grains, by rising time. Every `index` below is a place in
    // this list. A time that is not known is NaN.
    virtual const std::vector<State>& moments() const = 0;
    // A whole frame, with grains and bodies. Throws DamagedFrame when the file is damaged there.
    virtual State grains(std::size_t index) const = 0;
    // Which bodies push each other at that moment; nothing where that is not known. Throws UserError where
    // the contacts are damaged.
    virtual std::optional<std::vector<Link>> touches(std::size_t) const { return std::nullopt; }
    // Whether all contacts of a moment are known.
    virtual bool has_contacts_of(std::size_t) const { return false; }
    // What was measured nearest to that moment; nothing where the run has no measures.
    virtual std::optional<MeasuredRow> measured_near(std::size_t) const { return std::nullopt; }
    // The box of a frame. In files of other programs it may change; elsewhere it is that of the world.
    virtual std::optional<WorldCell> cell(std::size_t) const { return world().cell; }
    // The step of a moment as the files have it; none where they have none. There State::step only orders the
    // moments.
    virtual std::optional<std::int64_t> written_step(std::size_t index) const {
        if (!world().steps_known) return std::nullopt;
        return moments()[index].step;
    }
    // Number of the moment's frame in the file, from 0. Frames that were left out count too.
    virtual std::size_t place(std::size_t index) const { return index; }

    // Number of periods of the drive after which the bed repeats itself.
    virtual int periods() const { return 1; }
    // The first moment of the run, from which displacements are counted; without grains where it is not
    // known.
    virtual State first() const { return moments().size() > 1 ? first_whole() : State(); }
    // The scene as it was run. Null for runs of other programs, and where the scene does not lie beside the
    // frames.
    virtual const Scene* scene() const { return nullptr; }

    // Why each damaged frame was left out of the moments.
    virtual std::vector<std::string> damage() const { return {}; }
    // What the user should know, a line each: what is damaged and what is missing.
    virtual std::vector<std::string> news() const { return damage(); }
    // What was noticed in the frames that were read so far, such as numbers that are none; a line each.
    virtual std::vector<std::string> news_of_frames() const { return {}; }

    // The contacts of touches() with their points and tangential forces, for export; nothing where these are
    // not known. Throws UserError where they are damaged.
    virtual std::optional<std::vector<SavedContact>> contacts(std::size_t) const { return std::nullopt; }
    // The fields on grids (fields.nc), for export; null where there are none. Throws UserError where they
    // are damaged.
    virtual std::shared_ptr<const FieldsReader> fields() const { return nullptr; }

    // Index of the moment nearest to a time (s). This function and those below need at least one moment.
    std::size_t nearest(double time) const;
    // Mean time (s) between two moments; 0 for a single one.
    double mean_interval() const;
    // s, the length of a step; 0 where it is not known.
    double step_length() const;
    // How far (s) a typed time may lie from a moment and still mean it (engine/base/typed_time.hpp).
    double room_beside(std::size_t index) const;
    // Indices of one in `every` of the moments from one typed time (s) to another.
    std::vector<std::size_t> between(std::optional<double> from, std::optional<double> to,
                                     std::int64_t every) const;
    // Throws UserError, with the option's name, for a time (s) outside the run, which ends at `last`. It may
    // lie `slack` outside.
    void check_time(const char* option, double time, double last, double slack) const;
    // As far outside a run as a time may lie. A run may end a little after its last frame, so this is the
    // time between frames. Messages show times with six digits, so these must be taken too.
    double usual_slack(double time) const { return mean_interval() + 1e-5 * std::abs(time); }
    // The first frame that is not damaged, with its grains.
    State first_whole() const;
};

// A frame without its grains.
State moment_of(const State& frame);

// The grains by rising id, as all frames have them.
State sorted_by_id(const State& frame);

// What a user says about files of other programs, where these do not say it themselves.
struct ReadingOptions {
    // --columns "radius=c_rad,type=mol": the file's column for a meaning. Meanings are id, type, x, y, z, vx,
    // vy, vz, wx, wy, wz, radius, diameter, density, mass, qw, qx, qy, qz, step, time, id1, id2, force.
    std::map<std::string, std::string> columns{};
    // --radius 2mm, or 1=2mm,2=5mm by type. m
    std::optional<double> radius{};
    std::map<std::string, double> radius_of_type{};
    std::optional<double> time_step{};  // --time-step, s
    std::string units{};                // --units lj|si|cgs|micro; empty: as the file says, else SI
    std::map<std::string, std::string> species{};  // --species "1=small,2=big": name of a type
    std::optional<double> density{};               // --density, kg/m3
    bool one = false;                              // --one: this file alone, without its series
    std::vector<std::string> contacts{};           // --contacts: files or patterns of contacts
    std::vector<std::string> walls{};              // --walls: files or patterns of surfaces
    std::optional<double> walls_scale{};           // m in one unit of the walls' files
    std::filesystem::path container{};             // --container scene.toml: its walls and its drive
    bool moves_with_container = false;             // --moves-with container
};

// Whether a path is a pattern (* ? [) and no file has that name.
inline bool is_pattern(const std::filesystem::path& path) {
    return path.string().find_first_of("*?[") != std::string::npos && !is_there(path);
}

// What lies under a path, and how its content begins.
struct FileStart {
    std::filesystem::path path;
    bool folder = false;
    std::uintmax_t size = 0;  // bytes
    std::string bytes;        // the first kHeadBytes of them
};
inline constexpr std::size_t kHeadBytes = 65536;

struct OpenRequest {
    // Name of the reader that must be used. Empty: the content of the file decides.
    std::string format{};
    // Reads the scene.toml of a run's folder. None: it is read as the engine reads it.
    std::function<Scene(const std::filesystem::path& folder)> scene_of_run{};
    // What the user says about files of other programs.
    ReadingOptions reading{};
};

struct ReadFormat {
    const char* name;   // "trajectory"
    const char* about;  // "a trajectory.nc of a run", for the list of what can be read
    // Whether this reader reads such a file. The content decides, not the name.
    bool (*takes)(const FileStart& head);
    // Throws UserError when the file cannot be read.
    std::unique_ptr<StateArchive> (*open)(const std::filesystem::path& path, const OpenRequest& request);
};

}  // namespace grainreel
