// Reads AMBER NetCDF trajectories (convention 1.0 with the additions of LAMMPS, OVITO and SimPARTIX). Each
// number of a grain becomes a column with the name that it has in the file.

#include <fmt/format.h>
#include <netcdf.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <string_view>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/netcdf/hdf5_trial.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

namespace {

// The library's fill values by the number of a type; NaN for types that are not numbers.
double usual_fill(int type) {
    constexpr std::array<double, 12> fills{kUnknown,
                                           NC_FILL_BYTE,
                                           kUnknown,
                                           NC_FILL_SHORT,
                                           NC_FILL_INT,
                                           NC_FILL_FLOAT,
                                           NC_FILL_DOUBLE,
                                           NC_FILL_UBYTE,
                                           NC_FILL_USHORT,
                                           NC_FILL_UINT,
                                           static_cast<double>(NC_FILL_INT64),
                                           static_cast<double>(NC_FILL_UINT64)};
    return type >= 0 && type < static_cast<int>(fills.size()) ? fills[type] : kUnknown;
}

// A variable of numbers. per_frame and per_grain tell whether it has the dimensions of frames and of grains;
// components is the size of its other dimension.
struct AmberVariable {
    std::string name, units;
    int id = -1;
    bool per_frame = false, per_grain = false;
    std::size_t components = 1;
    bool single = true;  // it has no dimension of components, not even one of length 1
    double scale = 1;    // scale_factor
    double fill = 0;     // the value where kUnknown was written
};

// The program that wrote the file, with its version, as it says.
std::string program_of(const NetcdfFile& file) {
    const std::string name = file.text_attribute(NC_GLOBAL, "program");
    const std::string version = file.text_attribute(NC_GLOBAL, "programVersion");
    return name.empty() || version.empty() ? name : name + " " + version;
}

class AmberFile : public RawFile {
  public:
    // Throws UserError when the file cannot be read or has no places of grains.
    explicit AmberFile(const std::filesystem::path& file);

    RawFrame read(std::size_t index) const override;
    // Reads a frame for a caller that already holds the lock.
    RawFrame frame_at(std::size_t index) const;

  private:
    void find_dimensions();
    void find_variables();
    void add_variable(const std::string& name);
    const AmberVariable* find(const std::string& name) const;
    const AmberVariable& places() const { return variables_[places_]; }
    // "x", or "xu" for places that go on outside of a periodic box.
    std::string place_name(std::size_t axis) const {
        return std::string(1, "xyz"[axis]) + (places().name == "unwrapped_coordinates" ? "u" : "");
    }
    [[noreturn]] void refuse_without_frames() const;
    [[noreturn]] void refuse_as_not_amber(const char* what) const;
    // The numbers of the first `grains` grains in a frame, as in the file and not scaled.
    std::vector<double> numbers(const AmberVariable& variable, std::size_t frame, std::size_t grains) const;
    std::size_t grains_of(std::size_t frame) const;
    std::optional<double> time_of(std::size_t frame) const;
    std::optional<std::array<double, 3>> triple(const char* name, std::size_t frame) const;
    std::optional<WorldCell> box_of(std::size_t frame) const;
    void add_columns(RawTable& grains, const AmberVariable& variable, std::size_t frame) const;
    void tell_of_length();
    void find_units();
    bool too_dense_for_atoms() const;

    NetcdfFile netcdf_;
    std::size_t frames_ = 1;    // number of whole frames in the file
    std::size_t declared_ = 1;  // number of frames that its header says
    std::size_t grains_ = 0;    // number of places for grains in a frame
    std::size_t places_ = 0;    // which variable has them
    std::vector<AmberVariable> variables_;
};

AmberFile::AmberFile(const std::filesystem::path& file) : RawFile(file), netcdf_(NetcdfFile::open_any(file)) {
    facts_.format = "AMBER NetCDF";
    facts_.program = program_of(netcdf_);
    if (!netcdf_.has_variable("coordinates") && !netcdf_.has_variable("unwrapped_coordinates"))
        netcdf_.enter("AMBER");
    if (const std::string program = program_of(netcdf_); !program.empty()) facts_.program = program;
    find_dimensions();
    find_variables();
    if (places().components == 2) facts_.dimensions = 2;
    if (frames_ == 0) refuse_without_frames();
    if (frames_ < declared_)
        news_.push_back(
            fmt::format("{}: is cut off after {} of {} frames; the last frame that is not whole is left "
                        "out",
                        file.string(), frames_, declared_));
    tell_of_length();
    for (std::size_t frame = 0; frame < frames_; ++frame) {
        RawMoment moment;
        moment.grains = static_cast<std::int64_t>(grains_of(frame));
        moment.time = time_of(frame);
        moments_.push_back(moment);
    }
    find_units();
}

// what: what the file lacks of the AMBER convention.
void AmberFile::refuse_as_not_amber(const char* what) const {
    throw UserError("{}: is {}, but {}, as the AMBER convention says", file_.string(),
                    is_hdf5(file_) ? "HDF5" : "NetCDF", what);
}

void AmberFile::find_dimensions() {
    constexpr std::uint64_t most_packing = 1100;  // the most bytes that zlib makes of one
    if (!netcdf_.has_dimension("atom")) refuse_as_not_amber("has no dimension atom");
    grains_ = netcdf_.length("atom");
    if (netcdf_.has_dimension("frame")) {
        declared_ = netcdf_.length("frame");
        frames_ = netcdf_.has_records() ? std::min(declared_, netcdf_.whole_records()) : declared_;
    }
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file_, error);
    if (error || grains_ > size * most_packing || frames_ > size * most_packing)
        throw UserError("{}: says that it has {} frames of {} grains, which its {} bytes cannot hold",
                        file_.string(), frames_, grains_, error ? 0 : size);
}

void AmberFile::find_variables() {
    for (const std::string& name : netcdf_.variables()) add_variable(name);
    const AmberVariable* places = find("coordinates");
    if (!places) places = find("unwrapped_coordinates");
    if (!places || !places->per_grain || places->components > 3 || places->components < 2)
        refuse_as_not_amber("has no variable coordinates of frame, atom and spatial");
    places_ = static_cast<std::size_t>(places - variables_.data());
    if (!places->per_frame) frames_ = declared_ = 1;
}

void AmberFile::add_variable(const std::string& name) {
    constexpr std::size_t most_components = 64;
    const int id = netcdf_.find_variable(name);
    const double fill = usual_fill(netcdf_.type_of(id));
    if (std::isnan(fill)) return;
    AmberVariable variable{.name = name, .units = netcdf_.text_attribute(id, "units"), .id = id};
    const std::vector<std::string> dimensions = netcdf_.dimensions_of(id);
    auto dimension = dimensions.begin();
    const auto next_is = [&](const char* what) {
        if (dimension == dimensions.end() || *dimension != what) return false;
        ++dimension;
        return true;
    };
    variable.per_frame = next_is("frame");
    variable.per_grain = next_is("atom");
    if (dimension != dimensions.end()) {
        variable.components = netcdf_.length(*dimension++);
        variable.single = false;
    }
    if (dimension != dimensions.end() || variable.components == 0 || variable.components > most_components)
        return;
    variable.scale = netcdf_.number_attribute(id, "scale_factor").value_or(1.0);
    variable.fill = netcdf_.number_attribute(id, "_FillValue").value_or(fill);
    variables_.push_back(variable);
}

const AmberVariable* AmberFile::find(const std::string& name) const {
    for (const AmberVariable& variable : variables_)
        if (variable.name == name) return &variable;
    return nullptr;
}

std::vector<double> AmberFile::numbers(const AmberVariable& variable, std::size_t frame,
                                       std::size_t grains) const {
    std::vector<std::size_t> start, count;
    start.reserve(3);  // a single number needs no place, but the library wants no null pointer
    count.reserve(3);
    std::size_t size = 1;
    const auto add = [&](std::size_t from, std::size_t length) {
        start.push_back(from);
        count.push_back(length);
        size *= length;
    };
    if (variable.per_frame) add(frame, 1);
    if (variable.per_grain) add(0, grains);
    if (!variable.single) add(0, variable.components);
    std::vector<double> values(size);
    if (size > 0) netcdf_.get(variable.id, start, count, values.data());
    return values;
}

// Tells of what lies behind the frames that the header counts.
void AmberFile::tell_of_length() {
    if (!netcdf_.has_dimension("frame") || !netcdf_.has_records()) return;
    const std::size_t room = netcdf_.whole_records();
    if (room > declared_)
        news_.push_back(
            fmt::format("{}: its header counts {}, and there is room for {}; those behind are left "
                        "out. Was it still "
                        "being written, or is it damaged?",
                        file_.string(), counted(declared_, "frame"), room));
    constexpr std::uint64_t padding = 4;  // bytes
    const std::uint64_t behind = netcdf_.bytes_behind_records();
    if (room == declared_ && behind >= padding)
        news_.push_back(
            fmt::format("{}: {} bytes lie behind its {} and belong to none; was another frame being "
                        "written, or is it damaged?",
                        file_.string(), behind, counted(declared_, "frame")));
}

// Programs count a frame in the header only when it is whole, and a program that was stopped may not have
// counted any.
void AmberFile::refuse_without_frames() const {
    const std::string name = file_.string();
    if (declared_ > 0) throw UserError("{}: has no frame that is whole; was it copied to the end?", name);
    const std::size_t behind = netcdf_.whole_records();
    if (behind == 0) throw UserError("{}: has no frame", name);
    std::string count;
    for (int k = netcdf_.header().count_bytes - 1; k >= 0; --k)
        count += fmt::format("\\{:03o}", behind >> 8 * k & 0xffU);
    throw UserError(
        "{}: its header counts no frame, and behind it there is room for {}; if the program that "
        "wrote it was stopped, put this count there: printf '{}' | dd of={} bs=1 seek=4 conv=notrunc",
        name, behind, count, name);
}

// Number of grains in a frame. The places after them have the fill value.
std::size_t AmberFile::grains_of(std::size_t frame) const {
    const std::size_t width = places().components;
    const double fill = places().fill;
    if (grains_ == 0) return 0;
    const std::vector<double> values = numbers(places(), frame, grains_);
    std::size_t grains = grains_;
    while (grains > 0 && values[(grains - 1) * width] == fill) --grains;
    for (std::size_t i = 0; i < grains * width; ++i)
        if (values[i] == fill || !std::isfinite(values[i]))
            throw UserError("{}: frame {}: grain {} has no place", file_.string(), frame, i / width);
    return grains;
}

std::optional<double> AmberFile::time_of(std::size_t frame) const {
    const AmberVariable* time = find("time");
    if (!time || time->per_grain || !time->single) return std::nullopt;
    const double value = numbers(*time, frame, 0).front();
    if (value == time->fill || !std::isfinite(value)) return std::nullopt;
    return value * time->scale;
}

std::optional<std::array<double, 3>> AmberFile::triple(const char* name, std::size_t frame) const {
    const AmberVariable* variable = find(name);
    if (!variable || variable->per_grain || variable->components > 3 || variable->single) return std::nullopt;
    const std::vector<double> values = numbers(*variable, frame, 0);
    std::array<double, 3> triple{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == variable->fill || !std::isfinite(values[i])) return std::nullopt;
        triple[i] = values[i] * variable->scale;
    }
    return triple;
}

// The first edge of the box lies along x, the second in the plane of x and y. Where a length is 0, the box
// has no end.
std::optional<WorldCell> AmberFile::box_of(std::size_t frame) const {
    const auto lengths = triple("cell_lengths", frame);
    if (!lengths) return std::nullopt;
    const std::array<double, 3> angles =
        triple("cell_angles", frame).value_or(std::array<double, 3>{90, 90, 90});
    std::array<double, 3> cosines{};
    for (std::size_t i = 0; i < 3; ++i)
        cosines[i] = angles[i] == 90 || angles[i] == 0 ? 0.0 : math::cos(angles[i] * std::numbers::pi / 180);
    const auto [a, b, c] = *lengths;
    const double sine = std::sqrt(std::max(0.0, 1 - cosines[2] * cosines[2]));
    const double cy = sine > 0 ? (cosines[0] - cosines[1] * cosines[2]) / sine : 0.0;
    const double cz = std::sqrt(std::max(0.0, 1 - cosines[1] * cosines[1] - cy * cy));
    WorldCell box;
    box.edges = {Vec3(a, 0, 0), Vec3(b * cosines[2], b * sine, 0), Vec3(c * cosines[1], c * cy, c * cz)};
    for (std::size_t i = 0; i < 3; ++i) box.periodic[i] = (*lengths)[i] > 0;
    if (const auto origin = triple("cell_origin", frame))
        box.origin = Vec3((*origin)[0], (*origin)[1], (*origin)[2]);
    return box;
}

void AmberFile::add_columns(RawTable& grains, const AmberVariable& variable, std::size_t frame) const {
    const bool is_place = variable.name == places().name;
    const std::vector<double> values = numbers(variable, frame, grains.rows);
    for (std::size_t k = 0; k < variable.components; ++k) {
        std::string name = variable.name;
        if (is_place) name = place_name(k);
        if (!is_place && !variable.single) name = fmt::format("{}:{}", variable.name, k);
        RawColumn column{name, {}, {}};
        column.values.reserve(grains.rows);
        for (std::size_t i = 0; i < grains.rows; ++i) {
            const double value = values[i * variable.components + k];
            column.values.push_back(value == variable.fill && !is_place ? kUnknown : value * variable.scale);
        }
        grains.columns.push_back(std::move(column));
    }
}

// Whether the mean distance of grains is less than 1 angstrom. Then a file that says angstrom, as the
// convention asks for, cannot mean it.
bool AmberFile::too_dense_for_atoms() const {
    const RawFrame frame = frame_at(0);
    double size = 1;
    int ways = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const RawColumn* column = frame.grains.find(place_name(axis));
        if (!column || column->values.empty()) continue;
        double least = column->values[0], most = least;
        for (const double value : column->values) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
        if (most > least) size *= most - least;
        if (most > least) ++ways;
    }
    return ways == 0 || size / static_cast<double>(frame.grains.rows) < 1;
}

void AmberFile::find_units() {
    const AmberVariable* time = find("time");
    const std::string length = places().units, second = time ? time->units : std::string();
    if (same_word(length, "lj")) facts_.units = "lj";
    facts_.length_unit = unit_size_in(length, Dimension::length);
    facts_.time_unit = unit_size_in(second, Dimension::time);
    if (!same_word(length, "angstrom") || !too_dense_for_atoms()) return;
    facts_.length_unit = facts_.time_unit = std::nullopt;
    news_.push_back(
        fmt::format("{}: says angstrom, as the AMBER convention asks for, but its grains lie too close "
                    "for that; --units says what its numbers are",
                    file_.string()));
}

RawFrame AmberFile::read(std::size_t index) const {
    const std::lock_guard lock(hdf5_library());
    return frame_at(index);
}

RawFrame AmberFile::frame_at(std::size_t index) const {
    RawFrame frame;
    frame.time = moments_.at(index).time;
    frame.box = box_of(index);
    frame.grains.rows = static_cast<std::size_t>(moments_[index].grains);
    for (const AmberVariable& variable : variables_)
        if (variable.per_grain) add_columns(frame.grains, variable, index);
    return frame;
}

bool takes_amber(const FileStart& head) {
    const std::string_view bytes = head.bytes;
    return bytes.starts_with("CDF\x01") || bytes.starts_with("CDF\x02") || bytes.starts_with("CDF\x05") ||
           bytes.starts_with(kHdf5Signature);
}

}  // namespace

// Also called for files of HDF5 that are not H5MD.
std::unique_ptr<RawFile> open_amber(const std::filesystem::path& file) {
    if (packing_of(file) != Packing::none)
        throw UserError("{}: a NetCDF file is not read while it is packed; unpack it", file.string());
    const std::lock_guard lock(hdf5_library());
    if (is_hdf5(file))
        try_in_child(file, [&] {
            const AmberFile one(file);
            for (std::size_t i = 0; i < one.moments().size(); ++i) one.frame_at(i);
        });
    return std::make_unique<AmberFile>(file);
}

RawFormat amber_format() {
    return {"amber", "AMBER NetCDF", takes_amber, open_amber};
}

}  // namespace grainreel
