// A record of frames that lies on disk, in whichever format: it can be read in any order, as often as one
// likes. Who draws, asks or counts takes frames from here and need not know where they come from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frame_faults.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/frame.hpp"
#include "engine/state/contact_record.hpp"

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

}  // namespace grainreel
