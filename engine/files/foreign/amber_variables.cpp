#include "engine/files/foreign/amber_variables.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <limits>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_components = 64;
constexpr std::uint64_t most_packing = 1100;  // the most bytes that zlib makes of one

std::uint64_t size_of(const std::filesystem::path& file) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    return error ? 0 : size;
}

bool is_classic(const std::string& head) {
    return head.starts_with("CDF");
}

std::uint64_t little_endian(const std::string& bytes, std::size_t place, std::size_t width) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < width; ++i)
        value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[place + i])) << (8 * i);
    return value;
}

// Checks the end of the file against HDF5's superblock (HDF5 file format specification, II.A).
void check_hdf5(const std::filesystem::path& file, const std::string& head) {
    constexpr std::size_t superblock = 64;
    const std::string name = file.string();
    if (head.size() < superblock) throw UserError(fmt::format("{}: is cut off within its first bytes", name));
    const int version = static_cast<unsigned char>(head[8]);
    if (version > 3)
        throw UserError(fmt::format("{}: byte 8: has the version {} of HDF5's superblock; 0 to 3 are read",
                                    name, version));
    const std::size_t width = static_cast<unsigned char>(head[version < 2 ? 13 : 9]);
    if (width != 8) return;  // the library reports what is wrong with such a file
    const std::size_t place = version == 0 ? 40 : version == 1 ? 44 : 28;
    const std::uint64_t end = little_endian(head, place, 8), size = size_of(file);
    if (end > size)
        throw UserError(fmt::format("{}: is cut off: it has {} bytes of {}; copy it again", name, size, end));
}

std::string first_bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string head(64, '\0');
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    return head;
}

std::string text_attribute(int group, int variable, const char* name) {
    std::size_t length = 0;
    nc_type type = NC_NAT;
    if (nc_inq_att(group, variable, name, &type, &length) != NC_NOERR || type != NC_CHAR || length > 65536)
        return {};
    std::string text(length, '\0');
    if (nc_get_att_text(group, variable, name, text.data()) != NC_NOERR) return {};
    return text.substr(0, text.find('\0'));
}

std::optional<double> number_attribute(int group, int variable, const char* name) {
    std::size_t length = 0;
    nc_type type = NC_NAT;
    double value = 0;
    if (nc_inq_att(group, variable, name, &type, &length) != NC_NOERR || type == NC_CHAR || length != 1)
        return std::nullopt;
    if (nc_get_att_double(group, variable, name, &value) != NC_NOERR) return std::nullopt;
    return value;
}

// The library's fill value of a type; none for types that are not numbers.
std::optional<double> usual_fill(nc_type type) {
    switch (type) {
        case NC_BYTE:
            return NC_FILL_BYTE;
        case NC_SHORT:
            return NC_FILL_SHORT;
        case NC_INT:
            return NC_FILL_INT;
        case NC_FLOAT:
            return static_cast<double>(NC_FILL_FLOAT);
        case NC_DOUBLE:
            return NC_FILL_DOUBLE;
        case NC_UBYTE:
            return NC_FILL_UBYTE;
        case NC_USHORT:
            return NC_FILL_USHORT;
        case NC_UINT:
            return NC_FILL_UINT;
        case NC_INT64:
            return static_cast<double>(NC_FILL_INT64);
        case NC_UINT64:
            return static_cast<double>(NC_FILL_UINT64);
        default:
            return std::nullopt;
    }
}

}  // namespace

AmberVariables::AmberVariables(const std::filesystem::path& file) : file_(file) {
    if (packing_of(file) != Packing::none)
        throw UserError(
            fmt::format("{}: a NetCDF file is not read while it is packed; unpack it", file.string()));
    const std::string head = first_bytes(file);
    if (is_classic(head)) {
        read_netcdf_header(file);
    } else {
        check_hdf5(file, head);
    }
    check(nc_open(file.c_str(), NC_NOWRITE, &file_id_));
    try {
        find_group();
        find_dimensions();
        int count = 0;
        check(nc_inq_varids(id_, &count, nullptr));
        std::vector<int> ids(static_cast<std::size_t>(std::max(count, 0)));
        if (count > 0) check(nc_inq_varids(id_, &count, ids.data()));
        for (const int id : ids) add_variable(id);
        const AmberVariable* found = find("coordinates");
        if (!found) found = find("unwrapped_coordinates");
        if (!found || !found->per_grain || found->components > 3 || found->components < 2)
            throw UserError(
                fmt::format("{}: is NetCDF, but has no variable coordinates of frame, atom and spatial, "
                            "as the AMBER convention says",
                            file.string()));
        places_ = static_cast<std::size_t>(found - variables_.data());
        if (!found->per_frame) frames_ = declared_ = 1;
    } catch (...) {
        nc_close(file_id_);
        throw;
    }
}

AmberVariables::~AmberVariables() {
    nc_close(file_id_);
}

void AmberVariables::check(int status) const {
    if (status != NC_NOERR)
        throw UserError(fmt::format("{}: cannot be read: {}", file_.string(), nc_strerror(status)));
}

void AmberVariables::find_group() {
    id_ = file_id_;
    int group = -1, variable = -1;
    if (nc_inq_varid(id_, "coordinates", &variable) == NC_NOERR) return;
    if (nc_inq_varid(id_, "unwrapped_coordinates", &variable) == NC_NOERR) return;
    if (nc_inq_grp_ncid(file_id_, "AMBER", &group) == NC_NOERR) id_ = group;
}

std::size_t AmberVariables::whole_records() const {
    if (!is_classic(first_bytes(file_))) return std::numeric_limits<std::size_t>::max();
    const NetcdfHeader header = read_netcdf_header(file_);
    const std::uint64_t size = size_of(file_);
    if (header.record == 0) return std::numeric_limits<std::size_t>::max();
    return static_cast<std::size_t>(size > header.begin ? (size - header.begin) / header.record : 0);
}

std::optional<std::size_t> AmberVariables::records_behind_header() const {
    const std::size_t records = whole_records();
    if (records == std::numeric_limits<std::size_t>::max()) return std::nullopt;
    return records;
}

int AmberVariables::count_bytes() const {
    return first_bytes(file_)[3] == 5 ? 8 : 4;
}

void AmberVariables::find_dimensions() {
    if (nc_inq_dimid(id_, "atom", &atom_dimension_) != NC_NOERR)
        throw UserError(fmt::format("{}: is NetCDF, but has no dimension atom, as the AMBER convention says",
                                    file_.string()));
    check(nc_inq_dimlen(id_, atom_dimension_, &grains_));
    if (nc_inq_dimid(id_, "frame", &frame_dimension_) == NC_NOERR) {
        check(nc_inq_dimlen(id_, frame_dimension_, &declared_));
        frames_ = std::min(declared_, whole_records());
    } else {
        frame_dimension_ = -1;
    }
    const std::uint64_t most = size_of(file_) * most_packing;
    if (grains_ > most || frames_ > most)
        throw UserError(
            fmt::format("{}: says that it has {} frames of {} grains, which its {} bytes cannot hold",
                        file_.string(), frames_, grains_, size_of(file_)));
}

void AmberVariables::add_variable(int id) {
    std::array<char, NC_MAX_NAME + 1> name{};
    nc_type type = NC_NAT;
    int rank = 0;
    check(nc_inq_var(id_, id, name.data(), &type, &rank, nullptr, nullptr));
    const std::optional<double> fill = usual_fill(type);
    if (!fill || rank > 3) return;
    std::array<int, 3> dimensions{};
    check(nc_inq_vardimid(id_, id, dimensions.data()));
    AmberVariable variable{name.data(), text_attribute(id_, id, "units"), id, false, false, 1, true, 1,
                           *fill};
    int at = 0;
    if (at < rank && dimensions[0] == frame_dimension_) variable.per_frame = ++at > 0;
    if (at < rank && dimensions[static_cast<std::size_t>(at)] == atom_dimension_)
        variable.per_grain = ++at > 0;
    for (; at < rank; ++at) {
        std::size_t length = 0;
        check(nc_inq_dimlen(id_, dimensions[static_cast<std::size_t>(at)], &length));
        if (length == 0 || length > most_components || !variable.single) return;
        variable.components = length;
        variable.single = false;
    }
    variable.scale = number_attribute(id_, id, "scale_factor").value_or(1.0);
    variable.fill = number_attribute(id_, id, "_FillValue").value_or(*fill);
    variables_.push_back(variable);
}

const AmberVariable* AmberVariables::find(const std::string& name) const {
    for (const AmberVariable& variable : variables_)
        if (variable.name == name) return &variable;
    return nullptr;
}

std::string AmberVariables::attribute(const char* name) const {
    const std::string text = text_attribute(id_, NC_GLOBAL, name);
    return text.empty() ? text_attribute(file_id_, NC_GLOBAL, name) : text;
}

std::vector<double> AmberVariables::read(const AmberVariable& variable, std::size_t frame,
                                         std::size_t grains) const {
    std::vector<std::size_t> start, count;
    std::size_t size = 1;
    const auto add = [&](std::size_t from, std::size_t length) {
        start.push_back(from);
        count.push_back(length);
        size *= length;
    };
    if (variable.per_frame) add(frame, 1);
    if (variable.per_grain) add(0, grains);
    if (!variable.single) add(0, variable.components);
    if (start.empty()) add(0, 1);  // a single number; the library ignores the place
    std::vector<double> values(size);
    if (size > 0) check(nc_get_vara_double(id_, variable.id, start.data(), count.data(), values.data()));
    return values;
}

namespace {

// Does the work in the child process, without our signal handlers, without a core file and with a time limit.
[[noreturn]] void work_alone(const std::function<void()>& work, unsigned seconds) {
    constexpr std::array<int, 6> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};
    for (const int signal : signals) ::signal(signal, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::alarm(seconds);
    try {
        work();
    } catch (...) {  // the parent gets the same exception when it does the work itself
    }
    ::_exit(0);
}

}  // namespace

bool survives(const std::function<void()>& work, unsigned seconds) {
    const pid_t child = ::fork();
    if (child < 0) return true;
    if (child == 0) work_alone(work, seconds);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return true;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace grainreel
