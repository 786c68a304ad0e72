// contacts.nc: who pushes whom, and how hard, at the moments of the trajectory. The number of contacts
// changes from frame to frame and classic NetCDF has one unlimited dimension, so the file is one long table:
// dimension `row`, columns frame (counts the trajectory's frames from 0), first, second (ids; a wall is -1 -
// its face), normal (N), tangential (N, on `second`), point (m) and checksum (XXH32 of the row's other
// numbers as they stand in memory, in this order). Forces and points are floats.
//
// In a scene with meshes `triangle` follows the point. It is the number of the mesh's triangle that is
// touched, counted from 0 as in trajectory.nc, or -1. A grain that touches several parts of a mesh has a row
// for each.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/file_facts.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/frame.hpp"

namespace grainreel {

class ContactsWriter {
  public:
    // Throws RunError when the file cannot be written.
    ContactsWriter(const std::filesystem::path& path, const std::string& title,
                   const std::string& program_version, const FileFacts& facts = {}, bool meshes = false);
    // Goes on with a file that is there, behind the contacts of the trajectory's first `frames`; what comes
    // after them is cut off. Throws UserError where the file is damaged.
    ContactsWriter(const std::filesystem::path& path, std::size_t frames);
    ~ContactsWriter();

    // How much stays of the file then. Throws UserError as above, and where it lacks some of these.
    static KeptRecords kept_of(const std::filesystem::path& path, std::size_t frames);

    // The rows are in the file when this returns. Throws RunError when they could not be written; those of
    // the frames before stay readable.
    void write(std::int64_t frame, const std::vector<ContactRecord>& contacts);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Forces between grains, frame by frame.
class ContactsReader {
  public:
    // Throws UserError when the file is missing, damaged or no contacts.nc. What a killed run left is read.
    explicit ContactsReader(const std::filesystem::path& path);
    ~ContactsReader();

    // Those of a frame of the trajectory, as they were written; none where has_all() is false. Throws
    // UserError, with the row, when one of them is damaged.
    std::vector<Touch> touches(std::size_t frame) const;
    // The same with their points and tangential forces.
    std::vector<ContactRecord> contacts(std::size_t frame) const;
    // False for the frames of a file that was cut off from the last one on that has rows: rows of it may be
    // missing.
    bool has_all(std::size_t frame) const;
    // How many rows the trajectory's first `frames` have.
    std::size_t rows_of_first(std::size_t frames) const;
    // Whether the end of the file is missing, so that the last frames lack contacts.
    bool cut_off() const;
    // Rows that lie in the file beyond those that its header counts.
    std::size_t uncounted() const;
    // False in a file of an earlier version: there damage may look like data.
    bool has_checksums() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
