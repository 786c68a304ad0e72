// fields.nc: what observers give on grids, record by record, as classic NetCDF with the names and attributes
// of the CF conventions (1.8), so that xarray, ParaView and others open it.
//
// Dimensions are `time` (records, the middle of each) with `time_bounds`, and the axes of the grids. A name
// that two observers have for axes that differ gets a number for the second of them. Every record has a
// checksum.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/file_facts.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/measure/measures.hpp"

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

// fields.nc (engine/files/fields_file.hpp) read record by record: those fields whose axes are places.

class FieldsReader {
  public:
    // The middles of the cells along x, y and z (m). An axis that the fields are means along has none.
    using Middles = std::array<std::vector<double>, 3>;

    // Throws UserError when the file is missing, damaged or no fields.nc, or its cells are not evenly spaced.
    // What a killed run left is read.
    explicit FieldsReader(const std::filesystem::path& path);
    ~FieldsReader();

    const Middles& middles() const;
    // Size of a cell along each axis, m; 0 where the fields are means along that axis.
    std::array<double, 3> cell() const;
    const std::vector<std::string>& names() const;  // "density"
    std::size_t records() const;
    std::array<double, 2> span(std::size_t record) const;  // s, where the record begins and ends

    // A list of values a name, x running fastest, then y; NaN where there is none. Throws UserError where the
    // record's checksum is not that of its numbers.
    std::vector<std::vector<double>> read(std::size_t record) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
