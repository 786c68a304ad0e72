// Reads AMBER NetCDF trajectories (convention 1.0 with the additions of LAMMPS, OVITO and SimPARTIX). Each
// number of a grain becomes a column with the name that it has in the file.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/files/foreign/amber_variables.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view hdf5_signature("\x89HDF\r\n\x1a\n");
constexpr double pi = 3.14159265358979323846;

// The library has one state for all files, so only one thread may use it at a time.
std::mutex& library() {
    static std::mutex one;
    return one;
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

// m in a unit of length or s in a unit of time; none where the word is no such unit.
std::optional<double> unit_of(const std::string& word) {
    static const std::map<std::string, double> units{{"m", 1},
                                                     {"meter", 1},
                                                     {"metre", 1},
                                                     {"cm", 1e-2},
                                                     {"centimeter", 1e-2},
                                                     {"mm", 1e-3},
                                                     {"millimeter", 1e-3},
                                                     {"um", 1e-6},
                                                     {"micrometer", 1e-6},
                                                     {"micron", 1e-6},
                                                     {"nm", 1e-9},
                                                     {"nanometer", 1e-9},
                                                     {"nanometre", 1e-9},
                                                     {"angstrom", 1e-10},
                                                     {"s", 1},
                                                     {"second", 1},
                                                     {"ms", 1e-3},
                                                     {"millisecond", 1e-3},
                                                     {"us", 1e-6},
                                                     {"microsecond", 1e-6},
                                                     {"ns", 1e-9},
                                                     {"nanosecond", 1e-9},
                                                     {"ps", 1e-12},
                                                     {"picosecond", 1e-12},
                                                     {"fs", 1e-15},
                                                     {"femtosecond", 1e-15}};
    std::string one = lower(word);
    auto found = units.find(one);
    if (found == units.end() && one.size() > 2 && one.ends_with('s')) {  // "seconds"
        one.pop_back();
        found = units.find(one);
    }
    return found == units.end() ? std::nullopt : std::optional(found->second);
}

class AmberFile : public RawFile {
  public:
    explicit AmberFile(const std::filesystem::path& file);

    const RawFacts& facts() const override { return facts_; }
    const std::vector<RawMoment>& moments() const override { return moments_; }
    std::vector<std::string> news() const override { return news_; }
    RawFrame read(std::size_t index) const override;
    // Reads a frame for a caller that already holds the lock.
    RawFrame frame_at(std::size_t index) const;

  private:
    [[noreturn]] void refuse_without_frames() const;
    std::size_t grains_of(std::size_t frame) const;
    std::optional<double> time_of(std::size_t frame) const;
    std::optional<std::array<double, 3>> triple(const char* name, std::size_t frame) const;
    std::optional<WorldCell> box_of(std::size_t frame) const;
    void add_columns(RawTable& grains, const AmberVariable& variable, std::size_t frame) const;
    void find_units();
    bool too_dense_for_atoms() const;

    std::filesystem::path file_;
    AmberVariables variables_;
    RawFacts facts_;
    std::vector<RawMoment> moments_;
    std::vector<std::string> news_;
};

AmberFile::AmberFile(const std::filesystem::path& file) : file_(file), variables_(file) {
    facts_.format = "AMBER NetCDF";
    facts_.program = variables_.attribute("program");
    if (!facts_.program.empty()) {
        const std::string version = variables_.attribute("programVersion");
        if (!version.empty()) facts_.program += " " + version;
    }
    if (variables_.places().components == 2) facts_.dimensions = 2;
    if (variables_.frames() == 0) refuse_without_frames();
    if (variables_.frames() < variables_.declared())
        news_.push_back(
            fmt::format("{}: is cut off after {} of {} frames; the last frame that is not whole is left "
                        "out",
                        file.string(), variables_.frames(), variables_.declared()));
    for (std::size_t frame = 0; frame < variables_.frames(); ++frame) {
        RawMoment moment;
        moment.grains = static_cast<std::int64_t>(grains_of(frame));
        moment.time = time_of(frame);
        moments_.push_back(moment);
    }
    find_units();
}

// Programs count a frame in the header only when it is whole, and a program that was stopped may not have
// counted any.
void AmberFile::refuse_without_frames() const {
    const std::string name = file_.string();
    if (variables_.declared() > 0)
        throw UserError(fmt::format("{}: has no frame that is whole; was it copied to the end?", name));
    const std::optional<std::size_t> behind = variables_.records_behind_header();
    if (behind.value_or(0) == 0) throw UserError(fmt::format("{}: has no frame", name));
    std::string count;
    for (int k = variables_.count_bytes() - 1; k >= 0; --k)
        count += fmt::format("\\{:03o}", *behind >> 8 * k & 0xffU);
    throw UserError(
        fmt::format("{}: its header counts no frame, and behind it there is room for {}; if the program that "
                    "wrote it was "
                    "stopped, put this count there: printf '{}' | dd of={} bs=1 seek=4 conv=notrunc",
                    name, *behind, count, name));
}

// Number of grains in a frame. The places after them have the fill value.
std::size_t AmberFile::grains_of(std::size_t frame) const {
    const AmberVariable& places = variables_.places();
    const std::size_t most = variables_.grains(), width = places.components;
    if (most == 0) return 0;
    const std::vector<double> values = variables_.read(places, frame, most);
    std::size_t grains = most;
    while (grains > 0 && values[(grains - 1) * width] == places.fill) --grains;
    for (std::size_t i = 0; i < grains * width; ++i)
        if (values[i] == places.fill || !std::isfinite(values[i]))
            throw UserError(
                fmt::format("{}: frame {}: grain {} has no place", file_.string(), frame, i / width));
    return grains;
}

std::optional<double> AmberFile::time_of(std::size_t frame) const {
    const AmberVariable* time = variables_.find("time");
    if (!time || time->per_grain || !time->single) return std::nullopt;
    const double value = variables_.read(*time, frame, 0).front();
    if (value == time->fill || !std::isfinite(value)) return std::nullopt;
    return value * time->scale;
}

std::optional<std::array<double, 3>> AmberFile::triple(const char* name, std::size_t frame) const {
    const AmberVariable* variable = variables_.find(name);
    if (!variable || variable->per_grain || variable->components > 3 || variable->single) return std::nullopt;
    const std::vector<double> values = variables_.read(*variable, frame, 0);
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
        cosines[i] = angles[i] == 90 || angles[i] == 0 ? 0.0 : math::cos(angles[i] * pi / 180);
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
    const bool places = variable.name == variables_.places().name;
    const std::vector<double> values = variables_.read(variable, frame, grains.rows);
    for (std::size_t k = 0; k < variable.components; ++k) {
        std::string name = variable.name;
        if (places) name = std::string(1, "xyz"[k]);
        if (!places && !variable.single) name = fmt::format("{}:{}", variable.name, k);
        RawColumn column{name, {}, {}};
        column.values.reserve(grains.rows);
        for (std::size_t i = 0; i < grains.rows; ++i) {
            const double value = values[i * variable.components + k];
            column.values.push_back(value == variable.fill && !places ? nothing : value * variable.scale);
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
    for (const char* name : {"x", "y", "z"}) {
        const RawColumn* column = frame.grains.find(name);
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
    const AmberVariable* time = variables_.find("time");
    const std::string length = variables_.places().units, second = time ? time->units : std::string();
    if (lower(length) == "lj") facts_.units = "lj";
    facts_.length_unit = unit_of(length);
    facts_.time_unit = unit_of(second);
    if (lower(length) != "angstrom" || !too_dense_for_atoms()) return;
    facts_.length_unit = facts_.time_unit = std::nullopt;
    news_.push_back(
        fmt::format("{}: says angstrom, as the AMBER convention asks for, but its grains lie too close "
                    "for that; --units says what its numbers are",
                    file_.string()));
}

RawFrame AmberFile::read(std::size_t index) const {
    const std::lock_guard lock(library());
    return frame_at(index);
}

RawFrame AmberFile::frame_at(std::size_t index) const {
    RawFrame frame;
    frame.time = moments_.at(index).time;
    frame.box = box_of(index);
    frame.grains.rows = static_cast<std::size_t>(moments_[index].grains);
    for (const AmberVariable& variable : variables_.variables())
        if (variable.per_grain) add_columns(frame.grains, variable, index);
    return frame;
}

bool takes_amber(const FileHead& head) {
    const std::string_view bytes = head.bytes;
    return bytes.starts_with("CDF\x01") || bytes.starts_with("CDF\x02") || bytes.starts_with("CDF\x05") ||
           bytes.starts_with(hdf5_signature);
}

bool is_hdf5(const std::filesystem::path& file) {
    std::string head(hdf5_signature.size(), '\0');
    std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
    return head == hdf5_signature;
}

// Opens a file of HDF5 and reads all of it in a child process, where a crash does no harm.
void try_hdf5(const std::filesystem::path& file) {
    const auto read_all = [&] {
        const AmberFile one(file);
        for (std::size_t i = 0; i < one.moments().size(); ++i) one.frame_at(i);
    };
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    const auto seconds =
        static_cast<unsigned>(std::min<std::uintmax_t>(30 + (error ? 0 : size) / 5000000, 3600));
    if (!survives(read_all, seconds))
        throw UserError(fmt::format(
            "{}: is a damaged HDF5 file, on which the HDF5 library fails; copy it again", file.string()));
}

std::unique_ptr<RawFile> open_amber(const std::filesystem::path& file) {
    const std::lock_guard lock(library());
    if (is_hdf5(file)) try_hdf5(file);
    return std::make_unique<AmberFile>(file);
}

}  // namespace

RawFormat amber_format() {
    return {"amber", "AMBER NetCDF", takes_amber, open_amber};
}

}  // namespace grainreel
