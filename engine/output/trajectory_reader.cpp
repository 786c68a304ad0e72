#include <netcdf.h>

#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/output/netcdf_file.hpp"
#include "engine/output/trajectory.hpp"

namespace grainreel {

namespace {

constexpr std::array variables_of_ours{
    "time",          "cycles",       "phase",          "step",        "grains",       "wall_offset",
    "wall_velocity", "floor_offset", "floor_velocity", "cell_origin", "cell_lengths", "id",
    "type",          "radius",       "coordinates",    "velocities",  "spin"};

// Another program's file may follow the same convention; what counts is that nothing is missing.
void check_complete(const NetcdfFile& file, const std::string& name) {
    std::vector<std::string> missing;
    for (const char* variable : variables_of_ours)
        if (!file.has_variable(variable)) missing.emplace_back(variable);
    if (missing.empty()) return;
    if (missing.size() == variables_of_ours.size())
        throw UserError(
            fmt::format("{}: has none of a trajectory's variables: it was cut off, or is another file; "
                        "give the trajectory.nc of a run",
                        name));
    throw UserError(
        fmt::format("{}: not a trajectory of grainreel: it lacks {}; give the trajectory.nc of a run", name,
                    fmt::join(missing, ", ")));
}

// The library would read zeros beyond the end.
void check_whole(const NetcdfFile& file, std::size_t frames, const std::string& name) {
    const std::size_t whole = file.whole_records(frames);
    if (whole == frames) return;
    throw UserError(
        fmt::format("{}: was cut off: of its {} frames {} are whole; copy it again", name, frames, whole));
}

}  // namespace

struct TrajectoryReader::Impl {
    explicit Impl(const std::filesystem::path& path) : source(path.string()), file(NetcdfFile::open(path)) {
        check_complete(file, source);
        frames = file.length("frame");
        check_whole(file, frames, source);
        info.title = file.text_attribute(NC_GLOBAL, "title");
        info.program_version = file.text_attribute(NC_GLOBAL, "programVersion");
        info.capacity = file.length("atom");
        info.orientation = file.has_variable("orientation");
        std::istringstream names(file.text_attribute(file.find_variable("type"), "species"));
        for (std::string name; std::getline(names, name);) info.species.push_back(name);
        if (frames == 0) return;
        info.cell_origin = vector("cell_origin", 0);
        info.periodic_length = vector("cell_lengths", 0);
    }

    double number(const char* name, std::size_t frame) const {
        double value = 0;
        file.get(file.find_variable(name), {frame}, {1}, &value);
        return value;
    }

    Vec3 vector(const char* name, std::size_t frame) const {
        Vec3 value;
        file.get(file.find_variable(name), {frame, 0}, {1, 3}, value.data());
        return value;
    }

    std::vector<std::int32_t> integers(const char* name, std::size_t frame, std::size_t grains) const {
        std::vector<std::int32_t> values(grains);
        if (grains > 0) file.get(file.find_variable(name), {frame, 0}, {1, grains}, values.data());
        return values;
    }

    std::vector<double> rows(const char* name, std::size_t frame, std::size_t grains,
                             std::size_t width) const {
        std::vector<double> values(grains * width);
        if (grains > 0) file.get(file.find_variable(name), {frame, 0, 0}, {1, grains, width}, values.data());
        return values;
    }

    std::vector<Vec3> vectors(const char* name, std::size_t frame, std::size_t grains) const {
        const std::vector<double> flat = rows(name, frame, grains, 3);
        std::vector<Vec3> values(grains);
        for (std::size_t i = 0; i < grains; ++i) values[i] = Eigen::Map<const Vec3>(flat.data() + 3 * i);
        return values;
    }

    void read_grains(std::size_t index, Frame& frame) const {
        const double grains = number("grains", index);
        if (!(grains >= 0 && grains <= static_cast<double>(info.capacity)))
            throw UserError(fmt::format(
                "{}: frame {} says that it has {} grains, in a file with places for {}; copy it again",
                source, index, grains, info.capacity));
        const auto n = static_cast<std::size_t>(grains);
        frame.id = integers("id", index, n);
        frame.species = integers("type", index, n);
        for (std::int32_t& species : frame.species) --species;
        frame.radius = rows("radius", index, n, 1);
        frame.position = vectors("coordinates", index, n);
        frame.velocity = vectors("velocities", index, n);
        frame.spin = vectors("spin", index, n);
        if (!info.orientation) return;
        const std::vector<double> flat = rows("orientation", index, n, 4);
        for (std::size_t i = 0; i < n; ++i) frame.orientation.emplace_back(flat.data() + 4 * i);  // x y z w
    }

    std::string source;  // for messages
    NetcdfFile file;
    std::size_t frames = 0;
    TrajectoryInfo info;
};

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
TrajectoryReader::~TrajectoryReader() = default;

std::size_t TrajectoryReader::frames() const {
    return impl_->frames;
}
const TrajectoryInfo& TrajectoryReader::info() const {
    return impl_->info;
}

Frame TrajectoryReader::read(std::size_t index) const {
    Frame frame = read_moment(index);
    impl_->read_grains(index, frame);
    return frame;
}

Frame TrajectoryReader::read_moment(std::size_t index) const {
    GRAINREEL_CHECK(index < impl_->frames);
    Frame frame;
    frame.step = std::llround(impl_->number("step", index));
    frame.time = impl_->number("time", index);
    frame.cycles = impl_->number("cycles", index);
    frame.phase = impl_->number("phase", index);
    frame.wall_offset = impl_->vector("wall_offset", index);
    frame.wall_velocity = impl_->vector("wall_velocity", index);
    frame.floor_offset = impl_->vector("floor_offset", index);
    frame.floor_velocity = impl_->vector("floor_velocity", index);
    return frame;
}

}  // namespace grainreel
