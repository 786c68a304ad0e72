// fields.nc: means on grids, written record by record and read again. A record is a mean over a span of time.
// The file is classic NetCDF with names and attributes of the CF conventions (1.8), so that xarray, ParaView
// and other programs open it.
//
// Its dimensions are `time` (the middle of each record) with `time_bounds`, and the axes of the grids. Where
// two observers have different axes of the same name, the name of the second gets a number. Every record has
// a checksum.
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
    // Continues a file that was written with these sets. The records that end before `time` (s) stay, and
    // later ones are cut off.
    FieldsWriter(const std::filesystem::path& path, const std::vector<const FieldSet*>& sets, double time);
    // Number of records that end before `time`, and how much of the file they are. Throws UserError where the
    // file is damaged or was written with other sets.
    static std::size_t records_before(const std::filesystem::path& path, double time);
    static KeptRecords kept_before(const std::filesystem::path& path,
                                   const std::vector<const FieldSet*>& sets, double time);
    ~FieldsWriter();

    // Writes a record: the means from `begin` to `end` (s), set by set. It is in the file when this returns.
    // Throws RunError when it could not be written (disk full); earlier records stay readable.
    void write(double begin, double end, const std::vector<FieldValues>& values);

    std::int64_t records() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Reads those fields whose axes are all places, record by record.
class FieldsReader {
  public:
    // The middles of the cells along x, y and z (m). Where the fields are means along an axis, it has none.
    using Middles = std::array<std::vector<double>, 3>;

    // Throws UserError when the file is missing, damaged or not a fields.nc, or when its cells are not evenly
    // spaced. A file of a run that was killed can be read.
    explicit FieldsReader(const std::filesystem::path& path);
    ~FieldsReader();

    const Middles& middles() const;
    // Size of a cell along each axis in m, or 0 where the fields are means along that axis.
    std::array<double, 3> cell() const;
    const std::vector<std::string>& names() const;  // "density"
    std::size_t records() const;
    std::array<double, 2> span(std::size_t record) const;  // s, when the record begins and ends

    // A list of values for each name; x runs fastest, then y. NaN where there is no value. Throws UserError
    // where the record's checksum does not fit its numbers.
    std::vector<std::vector<double>> read(std::size_t record) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
