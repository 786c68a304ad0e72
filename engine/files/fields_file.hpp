// fields.nc: what observers give on grids, record by record, as classic NetCDF with the names and attributes
// of the CF conventions (1.8), so that xarray, ParaView and others open it.
//
// Dimensions are `time` (records, the middle of each) with `time_bounds`, and the axes of the grids. A name
// that two observers have for axes that differ gets a number for the second of them. Every record has a
// checksum.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/file_facts.hpp"
#include "engine/files/netcdf/kept_records.hpp"
#include "engine/measure/field.hpp"

namespace grainreel {

class FieldsWriter {
  public:
    // Throws RunError when the file cannot be made.
    FieldsWriter(const std::filesystem::path& path, const std::vector<const FieldSet*>& sets,
                 const std::string& title, const std::string& program_version, const FileFacts& facts = {});
    // Goes on with a file that was written with these sets, behind the records that end before `time` (s);
    // what comes after them is cut off.
    FieldsWriter(const std::filesystem::path& path, const std::vector<const FieldSet*>& sets, double time);
    // How many records such a file has that end before `time`, and how much of the file these are. Throws
    // UserError where it is damaged, or was written with other sets.
    static std::size_t records_before(const std::filesystem::path& path, double time);
    static KeptRecords kept_before(const std::filesystem::path& path,
                                   const std::vector<const FieldSet*>& sets, double time);
    ~FieldsWriter();

    // What is the mean of the time from `begin` to `end` (s), set by set. It is in the file when this
    // returns. Throws RunError when it could not be written (disk full); the records before stay readable.
    void write(double begin, double end, const std::vector<FieldValues>& values);

    std::int64_t records() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
