// A record of frames that lies on disk, in whichever format: it can be read in any order, as often as one
// likes. Who draws, asks or counts takes frames from here and need not know where they come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frame_faults.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/frame.hpp"

namespace grainreel {

class FieldsReader;  // engine/files/fields_file.hpp

// What the frames of a record have beside ids, species, radii and places.
struct FrameSupply {
    bool velocities = true;        // Frame::velocity; else they are zero
    bool spins = true;             // Frame::spin; else they are zero
    bool orientations = false;     // Frame::orientation
    bool contact_numbers = false;  // Frame::contact_number
    bool contacts = false;         // touches()
    bool measures = false;         // measured_near()

    // "velocities", "contacts": what it has not.
    std::vector<std::string> lacks() const;
};

// What the run's observers measured (columns of measures.csv).
struct MeasuredRow {
    double time = 0;  // s
    std::vector<std::string> columns;
    std::vector<double> values;  // NaN: none
};

class FrameArchive {
  public:
    virtual ~FrameArchive() = default;

    // As it was given; messages and run.json name it.
    virtual const std::filesystem::path& path() const = 0;
    virtual const World& world() const = 0;
    virtual FrameSupply supply() const = 0;

    // The moments that are kept, without their grains, by rising time. An index below is a place in this
    // list. Where the time is not known it is NaN.
    virtual const std::vector<Frame>& moments() const = 0;
    // Grains and bodies, as they were kept. Throws DamagedFrame when the file is damaged there.
    virtual Frame grains(std::size_t index) const = 0;
    // Which bodies push each other then; nothing where that is not known. Throws UserError where it is
    // damaged.
    virtual std::optional<std::vector<Touch>> touches(std::size_t) const { return std::nullopt; }
    // Whether all contacts of a moment are known.
    virtual bool has_contacts_of(std::size_t) const { return false; }
    // What was measured about then; nothing where it does not lie beside the moments.
    virtual std::optional<MeasuredRow> measured_near(std::size_t) const { return std::nullopt; }
    // The number that the moment's frame has in the file, from 0; those that were left out count.
    virtual std::size_t place(std::size_t index) const { return index; }

    // Periods of the drive after which the bed repeats itself.
    virtual int periods() const { return 1; }
    // The first moment that there was, from which ways are counted; without grains where it is not known.
    virtual Frame first() const { return moments().size() > 1 ? first_whole() : Frame(); }
    // The scene as it was used. Null for records that are not ours, and where it does not lie beside them.
    virtual const Scene* scene() const { return nullptr; }

    // Why each damaged frame was left out of the moments.
    virtual std::vector<std::string> damage() const { return {}; }
    // What the user is to know of it, a line each: damage, and what there is not.
    virtual std::vector<std::string> news() const { return damage(); }

    // What only other formats want. The contacts of touches() with their points and tangential forces;
    // nothing where these are not known. Throws UserError where they are damaged.
    virtual std::optional<std::vector<ContactRecord>> contacts(std::size_t) const { return std::nullopt; }
    // Means on grids that were kept beside the frames; null where there are none. Throws UserError where they
    // are damaged.
    virtual std::shared_ptr<const FieldsReader> fields() const { return nullptr; }

    // All of these need a moment.
    std::size_t nearest(double time) const;  // s
    // Grains of the first frame that is not damaged.
    Frame first_whole() const;
    // Those before `index` that reach no further back than `duration` (s): what its trails go through.
    std::vector<std::size_t> before(std::size_t index, double duration) const;
};

// A frame without its grains.
Frame moment_of(const Frame& frame);

// What a user says of files of other programs, where these do not say it themselves.

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

// Paths that name many files.

// Whether a text is a pattern (* ? [) and no file has that name.
inline bool is_pattern(const std::filesystem::path& path) {
    std::error_code ignored;
    return path.string().find_first_of("*?[") != std::string::npos && !std::filesystem::exists(path, ignored);
}

// What reads one format of frames. A reader is a file in engine/files/frames/readers and a line in the list
// of open_frames.cpp.

// What lies under a name, and how it begins.
struct FileHead {
    std::filesystem::path path;
    bool folder = false;
    std::uintmax_t size = 0;  // bytes
    std::string bytes;        // the first kHeadBytes of them
};
inline constexpr std::size_t kHeadBytes = 65536;

struct FrameRequest {
    // The name of the reader, for who knows what a file must be; empty: its content decides.
    std::string format{};
    // Reads the scene.toml of a run's folder; none: as the engine reads it.
    std::function<Scene(const std::filesystem::path& folder)> scene_of_run{};
    // What the user says of files of other programs.
    ReadingOptions reading{};
};

struct FrameReader {
    const char* name;   // "trajectory"
    const char* about;  // "a trajectory.nc of a run", for the list of what can be read
    // By content: the name of a file says nothing.
    bool (*takes)(const FileHead& head);
    // Throws UserError when it cannot be read.
    std::unique_ptr<FrameArchive> (*open)(const std::filesystem::path& path, const FrameRequest& request);
};

}  // namespace grainreel
