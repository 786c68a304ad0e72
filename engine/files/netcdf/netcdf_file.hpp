// A classic NetCDF file whose records are written one after the other, and that stays readable whatever
// happens.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/netcdf/netcdf_header.hpp"

namespace grainreel {

// How much of a NetCDF file stays when the run that wrote it goes on.

struct KeptRecords {
    std::size_t records = 0;
    std::uintmax_t bytes = 0;  // of the file up to there
};

// CDF-2 holds records of up to 4 GiB a variable; CDF-5 any.
enum class NetcdfFormat { cdf2, cdf5 };

class NetcdfFile {
  public:
    // Makes the file, in define mode, without fill values: every variable of a record must be written. What
    // had its name goes; a link is not followed.
    static NetcdfFile create(const std::filesystem::path& path, NetcdfFormat format);
    // Opens one that create() made, to write on behind its first `records`; whatever comes behind them is cut
    // off. Throws UserError when there are fewer, or as open() does, and RunError when it cannot be written.
    static NetcdfFile append(const std::filesystem::path& path, std::size_t records);
    // How much of such a file that is. Throws UserError as above.
    static KeptRecords kept_of(const std::filesystem::path& path, std::size_t records);
    // Puts the count of records into a file that was cut off. Does nothing where it cannot.
    static void count_records(const std::filesystem::path& path, std::size_t records);
    // Opens it for reading. Throws UserError when it is missing, no classic NetCDF file, or its header is
    // damaged.
    static NetcdfFile open(const std::filesystem::path& path);

    ~NetcdfFile();
    NetcdfFile(NetcdfFile&& other) noexcept;
    NetcdfFile& operator=(NetcdfFile&&) = delete;

    int dimension(const std::string& name, std::size_t length);  // length NC_UNLIMITED: the records
    // units: empty for none. Types are those of <netcdf.h>: NC_INT, NC_FLOAT, NC_DOUBLE, NC_CHAR.
    int variable(const std::string& name, int type, const std::vector<int>& dimensions,
                 const std::string& units = {});
    void attribute(int variable, const std::string& name,
                   const std::string& text);  // variable NC_GLOBAL: the file's
    void end_definitions();

    int find_variable(const std::string& name) const;  // UserError when there is none
    bool has_variable(const std::string& name) const;
    std::vector<std::string> variables() const;                  // their names, in the file's order
    std::vector<std::string> dimensions_of(int variable) const;  // names; the last one runs fastest
    std::size_t length(const std::string& dimension) const;      // UserError when there is none
    std::string text_attribute(int variable, const std::string& name) const;  // empty when there is none
    bool has_records() const {
        return header_.record > 0;
    }  // whether a dimension of the file read is unlimited
    // How many whole records lie in the file that is read, whatever its header counts: fewer when it was cut
    // off, more when the count is damaged. Waits a little where fewer than `counted` lie there and the file
    // was written a moment ago: the library counts a record shortly before it writes it.
    std::size_t records_on_disk(std::size_t counted) const;

    void put(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             const int* values);
    void put(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             const float* values);
    void put(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             const double* values);
    void put(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             const char* values);
    void get(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             int* values) const;
    void get(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             float* values) const;
    void get(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             double* values) const;

    // All written so far belongs to whole records: from here a killed program leaves `records` of them.
    // Throws RunError when that fails, or when somebody has removed the file.
    void sync(std::size_t records);

  private:
    NetcdfFile(const std::filesystem::path& path, int id, bool writing)
        : path_(path), id_(id), writing_(writing) {}
    std::size_t whole_records() const;
    // Notes a failed write and throws RunError.
    void wrote(int status);
    template <class Function, class Value>
    void get_by(Function read, int variable, const std::vector<std::size_t>& start,
                const std::vector<std::size_t>& count, Value* values) const;
    void close() noexcept;

    std::filesystem::path path_;
    int id_ = -1;
    bool writing_ = false;
    bool failed_ = false;
    std::size_t records_ = 0;  // whole ones
    NetcdfHeader header_;      // of a file that is read
};

std::string netcdf_version();  // of the library, "4.9.0"

}  // namespace grainreel
