#include <netcdf.h>

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/output/netcdf_file.hpp"
#include "engine/output/trajectory.hpp"

namespace grainreel {

namespace {

// CDF-2 allows 4 GiB minus 4 bytes a variable and record; coordinates are the largest.
NetcdfFormat format_for(std::size_t capacity) {
    return capacity * 3 * sizeof(double) < (std::size_t{1} << 32) - 4 ? NetcdfFormat::cdf2
                                                                      : NetcdfFormat::cdf5;
}

template <class Value>
Value fill_value();
template <>
float fill_value<float>() {
    return NC_FILL_FLOAT;
}
template <>
double fill_value<double>() {
    return NC_FILL_DOUBLE;
}

}  // namespace

struct TrajectoryWriter::Impl {
    Impl(const std::filesystem::path& path, const TrajectoryInfo& trajectory)
        : name(path.string()),
          info(trajectory),
          file(NetcdfFile::create(path, format_for(trajectory.capacity))) {}

    void define();
    void define_frame_variables(int frame, int spatial);
    void define_grain_variables(int frame, int atom, int spatial);
    void write_labels();
    void write_pose(const Frame& frame);
    void write_grains(const Frame& frame);

    void put(int variable, double value) { file.put(variable, {frames}, {1}, &value); }
    void put(int variable, const Vec3& value) { file.put(variable, {frames, 0}, {1, 3}, value.data()); }
    void put_numbers(int variable, const std::vector<std::int32_t>& values, std::int32_t offset);
    template <class Value, class Of>
    void put_rows(int variable, std::size_t width, std::size_t grains, const Of& of);

    std::string name;
    TrajectoryInfo info;
    NetcdfFile file;
    std::size_t frames = 0;

    int spatial_label = -1, cell_label = -1, angle_label = -1;
    int time = -1, cycles = -1, phase = -1, step = -1, grains = -1;
    int wall_offset = -1, wall_velocity = -1, floor_offset = -1, floor_velocity = -1;
    int cell_origin = -1, cell_lengths = -1, cell_angles = -1;
    int id = -1, type = -1, radius = -1, coordinates = -1, velocities = -1, spin = -1, orientation = -1;
};

void TrajectoryWriter::Impl::define() {
    file.attribute(NC_GLOBAL, "title", info.title);
    file.attribute(NC_GLOBAL, "application", "grainreel");
    file.attribute(NC_GLOBAL, "program", "grainreel");
    file.attribute(NC_GLOBAL, "programVersion", info.program_version);
    file.attribute(NC_GLOBAL, "Conventions", "AMBER");
    file.attribute(NC_GLOBAL, "ConventionVersion", "1.0");
    file.attribute(NC_GLOBAL, "deviations",
                   "SI units, see the units of each variable; time and coordinates are double; a place "
                   "without a grain has id -1 and fill values");
    const int frame = file.dimension("frame", NC_UNLIMITED);
    const int atom = file.dimension("atom", std::max<std::size_t>(info.capacity, 1));
    const int spatial = file.dimension("spatial", 3);
    const int cell_spatial = file.dimension("cell_spatial", 3);
    const int cell_angular = file.dimension("cell_angular", 3);
    const int label = file.dimension("label", 5);

    spatial_label = file.variable("spatial", NC_CHAR, {spatial});
    cell_label = file.variable("cell_spatial", NC_CHAR, {cell_spatial});
    angle_label = file.variable("cell_angular", NC_CHAR, {cell_angular, label});
    cell_origin = file.variable("cell_origin", NC_DOUBLE, {frame, cell_spatial}, "meter");
    cell_lengths = file.variable("cell_lengths", NC_DOUBLE, {frame, cell_spatial}, "meter");
    cell_angles = file.variable("cell_angles", NC_DOUBLE, {frame, cell_angular}, "degree");
    define_frame_variables(frame, spatial);
    define_grain_variables(frame, atom, spatial);
    file.end_definitions();
}

void TrajectoryWriter::Impl::define_frame_variables(int frame, int spatial) {
    time = file.variable("time", NC_DOUBLE, {frame}, "second");
    cycles = file.variable("cycles", NC_DOUBLE, {frame}, "period of the drive");
    phase = file.variable("phase", NC_DOUBLE, {frame}, "turn");
    step = file.variable("step", NC_DOUBLE, {frame}, "step");
    grains = file.variable("grains", NC_INT, {frame});
    wall_offset = file.variable("wall_offset", NC_DOUBLE, {frame, spatial}, "meter");
    wall_velocity = file.variable("wall_velocity", NC_DOUBLE, {frame, spatial}, "meter/second");
    floor_offset = file.variable("floor_offset", NC_DOUBLE, {frame, spatial}, "meter");
    floor_velocity = file.variable("floor_velocity", NC_DOUBLE, {frame, spatial}, "meter/second");
}

void TrajectoryWriter::Impl::define_grain_variables(int frame, int atom, int spatial) {
    id = file.variable("id", NC_INT, {frame, atom});
    type = file.variable("type", NC_INT, {frame, atom});
    file.attribute(type, "species", fmt::format("{}", fmt::join(info.species, "\n")));
    radius = file.variable("radius", NC_DOUBLE, {frame, atom}, "meter");
    coordinates = file.variable("coordinates", NC_DOUBLE, {frame, atom, spatial}, "meter");
    velocities = file.variable("velocities", NC_FLOAT, {frame, atom, spatial}, "meter/second");
    spin = file.variable("spin", NC_FLOAT, {frame, atom, spatial}, "radian/second");
    if (info.orientation) {
        const int quaternion = file.dimension("quaternion", 4);
        orientation = file.variable("orientation", NC_FLOAT, {frame, atom, quaternion});
    }
}

void TrajectoryWriter::Impl::write_labels() {
    file.put(spatial_label, {0}, {3}, "xyz");
    file.put(cell_label, {0}, {3}, "abc");
    file.put(angle_label, {0, 0}, {3, 5}, "alphabeta gamma");
    file.sync(0);
}

void TrajectoryWriter::Impl::write_pose(const Frame& frame) {
    put(time, frame.time);
    put(cycles, frame.cycles);
    put(phase, frame.phase);
    put(step, static_cast<double>(frame.step));
    const int count = static_cast<int>(frame.size());
    file.put(grains, {frames}, {1}, &count);
    put(wall_offset, frame.wall_offset);
    put(wall_velocity, frame.wall_velocity);
    put(floor_offset, frame.floor_offset);
    put(floor_velocity, frame.floor_velocity);
    put(cell_origin, info.cell_origin);
    put(cell_lengths, info.periodic_length);
    put(cell_angles, Vec3(90, 90, 90));
}

void TrajectoryWriter::Impl::put_numbers(int variable, const std::vector<std::int32_t>& values,
                                         std::int32_t offset) {
    std::vector<int> row(std::max<std::size_t>(info.capacity, 1), -1);
    std::transform(values.begin(), values.end(), row.begin(),
                   [offset](std::int32_t v) { return v + offset; });
    file.put(variable, {frames, 0}, {1, row.size()}, row.data());
}

// of(grain, component) gives the values; places without a grain get the fill value.
template <class Value, class Of>
void TrajectoryWriter::Impl::put_rows(int variable, std::size_t width, std::size_t count, const Of& of) {
    const std::size_t capacity = std::max<std::size_t>(info.capacity, 1);
    std::vector<Value> rows(capacity * width, fill_value<Value>());
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < width; ++k)
            rows[i * width + k] = static_cast<Value>(of(i, static_cast<int>(k)));
    }
    std::vector<std::size_t> start{frames, 0}, size{1, capacity};
    if (width > 1) {
        start.push_back(0);
        size.push_back(width);
    }
    file.put(variable, start, size, rows.data());
}

void TrajectoryWriter::Impl::write_grains(const Frame& f) {
    const std::size_t n = f.size();
    put_numbers(id, f.id, 0);
    put_numbers(type, f.species, 1);
    put_rows<double>(radius, 1, n, [&](std::size_t i, int) { return f.radius[i]; });
    put_rows<double>(coordinates, 3, n, [&](std::size_t i, int k) { return f.position[i][k]; });
    put_rows<float>(velocities, 3, n, [&](std::size_t i, int k) { return f.velocity[i][k]; });
    put_rows<float>(spin, 3, n, [&](std::size_t i, int k) { return f.spin[i][k]; });
    if (info.orientation) {
        put_rows<float>(orientation, 4, n,
                        [&](std::size_t i, int k) { return f.orientation[i].coeffs()[k]; });
    }
}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& path, const TrajectoryInfo& info)
    : impl_(std::make_unique<Impl>(path, info)) {
    impl_->define();
    impl_->write_labels();
}

TrajectoryWriter::~TrajectoryWriter() = default;

void TrajectoryWriter::write(const Frame& frame) {
    GRAINREEL_CHECK(!impl_->info.orientation || frame.orientation.size() == frame.size());
    if (frame.size() > impl_->info.capacity) {
        throw RunError(
            fmt::format("{}: a frame of {} grains in a file with places for {}; give TrajectoryInfo a "
                        "larger capacity",
                        impl_->name, frame.size(), impl_->info.capacity));
    }
    impl_->write_pose(frame);
    impl_->write_grains(frame);
    impl_->file.sync(impl_->frames + 1);
    ++impl_->frames;  // only now: one that failed does not count
}

std::int64_t TrajectoryWriter::frames() const {
    return static_cast<std::int64_t>(impl_->frames);
}

}  // namespace grainreel
