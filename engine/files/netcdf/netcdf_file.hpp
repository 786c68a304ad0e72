// Writes and reads classic NetCDF files, whose records are written one after the other. A file stays readable
// when the program is killed or the disk is full, and it is checked before the library reads it. All NetCDF
// files of runs go through this class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

// The header of a classic NetCDF file (CDF-1, 2 and 5). It is read and checked before the library opens the
// file. The library trusts a header: it asks for as much memory as a count says, and it reads zeros beyond
// the end of a file that was cut off.
struct NetcdfHeader {
    std::uint64_t begin = 0;   // bytes before the first record, or of the whole file without records
    std::uint64_t record = 0;  // bytes of a record, or 0 where no variable has records
    int count_bytes = 4;       // of the count of records, which stands at byte 4
};

// Checks every count, name, type and offset against the format and the file's size. Throws UserError when the
// file cannot be opened, is not of a classic format or has a header that contradicts itself.
NetcdfHeader read_netcdf_header(const std::filesystem::path& path);

// How much of a file stays when the run that wrote it is continued.
struct KeptRecords {
    std::size_t records = 0;
    std::uintmax_t bytes = 0;  // up to the end of these records
};

// In CDF-2 a variable may have up to 4 GiB in a record; in CDF-5 any size.
enum class NetcdfFormat { cdf2, cdf5 };

class NetcdfFile {
  public:
    // Makes a file in define mode, in place of what had its name; a link is not followed. There are no fill
    // values: every variable of a record must be written.
    static NetcdfFile create(const std::filesystem::path& path, NetcdfFormat format);
    // Opens a file that create() made and continues it after its first `records`; later ones are cut off.
    // Throws UserError when there are fewer or where open() does, and RunError when it cannot be written.
    static NetcdfFile append(const std::filesystem::path& path, std::size_t records);
    // How many bytes the file has up to the end of its first `records`. Throws UserError as append() does.
    static KeptRecords kept_of(const std::filesystem::path& path, std::size_t records);
    // Writes the count of records into the header of a file that was cut off. Does nothing where it cannot.
    static void count_records(const std::filesystem::path& path, std::size_t records);
    // Opens a file for reading. Throws UserError when it is missing, is no classic NetCDF file or has a
    // damaged header.
    static NetcdfFile open(const std::filesystem::path& path);
    // Opens a file of another program: as open() does, or one of NetCDF-4, which is HDF5. The library trusts
    // an HDF5 file; so the caller tries all that is to be read first (hdf5_trial.hpp).
    static NetcdfFile open_any(const std::filesystem::path& path);
    // Reads the variables of this group from now on, where the file has it. Classic files have no groups.
    void enter(const std::string& group);
    bool has_group(const std::string& group) const;

    ~NetcdfFile();
    NetcdfFile(NetcdfFile&& other) noexcept;
    NetcdfFile& operator=(NetcdfFile&&) = delete;

    int dimension(const std::string& name, std::size_t length);  // NC_UNLIMITED: the dimension of records
    // units: empty for none. Types are those of <netcdf.h>: NC_INT, NC_FLOAT, NC_DOUBLE, NC_CHAR.
    int variable(const std::string& name, int type, const std::vector<int>& dimensions,
                 const std::string& units = {});
    // variable: NC_GLOBAL for an attribute of the file itself.
    void attribute(int variable, const std::string& name, const std::string& text);
    void end_definitions();

    int find_variable(const std::string& name) const;  // throws UserError when there is none
    bool has_variable(const std::string& name) const;
    std::vector<std::string> variables() const;                  // names in the order of the file
    std::vector<std::string> dimensions_of(int variable) const;  // names; the last runs fastest
    int type_of(int variable) const;                             // NC_FLOAT and so on
    bool has_dimension(const std::string& name) const;
    std::size_t length(const std::string& dimension) const;  // throws UserError when there is none
    std::string text_attribute(int variable, const std::string& name) const;  // empty when there is none
    // An attribute that is one number; none where it is another thing.
    std::optional<double> number_attribute(int variable, const std::string& name) const;
    // Whether a file that is read has variables with records. An HDF5 file has none.
    bool has_records() const { return header_.record > 0; }
    const NetcdfHeader& header() const { return header_; }
    // Number of whole records in a file that is read, whatever its header counts.
    std::size_t whole_records() const;
    // Number of bytes behind the last record for which there is room.
    std::uint64_t bytes_behind_records() const;
    // The same for a file that may still be written. There are fewer than `counted` when the file was cut off
    // and more when the count is damaged. The library counts a record shortly before it writes it; so this
    // waits a little where there are fewer and the file was just written.
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

    // Called when all that was written belongs to whole records. A program that is killed later leaves these
    // `records`. Throws RunError when this fails or somebody has removed the file.
    void sync(std::size_t records);

  private:
    NetcdfFile(const std::filesystem::path& path, int id, bool writing)
        : path_(path), file_id_(id), id_(id), writing_(writing) {}
    // Notes a failed write and throws RunError.
    void wrote(int status);
    template <class Function, class Value>
    void get_by(Function read, int variable, const std::vector<std::size_t>& start,
                const std::vector<std::size_t>& count, Value* values) const;
    void close() noexcept;

    std::filesystem::path path_;
    int file_id_ = -1;
    int id_ = -1;  // of the group that is read; of the file itself in classic files
    bool writing_ = false;
    bool failed_ = false;
    std::size_t records_ = 0;  // number of whole records
    NetcdfHeader header_;      // only of a file that is read
};

std::string netcdf_version();  // version of the library, as "4.9.0"

}  // namespace grainreel
