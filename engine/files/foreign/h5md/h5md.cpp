// Reads H5MD 1.0 and 1.1 (https://www.nongnu.org/h5md): trajectories in HDF5, as ESPResSo, pyh5md and LAMMPS
// write them. The first group of particles that has places is read. Each of its elements becomes columns with
// the name that it has in the file. Steps and times may be listed (explicit) or follow from an increment
// (fixed).
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/h5md/hdf5_file.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/netcdf/hdf5_trial.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

std::unique_ptr<RawFile> open_amber(const std::filesystem::path& file);

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostComponents = 64;

// The steps or times of an element: a list, or an increment.
struct Clock {
    std::vector<double> list;
    double offset = 0, increment = 0;
    bool fixed = false, known = false;

    double of(std::size_t row) const {
        return fixed ? offset + increment * static_cast<double>(row) : list[row];
    }
    bool has(std::size_t row) const { return known && (fixed || row < list.size()); }
};

// Numbers of the grains, which may change from frame to frame.
struct Element {
    std::string name;
    Hdf5Table values;
    bool per_frame = false;
    Clock steps, times;
    std::size_t components = 1;
    bool single = true;  // it has no dimension of components
    double size = 1;     // what is multiplied to its numbers
};

class H5mdFile : public RawFile {
  public:
    // Throws UserError where the file cannot be read or has no places of grains.
    explicit H5mdFile(const fs::path& file);

    RawFrame read(std::size_t index) const override;
    // Reads a frame for a caller that already holds the lock.
    RawFrame frame_at(std::size_t index) const;

    static bool is_h5md(const Hdf5File& file) { return file.has_group("h5md"); }

  private:
    [[noreturn]] void fault(const std::string& what) const { refuse_file(file_, what); }
    void choose_group();
    Clock clock(const std::string& path) const;
    Element element(const std::string& name) const;
    void find_frames();
    void find_elements();
    void find_units();
    std::string unit_of(const std::string& path) const;
    std::optional<std::size_t> row_of(const Element& element, std::size_t frame) const;
    std::vector<double> numbers(const Element& element, std::size_t frame) const;
    std::vector<std::size_t> grains_of(std::size_t frame) const;
    void find_box();
    std::optional<WorldCell> box_at(std::size_t frame) const;
    void add_columns(RawTable& grains, const Element& element, const std::vector<std::size_t>& rows,
                     std::size_t frame) const;

    Hdf5File hdf5_;
    std::string group_;  // "particles/all"
    std::size_t frames_ = 1, grains_ = 0;
    Element places_;
    std::optional<Element> ids_, edges_;
    std::array<bool, 3> periodic_{};
    std::vector<Element> elements_;
};

H5mdFile::H5mdFile(const fs::path& file) : RawFile(file), hdf5_(file) {
    facts_.format = "H5MD";
    if (!is_h5md(hdf5_)) fault("is HDF5, but not H5MD");
    const std::vector<std::string> name = hdf5_.words_of("h5md/creator", "name"),
                                   version = hdf5_.words_of("h5md/creator", "version");
    if (!name.empty()) facts_.program = name.front();
    if (!name.empty() && !version.empty()) facts_.program += " " + version.front();
    choose_group();
    find_frames();
    find_elements();
    find_box();
    find_units();
    for (std::size_t frame = 0; frame < frames_; ++frame) {
        RawMoment moment;
        moment.grains = static_cast<std::int64_t>(grains_of(frame).size());
        constexpr double most = 9e15;
        if (places_.steps.has(frame)) {
            const double step = places_.steps.of(frame);
            if (!(std::abs(step) < most)) fault(fmt::format("frame {} has the step {}", frame, step));
            moment.step = static_cast<std::int64_t>(step);
        }
        if (places_.times.has(frame) && std::isfinite(places_.times.of(frame)))
            moment.time = places_.times.of(frame);
        moments_.push_back(moment);
    }
}

void H5mdFile::choose_group() {
    std::vector<std::string> others;
    for (const std::string& name : hdf5_.names("particles")) {
        const std::string path = "particles/" + name;
        if (!hdf5_.has_table(path + "/position") && !hdf5_.has_table(path + "/position/value")) continue;
        if (group_.empty())
            group_ = path;
        else
            others.push_back(name);
    }
    if (group_.empty())
        fault(
            "is H5MD without places: no group of its particles has position/value; was it written with "
            "them?");
    for (const std::string& name : others)
        news_.push_back(fmt::format("{}: its particles {} are passed over; {} is read", file_.string(),
                                    excerpt(name), excerpt(group_)));
}

Clock H5mdFile::clock(const std::string& path) const {
    Clock clock;
    if (!hdf5_.has_table(path)) return clock;
    const Hdf5Table table = hdf5_.table(path);
    if (table.shape().size() > 1) fault(fmt::format("{} is no list of numbers", excerpt(path)));
    clock.known = true;
    clock.fixed = table.shape().empty();
    std::vector<double> numbers = table.numbers();
    if (clock.fixed) {
        clock.increment = numbers.front();
        clock.offset = hdf5_.number_of(path, "offset").value_or(0);
    } else {
        clock.list = std::move(numbers);
    }
    return clock;
}

Element H5mdFile::element(const std::string& name) const {
    Element one;
    one.name = name;
    const std::string path = group_ + "/" + name;
    one.per_frame = hdf5_.has_group(path);
    one.values = hdf5_.table(one.per_frame ? path + "/value" : path);
    if (!one.per_frame) return one;
    one.steps = clock(path + "/step");
    one.times = clock(path + "/time");
    return one;
}

void H5mdFile::find_frames() {
    places_ = element("position");
    const std::vector<std::uint64_t>& shape = places_.values.shape();
    const std::size_t rank = places_.per_frame ? 3 : 2;
    if (shape.size() != rank || shape.back() < 2 || shape.back() > 3)
        fault(fmt::format("{}/position is no table of places in two or three dimensions", excerpt(group_)));
    facts_.dimensions = static_cast<int>(shape.back());
    places_.components = shape.back();
    places_.single = false;
    grains_ = shape[rank - 2];
    if (!places_.per_frame) return;
    std::uint64_t frames = shape.front();
    for (const Clock& clock : {places_.steps, places_.times})
        if (clock.known && !clock.fixed) frames = std::min<std::uint64_t>(frames, clock.list.size());
    if (frames == 0) fault("has no frame");
    std::error_code error;
    // Places without grains take no bytes, so that their number of frames is held against the file's size.
    if (frames > 1000 * (fs::file_size(file_, error) + 1))
        fault(fmt::format("says that it has {} frames", frames));
    if (frames < shape.front())
        news_.push_back(
            fmt::format("{}: has places of {} frames and the steps or times of {}; the others are left "
                        "out",
                        file_.string(), shape.front(), frames));
    frames_ = frames;
}

void H5mdFile::find_elements() {
    for (const std::string& name : hdf5_.names(group_)) {
        const std::string path = group_ + "/" + name;
        if (name == "box" || name == "position") continue;
        if (!hdf5_.has_table(path) && !hdf5_.has_table(path + "/value")) continue;
        Element one = element(name);
        const std::vector<std::uint64_t>& shape = one.values.shape();
        const std::size_t first = one.per_frame ? 1 : 0;
        if (shape.size() <= first || shape.size() > first + 2) continue;
        if (shape[first] != grains_) {
            news_.push_back(fmt::format("{}: {} has {} values for {} grains and is passed over",
                                        file_.string(), excerpt(name), shape[first], grains_));
            continue;
        }
        one.single = shape.size() == first + 1;
        one.components = one.single ? 1 : shape.back();
        if (one.components == 0 || one.components > kMostComponents) continue;
        if (name == "id" && one.single) ids_ = one;
        elements_.push_back(std::move(one));
    }
}

// The row of an element at a frame of the places; none where it has none of that step.
std::optional<std::size_t> H5mdFile::row_of(const Element& element, std::size_t frame) const {
    if (!element.per_frame) return 0;
    const std::size_t rows = element.values.rows();
    const auto same = [&](std::size_t row) {
        return !places_.steps.has(frame) || !element.steps.has(row) ||
               element.steps.of(row) == places_.steps.of(frame);
    };
    if (frame < rows && same(frame)) return frame;
    for (std::size_t row = 0; row < rows && element.steps.has(row); ++row)
        if (same(row)) return row;
    return std::nullopt;
}

std::vector<double> H5mdFile::numbers(const Element& element, std::size_t frame) const {
    const std::optional<std::size_t> row = row_of(element, frame);
    if (!row) return {};
    return element.per_frame ? element.values.row(*row) : element.values.numbers();
}

// The rows of a frame that are grains. If their number changes, the ids of the others are negative or have
// the value of what was never written.
std::vector<std::size_t> H5mdFile::grains_of(std::size_t frame) const {
    std::vector<std::size_t> rows;
    const std::vector<double> ids = ids_ && ids_->per_frame ? numbers(*ids_, frame) : std::vector<double>();
    for (std::size_t row = 0; row < grains_; ++row) {
        const bool absent =
            !ids.empty() && (ids[row] < 0 || (ids_->values.fill() != 0 && ids[row] == ids_->values.fill()));
        if (!absent) rows.push_back(row);
    }
    return rows;
}

void H5mdFile::find_box() {
    const std::string path = group_ + "/box";
    const std::vector<std::string> words = hdf5_.words_of(path, "boundary");
    for (std::size_t axis = 0; axis < 3 && !words.empty(); ++axis)
        periodic_[axis] = axis < words.size() ? words[axis] == "periodic" : words.size() == 1 && periodic_[0];
    if (facts_.dimensions == 2) periodic_[2] = true;
    const bool edges = hdf5_.has_table(path + "/edges") || hdf5_.has_table(path + "/edges/value");
    // A box without periodic sides says nothing of where the grains are: the format gives it no origin.
    if (!edges || !(periodic_[0] || periodic_[1] || (periodic_[2] && facts_.dimensions == 3))) return;
    edges_ = element("box/edges");
    const std::vector<std::uint64_t>& shape = edges_->values.shape();
    const auto d = static_cast<std::uint64_t>(facts_.dimensions);
    const std::size_t first = edges_->per_frame ? 1 : 0;
    const bool whole = (shape.size() == first + 1 && shape[first] == d) ||
                       (shape.size() == first + 2 && shape[first] == d && shape[first + 1] == d);
    if (!whole) fault(fmt::format("{}/edges are no {} lengths or vectors", excerpt(path), d));
}

std::optional<WorldCell> H5mdFile::box_at(std::size_t frame) const {
    if (!edges_) return std::nullopt;
    const std::vector<double> numbers = this->numbers(*edges_, frame);
    if (numbers.empty()) return std::nullopt;
    const auto d = static_cast<std::size_t>(facts_.dimensions);
    WorldCell box;
    box.edges = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    for (std::size_t k = 0; k < d; ++k)
        for (std::size_t axis = 0; axis < d; ++axis) {
            const double number = numbers.size() == d ? (k == axis ? numbers[k] : 0) : numbers[k * d + axis];
            if (!std::isfinite(number))
                fault(fmt::format("frame {} has a box that is {} long", frame, number));
            box.edges[k][static_cast<Eigen::Index>(axis)] = number;
        }
    box.periodic = periodic_;
    return box;
}

std::string H5mdFile::unit_of(const std::string& path) const {
    const std::string value = path + "/value";
    const std::vector<std::string> words = hdf5_.words_of(hdf5_.has_table(value) ? value : path, "unit");
    return words.empty() ? std::string() : words.front();
}

void H5mdFile::find_units() {
    const std::string length = unit_of(group_ + "/position"), time = unit_of(group_ + "/position/time");
    facts_.length_unit = unit_size_in(length, Dimension::length);
    facts_.time_unit = unit_size_in(time, Dimension::time);
    if (length.empty())
        news_.push_back(
            fmt::format("{}: says no units, so that its numbers are taken as m, s and kg; --units "
                        "names others",
                        file_.string()));
    else if (!facts_.length_unit)
        news_.push_back(
            fmt::format("{}: says the unit {} for its places, which is no known unit of length; they "
                        "are taken as m, and --units names others",
                        file_.string(), excerpt(length)));
    const double one = facts_.length_unit.value_or(1), second = facts_.time_unit.value_or(1);
    for (Element& element : elements_) {
        const std::string unit = unit_of(group_ + "/" + element.name);
        std::optional<double> size;
        if (element.name == "radius" || element.name == "diameter")
            size = unit_size_in(unit, Dimension::length);
        if (size) element.size = *size / one;
        if (element.name == "velocity") {
            size = unit_size_in(unit, Dimension::speed);
            if (size) element.size = *size * second / one;
        }
        if (element.name == "mass") element.size = unit_size_in(unit, Dimension::mass).value_or(1);
    }
}

void H5mdFile::add_columns(RawTable& grains, const Element& element, const std::vector<std::size_t>& rows,
                           std::size_t frame) const {
    const bool is_place = &element == &places_;
    const std::vector<double> values = numbers(element, frame);
    for (std::size_t k = 0; k < element.components; ++k) {
        RawColumn column{element.name, {}, element.values.words()};
        if (is_place)
            column.name = std::string(1, "xyz"[k]);
        else if (!element.single)
            column.name = fmt::format("{}:{}", element.name, k);
        column.values.reserve(rows.size());
        for (const std::size_t row : rows)
            column.values.push_back(values.empty() ? kUnknown
                                                   : values[row * element.components + k] * element.size);
        grains.columns.push_back(std::move(column));
    }
}

RawFrame H5mdFile::read(std::size_t index) const {
    const std::lock_guard lock(hdf5_library());
    return frame_at(index);
}

RawFrame H5mdFile::frame_at(std::size_t index) const {
    RawFrame frame;
    frame.step = moments_.at(index).step;
    frame.time = moments_[index].time;
    frame.box = box_at(index);
    const std::vector<std::size_t> rows = grains_of(index);
    frame.grains.rows = rows.size();
    add_columns(frame.grains, places_, rows, index);
    for (const Element& element : elements_) add_columns(frame.grains, element, rows, index);
    return frame;
}

// The content tells only that it is HDF5; open_h5md() finds out which of the two formats it is.
bool takes_h5md(const FileStart& head) {
    return std::string_view(head.bytes).starts_with(kHdf5Signature);
}

// Reads all of the file in a child process, where a crash does no harm. Returns whether it is H5MD.
bool try_h5md(const fs::path& file) {
    try_in_child(file, [&] {
        const H5mdFile one(file);
        for (std::size_t i = 0; i < one.moments().size(); ++i) one.frame_at(i);
    });
    const Hdf5File one(file);
    if (one.has_group("VTKHDF"))
        refuse_file(file,
                    "is VTKHDF, which is not read; give what it was written from, or ParaView's CSV or .vtp");
    return H5mdFile::is_h5md(one);
}

std::unique_ptr<RawFile> open_h5md(const fs::path& file) {
    if (packing_of(file) != Packing::none)
        refuse_file(file, "an HDF5 file is not read while it is packed; unpack it");
    {
        const std::lock_guard lock(hdf5_library());
        if (try_h5md(file)) return std::make_unique<H5mdFile>(file);
    }
    return open_amber(file);
}

}  // namespace

RawFormat h5md_format() {
    return {"h5md", "H5MD", takes_h5md, open_h5md};
}

}  // namespace grainreel
