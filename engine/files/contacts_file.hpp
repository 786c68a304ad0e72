// contacts.nc: the contacts of all frames of the trajectory, with their forces. The number of contacts
// changes from frame to frame and classic NetCDF has only one unlimited dimension, so the file is one long
// table.
//
// Its dimension is `row`. Its columns are frame (number of the trajectory's frame, from 0), first and second
// (ids of grains; a wall is -1 minus its number), normal (N), tangential (N, on `second`), point (m) and
// checksum (XXH32 of the row's other numbers as they stand in memory, in this order). Forces and points are
// floats. In a scene with meshes `triangle` follows the point: the number of the triangle that is touched,
// counted from 0 as in trajectory.nc, or -1. Where contacts resist rolling, `rolling` follows: the torque on
// `second` (N m, floats). A grain that touches several parts of a mesh has a row for each.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/file_facts.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/state/contact.hpp"

namespace grainreel {

class ContactsWriter {
  public:
    // Throws RunError when the file cannot be written.
    ContactsWriter(const std::filesystem::path& path, const std::string& title,
                   const std::string& program_version, const FileFacts& facts = {}, bool meshes = false,
                   bool rolls = false);
    // Continues a file. The contacts of the trajectory's first `frames` frames stay, and later rows are cut
    // off. Throws UserError where the file is damaged.
    ContactsWriter(const std::filesystem::path& path, std::size_t frames);
    ~ContactsWriter();

    // How much of the file stays if it is continued. Throws UserError as above, and where some of these rows
    // are missing.
    static KeptRecords kept_of(const std::filesystem::path& path, std::size_t frames);

    // The rows are in the file when this returns. Throws RunError when they could not be written; the rows of
    // earlier frames stay readable.
    void write(std::int64_t frame, const std::vector<SavedContact>& contacts);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Reads the contacts frame by frame.
class ContactsReader {
  public:
    // Throws UserError when the file is missing, damaged or not a contacts.nc. A file of a run that was
    // killed can be read.
    explicit ContactsReader(const std::filesystem::path& path);
    ~ContactsReader();

    // The contacts of a frame of the trajectory, as they were written; none where has_all() is false. Throws
    // UserError that names the row when one is damaged.
    std::vector<Link> touches(std::size_t frame) const;
    // The same with points and tangential forces.
    std::vector<SavedContact> contacts(std::size_t frame) const;
    // Whether all contacts of the frame are in the file. In a file that was cut off, contacts may be missing
    // from the last frame that has rows and from all later frames.
    bool has_all(std::size_t frame) const;
    // Number of rows of the trajectory's first `frames` frames.
    std::size_t rows_of_first(std::size_t frames) const;
    // Whether the end of the file is missing, so that contacts of the last frames are missing too.
    bool cut_off() const;
    // Number of rows in the file beyond those that its header counts.
    std::size_t uncounted() const;
    // False for a file of an earlier version. Damage in it may go unnoticed.
    bool has_checksums() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
