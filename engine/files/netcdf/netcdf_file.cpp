#include "engine/files/netcdf/netcdf_file.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <unistd.h>
#include <array>
#include <chrono>
#include <cstdint>
#include <system_error>
#include <thread>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/netcdf/hdf5_trial.hpp"

namespace grainreel {

namespace {

// Bytes of the buffer. With the library's default of 8 KiB there are many small writes.
constexpr std::size_t buffer_size = 1 << 20;

// Writes the true number of records into the header. It stands after the magic "CDF" and the version byte:
// four bytes, big-endian, or eight in CDF-5 (NetCDF classic format specification). After a write that failed
// half-way the library's count includes the broken record.
void set_record_count(const std::filesystem::path& path, std::size_t records) {
    const int file = open_plain(path, O_RDWR);
    if (file < 0) return;
    std::array<char, 4> magic{};
    if (::pread(file, magic.data(), magic.size(), 0) == ssize_t{magic.size()}) {
        const std::size_t width = magic[3] == 5 ? 8 : 4;
        std::array<char, 8> count{};
        for (std::size_t i = 0; i < width; ++i)
            count[i] =
                static_cast<char>((static_cast<std::uint64_t>(records) >> (8 * (width - 1 - i))) & 0xff);
        [[maybe_unused]] const ssize_t ignored = ::pwrite(file, count.data(), width, magic.size());
    }
    ::close(file);
}

void known(int status, const std::filesystem::path& path) {
    if (status != NC_NOERR) throw UserError("{}: cannot be read: {}", path.string(), nc_strerror(status));
}

}  // namespace

NetcdfFile NetcdfFile::create(const std::filesystem::path& path, NetcdfFormat format) {
    make_way(path);
    const int mode = NC_NOCLOBBER | (format == NetcdfFormat::cdf5 ? NC_64BIT_DATA : NC_64BIT_OFFSET);
    int id = -1;
    std::size_t buffer = buffer_size;
    if (const int status = nc__create(path.c_str(), mode, 0, &buffer, &id); status != NC_NOERR) {
        throw RunError("{}: cannot be written: {}", path.string(), nc_strerror(status));
    }
    NetcdfFile file(path, id, true);
    int old_mode = 0;
    file.wrote(nc_set_fill(id, NC_NOFILL, &old_mode));
    return file;
}

KeptRecords NetcdfFile::kept_of(const std::filesystem::path& path, std::size_t records) {
    const NetcdfHeader header = read_netcdf_header(path);
    std::error_code error;
    const std::uintmax_t end = header.begin + header.record * records;
    if ((records > 0 && end > std::filesystem::file_size(path, error)) || error)
        throw UserError("{}: was cut off; it lacks some of its first {} records", path.string(), records);
    return {records, end};
}

void NetcdfFile::count_records(const std::filesystem::path& path, std::size_t records) {
    set_record_count(path, records);
}

NetcdfFile NetcdfFile::append(const std::filesystem::path& path, std::size_t records) {
    const std::uintmax_t end = kept_of(path, records).bytes;
    if (const std::string other = other_than_file(path, false); !other.empty())
        throw RunError("{}: cannot be written: it is {}", path.string(), other);
    std::error_code error;
    // The order matters. A program that is killed in between leaves records that are not counted, and a
    // reader can tell these from a file that was cut off.
    set_record_count(path, records);
    std::filesystem::resize_file(path, end, error);
    if (error) throw RunError("{}: cannot be written: {}", path.string(), error.message());
    int id = -1;
    std::size_t buffer = buffer_size;
    if (const int status = nc__open(path.c_str(), NC_WRITE, &buffer, &id); status != NC_NOERR)
        throw RunError("{}: cannot be written: {}", path.string(), nc_strerror(status));
    NetcdfFile file(path, id, true);
    file.records_ = records;
    int old_mode = 0;
    file.wrote(nc_set_fill(id, NC_NOFILL, &old_mode));
    return file;
}

NetcdfFile NetcdfFile::open(const std::filesystem::path& path) {
    const NetcdfHeader header = read_netcdf_header(path);
    int id = -1;
    known(nc_open(path.c_str(), NC_NOWRITE, &id), path);
    NetcdfFile file(path, id, false);
    file.header_ = header;
    return file;
}

NetcdfFile NetcdfFile::open_any(const std::filesystem::path& path) {
    if (!is_hdf5(path)) return open(path);
    check_hdf5(path);
    int id = -1;
    if (const int status = nc_open(path.c_str(), NC_NOWRITE, &id); status != NC_NOERR)
        throw UserError("{}: is HDF5, but the library of NetCDF cannot read it ({})", path.string(),
                        nc_strerror(status));
    return NetcdfFile(path, id, false);
}

void NetcdfFile::enter(const std::string& group) {
    int id = -1;
    if (nc_inq_grp_ncid(file_id_, group.c_str(), &id) == NC_NOERR) id_ = id;
}

bool NetcdfFile::has_group(const std::string& group) const {
    int id = -1;  // the library finds any group in a classic file
    return is_hdf5(path_) && nc_inq_grp_ncid(file_id_, group.c_str(), &id) == NC_NOERR;
}

NetcdfFile::NetcdfFile(NetcdfFile&& other) noexcept
    : path_(std::move(other.path_)),
      file_id_(std::exchange(other.file_id_, -1)),
      id_(other.id_),
      writing_(other.writing_),
      failed_(other.failed_),
      records_(other.records_),
      header_(other.header_) {}

NetcdfFile::~NetcdfFile() {
    close();
}

void NetcdfFile::close() noexcept {
    if (file_id_ < 0) return;
    const bool broken = nc_close(file_id_) != NC_NOERR || failed_;
    if (writing_ && broken) set_record_count(path_, records_);
}

void NetcdfFile::wrote(int status) {
    if (status == NC_NOERR) return;
    failed_ = true;
    throw RunError("{}: cannot be written: {}; the {} records before stay readable", path_.string(),
                   nc_strerror(status), records_);
}

int NetcdfFile::dimension(const std::string& name, std::size_t length) {
    int id = -1;
    wrote(nc_def_dim(id_, name.c_str(), length, &id));
    return id;
}

int NetcdfFile::variable(const std::string& name, int type, const std::vector<int>& dimensions,
                         const std::string& units) {
    int id = -1;
    wrote(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
    if (!units.empty()) attribute(id, "units", units);
    return id;
}

void NetcdfFile::attribute(int variable, const std::string& name, const std::string& text) {
    wrote(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.c_str()));
}

void NetcdfFile::end_definitions() {
    wrote(nc_enddef(id_));
}

int NetcdfFile::find_variable(const std::string& name) const {
    int id = -1;
    if (nc_inq_varid(id_, name.c_str(), &id) != NC_NOERR) {
        throw UserError("{}: has no variable `{}`", path_.string(), name);
    }
    return id;
}

bool NetcdfFile::has_variable(const std::string& name) const {
    int id = -1;
    return nc_inq_varid(id_, name.c_str(), &id) == NC_NOERR;
}

std::vector<std::string> NetcdfFile::variables() const {
    int count = 0;
    known(nc_inq_nvars(id_, &count), path_);
    std::vector<std::string> names;
    for (int variable = 0; variable < count; ++variable) {
        std::array<char, NC_MAX_NAME + 1> name{};
        known(nc_inq_varname(id_, variable, name.data()), path_);
        names.emplace_back(name.data());
    }
    return names;
}

std::vector<std::string> NetcdfFile::dimensions_of(int variable) const {
    int count = 0;
    known(nc_inq_varndims(id_, variable, &count), path_);
    std::vector<int> ids(static_cast<std::size_t>(count));
    known(nc_inq_vardimid(id_, variable, ids.data()), path_);
    std::vector<std::string> names;
    for (const int dimension : ids) {
        std::array<char, NC_MAX_NAME + 1> name{};
        known(nc_inq_dimname(id_, dimension, name.data()), path_);
        names.emplace_back(name.data());
    }
    return names;
}

int NetcdfFile::type_of(int variable) const {
    nc_type type = NC_NAT;
    known(nc_inq_vartype(id_, variable, &type), path_);
    return type;
}

bool NetcdfFile::has_dimension(const std::string& name) const {
    int id = -1;
    return nc_inq_dimid(id_, name.c_str(), &id) == NC_NOERR;
}

std::size_t NetcdfFile::length(const std::string& dimension) const {
    int id = -1;
    std::size_t length = 0;
    if (nc_inq_dimid(id_, dimension.c_str(), &id) != NC_NOERR ||
        nc_inq_dimlen(id_, id, &length) != NC_NOERR) {
        throw UserError("{}: has no dimension `{}`", path_.string(), dimension);
    }
    return length;
}

std::string NetcdfFile::text_attribute(int variable, const std::string& name) const {
    std::size_t length = 0;
    nc_type type = NC_NAT;
    if (nc_inq_att(id_, variable, name.c_str(), &type, &length) != NC_NOERR || type != NC_CHAR) return {};
    std::error_code error;
    if (length > std::filesystem::file_size(path_, error) || error) return {};  // the file is damaged
    std::string text(length, '\0');
    if (nc_get_att_text(id_, variable, name.c_str(), text.data()) != NC_NOERR) return {};
    return text.substr(0, text.find('\0'));  // some programs write the end of their C strings too
}

std::optional<double> NetcdfFile::number_attribute(int variable, const std::string& name) const {
    std::size_t length = 0;
    nc_type type = NC_NAT;
    double value = 0;
    if (nc_inq_att(id_, variable, name.c_str(), &type, &length) != NC_NOERR) return std::nullopt;
    if (type == NC_CHAR || length != 1) return std::nullopt;
    if (nc_get_att_double(id_, variable, name.c_str(), &value) != NC_NOERR) return std::nullopt;
    return value;
}

std::size_t NetcdfFile::records_on_disk(std::size_t counted) const {
    constexpr auto patience = std::chrono::milliseconds(500), nap = std::chrono::milliseconds(10);
    constexpr auto lately = std::chrono::seconds(10);
    std::error_code error;
    const auto written = std::filesystem::last_write_time(path_, error);
    const bool goes_on = !error && std::filesystem::file_time_type::clock::now() - written < lately;
    for (auto waited = nap; goes_on && whole_records() < counted && waited < patience; waited += nap)
        std::this_thread::sleep_for(nap);
    return whole_records();
}

std::size_t NetcdfFile::whole_records() const {
    std::error_code error;
    const std::uint64_t length = std::filesystem::file_size(path_, error);
    if (header_.record == 0 || error) return 0;
    return static_cast<std::size_t>(length > header_.begin ? (length - header_.begin) / header_.record : 0);
}

std::uint64_t NetcdfFile::bytes_behind_records() const {
    std::error_code error;
    const std::uint64_t length = std::filesystem::file_size(path_, error);
    if (header_.record == 0 || error || length < header_.begin) return 0;
    return (length - header_.begin) % header_.record;
}

using Index = std::vector<std::size_t>;

void NetcdfFile::put(int variable, const Index& start, const Index& count, const int* values) {
    wrote(nc_put_vara_int(id_, variable, start.data(), count.data(), values));
}
void NetcdfFile::put(int variable, const Index& start, const Index& count, const float* values) {
    wrote(nc_put_vara_float(id_, variable, start.data(), count.data(), values));
}
void NetcdfFile::put(int variable, const Index& start, const Index& count, const double* values) {
    wrote(nc_put_vara_double(id_, variable, start.data(), count.data(), values));
}
void NetcdfFile::put(int variable, const Index& start, const Index& count, const char* values) {
    wrote(nc_put_vara_text(id_, variable, start.data(), count.data(), values));
}

template <class Function, class Value>
void NetcdfFile::get_by(Function read, int variable, const Index& start, const Index& count,
                        Value* values) const {
    int rank = 0;
    int status = nc_inq_varndims(id_, variable, &rank);
    // The library reads as many entries of `start` and `count` as the variable has dimensions in the file, so
    // their number is checked first.
    if (status == NC_NOERR && static_cast<std::size_t>(rank) != count.size()) status = NC_EINVALCOORDS;
    if (status == NC_NOERR) status = read(id_, variable, start.data(), count.data(), values);
    if (status != NC_NOERR) throw UserError("{}: cannot be read: {}", path_.string(), nc_strerror(status));
}

void NetcdfFile::get(int variable, const Index& start, const Index& count, int* values) const {
    get_by(nc_get_vara_int, variable, start, count, values);
}
void NetcdfFile::get(int variable, const Index& start, const Index& count, float* values) const {
    get_by(nc_get_vara_float, variable, start, count, values);
}
void NetcdfFile::get(int variable, const Index& start, const Index& count, double* values) const {
    get_by(nc_get_vara_double, variable, start, count, values);
}

void NetcdfFile::sync(std::size_t records) {
    wrote(nc_sync(id_));
    if (!is_there(path_)) throw RunError("{}: has been removed while the run wrote it", path_.string());
    records_ = records;
}

std::string netcdf_version() {
    const std::string text = nc_inq_libvers();  // "4.9.0 of Jan 10 2023 ..."
    return text.substr(0, text.find(' '));
}

}  // namespace grainreel
