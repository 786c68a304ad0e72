// Writes trajectory.nc frame by frame. What is written stays whole when a write fails.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <netcdf.h>
#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "engine/base/error.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/files/trajectory/trajectory_layout.hpp"

namespace grainreel {

namespace {

// CDF-2 allows 4 GiB minus 4 bytes for a variable in a record; coordinates are the largest variable.
NetcdfFormat format_for(std::size_t capacity) {
    return capacity * 3 * sizeof(double) < (std::size_t{1} << 32) - 4 ? NetcdfFormat::cdf2
                                                                      : NetcdfFormat::cdf5;
}

}  // namespace

struct TrajectoryWriter::Impl {
    Impl(const std::filesystem::path& path, const TrajectoryInfo& trajectory, NetcdfFile to)
        : name(path.string()),
          info(trajectory),
          places(std::max<std::size_t>(trajectory.capacity, 1)),
          file(std::move(to)) {}

    void define();
    void find_variables();
    void read_kept(const std::filesystem::path& path);
    void define_dimensions();
    void define_bodies();
    void define_variable(const TrajectoryVariable& variable, const char* of);
    void write_labels();
    Checksum begin_sum() const { return begin_checksum(frames, places, info.species, info.orientation); }
    void write_pose(const State& frame);
    void write_turn(const State& frame, Checksum& sum);
    void write_bodies(const State& frame, Checksum& sum);
    void write_grains(const State& frame);
    void write_sum(const char* variable, const Checksum& sum);
    void keep(const State& frame);
    void add_place(const State& frame, std::size_t i);

    std::string name;
    TrajectoryInfo info;
    std::size_t places;  // number of places for grains
    NetcdfFile file;
    std::size_t frames = 0;
    State kept;                                                     // with traffic: all grains so far
    std::vector<int> present;                                       // for each of them: 1 if it is there now
    std::vector<std::size_t> by_id;                                 // their places by rising id
    std::map<std::string, int, std::less<>> dimensions, variables;  // by name
};

void TrajectoryWriter::Impl::define() {
    file.attribute(NC_GLOBAL, "title", info.title);
    file.attribute(NC_GLOBAL, "application", "grainreel");
    file.attribute(NC_GLOBAL, "program", "grainreel");
    file.attribute(NC_GLOBAL, "programVersion", info.program_version);
    file.attribute(NC_GLOBAL, "Conventions", "AMBER");
    file.attribute(NC_GLOBAL, "ConventionVersion", "1.0");
    file.attribute(
        NC_GLOBAL, "deviations",
        std::string("SI units, see the units of each variable; time and coordinates are double; a place "
                    "without a grain has id -1, a radius of 1e-9 and the container's lowest corner") +
            (info.traffic ? "; the place of a grain that has gone keeps its id, and `present` is 0" : ""));
    for (const auto& [attribute, text] : info.facts.attributes) file.attribute(NC_GLOBAL, attribute, text);
    define_dimensions();
    const int cell_angular = dimensions["cell_angular"];
    variables["spatial"] = file.variable("spatial", NC_CHAR, {dimensions["spatial"]});
    variables["cell_spatial"] = file.variable("cell_spatial", NC_CHAR, {dimensions["cell_spatial"]});
    variables["cell_angular"] = file.variable("cell_angular", NC_CHAR, {cell_angular, dimensions["label"]});
    for (const TrajectoryLabel& label : label_variables)
        file.attribute(variables[label.name], "long_name", label.about);
    for (const TrajectoryVariable& variable : frame_variables) define_variable(variable, nullptr);
    if (info.container_turns)
        for (const TrajectoryVariable& variable : turn_variables) define_variable(variable, nullptr);
    if (!info.bodies.empty()) define_bodies();
    if (!info.meshes.empty()) define_meshes(file, info.meshes, dimensions["spatial"], dimensions["checksum"]);
    for (const TrajectoryVariable& variable : grain_variables) define_variable(variable, "atom");
    if (info.orientation) define_variable(orientation_variable, "atom");
    if (info.contact_numbers) define_variable(contact_number_variable, "atom");
    if (info.masses) define_variable(mass_variable, "atom");
    if (info.shapes)
        for (const auto* variable : {&half_lengths_variable, &blockiness_variable})
            define_variable(*variable, "atom");
    if (info.traffic) define_variable(present_variable, "atom");
    if (!info.velocities) file.attribute(variables["velocities"], unknown_attribute, unknown_about);
    if (!info.spins) file.attribute(variables["spin"], unknown_attribute, unknown_about);
    if (!info.steps_known) file.attribute(variables["step"], kStepsOf, kStepsOfFrames);
    if (info.first_id != 0) {
        file.attribute(variables["id"], kFirstId, std::to_string(info.first_id));
        file.attribute(variables["id"], "comment", kFromFirst);
    }
    file.attribute(variables["type"], "species", fmt::format("{}", fmt::join(info.species, "\n")));
    if (!info.facts.densities.empty())
        file.attribute(variables["type"], "density",
                       fmt::format("{} kg m-3", fmt::join(info.facts.densities, " ")));
    for (const auto& [sum, about] :
         {std::pair{frame_checksum, frame_checksum_about}, {grain_checksum, grain_checksum_about}}) {
        variables[sum] = file.variable(sum, NC_INT, {dimensions["frame"], dimensions["checksum"]}, "1");
        file.attribute(variables[sum], "long_name", about);
        file.attribute(variables[sum], "comment", checksum_comment);
    }
    file.end_definitions();
}

void TrajectoryWriter::Impl::define_dimensions() {
    dimensions["frame"] = file.dimension("frame", NC_UNLIMITED);
    dimensions["atom"] = file.dimension("atom", places);
    for (const char* three : {"spatial", "cell_spatial", "cell_angular"})
        dimensions[three] = file.dimension(three, 3);
    dimensions["label"] = file.dimension("label", 5);
    dimensions["checksum"] = file.dimension("checksum", 2);
    if (info.orientation || info.container_turns || !info.bodies.empty())
        dimensions["quaternion"] = file.dimension("quaternion", 4);
    if (info.shapes) dimensions["power"] = file.dimension("power", 2);
    if (!info.bodies.empty()) dimensions["body"] = file.dimension("body", info.bodies.size());
}

void TrajectoryWriter::Impl::define_bodies() {
    for (const TrajectoryVariable& variable :
         info.meshes.empty() ? body_variables : body_variables_with_meshes)
        define_variable(variable, "body");
    file.attribute(variables["body_place"], "names", fmt::format("{}", fmt::join(info.bodies, "\n")));
}

// Finds the variables in an existing file.
void TrajectoryWriter::Impl::find_variables() {
    const auto find = [&](const char* variable) { variables[variable] = file.find_variable(variable); };
    for (const TrajectoryVariable& variable : frame_variables) find(variable.name);
    for (const TrajectoryVariable& variable : grain_variables) find(variable.name);
    if (info.container_turns)
        for (const TrajectoryVariable& variable : turn_variables) find(variable.name);
    if (!info.bodies.empty())
        for (const TrajectoryVariable& variable : body_variables) find(variable.name);
    if (info.orientation) find(orientation_variable.name);
    if (info.contact_numbers) find(contact_number_variable.name);
    if (info.masses) find(mass_variable.name);
    if (info.shapes) find(half_lengths_variable.name), find(blockiness_variable.name);
    if (info.traffic) find(present_variable.name);
    find(frame_checksum);
    find(grain_checksum);
}

// Reads from the frames of the file which grains there have been.
void TrajectoryWriter::Impl::read_kept(const std::filesystem::path& path) {
    const TrajectoryReader before(path);
    for (std::size_t k = 0; k < frames; ++k) keep(before.read(k));
}

// of: "atom" or "body"; null for a variable of the frame itself.
void TrajectoryWriter::Impl::define_variable(const TrajectoryVariable& variable, const char* of) {
    std::vector<int> shape{dimensions["frame"]};
    if (of != nullptr) shape.push_back(dimensions[of]);
    if (variable.dimension != nullptr) shape.push_back(dimensions[variable.dimension]);
    variables[variable.name] = file.variable(variable.name, variable.type, shape, variable.units);
    file.attribute(variables[variable.name], "long_name", variable.about);
    if (*variable.comment != 0) file.attribute(variables[variable.name], "comment", variable.comment);
}

void TrajectoryWriter::Impl::write_labels() {
    file.put(variables["spatial"], {0}, {3}, "xyz");
    file.put(variables["cell_spatial"], {0}, {3}, "abc");
    file.put(variables["cell_angular"], {0, 0}, {3, 5}, "alphabeta gamma");
    if (!info.meshes.empty()) write_meshes(file, info.meshes);
    file.sync(0);
}

void TrajectoryWriter::Impl::write_pose(const State& frame) {
    Checksum sum = begin_sum();
    auto variable = frame_variables.begin();
    const auto put = [&](const auto* values, std::size_t count) {
        std::vector<std::size_t> start{frames}, size{1};
        if (variable->dimension != nullptr) start.push_back(0), size.push_back(count);
        file.put(variables[variable->name], start, size, values);
        sum.add(values, count);
        ++variable;
    };
    const double step = static_cast<double>(frame.step);
    const int count = static_cast<int>(frame.size());
    for (const double* number : {&frame.time, &frame.cycles, &frame.phase, &step}) put(number, 1);
    put(&count, 1);
    for (const Vec3& vector : {frame.container().place, frame.container().velocity, frame.floor().place,
                               frame.floor().velocity, info.cell.origin, info.cell.length, info.cell.angles})
        put(vector.data(), 3);
    GRAINREEL_CHECK(variable == frame_variables.end());
    if (info.container_turns) write_turn(frame, sum);
    if (!info.bodies.empty()) write_bodies(frame, sum);
    write_sum(frame_checksum, sum);
}

void TrajectoryWriter::Impl::write_turn(const State& frame, Checksum& sum) {
    const TrajectoryVariable* variable = turn_variables.data();
    const auto put = [&](const double* numbers, std::size_t count) {
        file.put(variables[variable->name], {frames, 0}, {1, count}, numbers);
        sum.add(numbers, count);
        ++variable;
    };
    for (const BodyPose* pose : {&frame.container(), &frame.floor()}) {
        put(pose->rotation.coeffs().data(), 4);
        put(pose->spin.data(), 3);
    }
}

void TrajectoryWriter::Impl::write_bodies(const State& frame, Checksum& sum) {
    std::array<std::vector<double>, body_variables.size()> values;
    const auto add = [&](std::size_t k, const auto& numbers) {
        values[k].insert(values[k].end(), numbers.begin(), numbers.end());
    };
    for (std::size_t b = kFirstPlaneBody; b < frame.bodies.size(); ++b) {
        const BodyPose& pose = frame.bodies[b];
        add(0, pose.place), add(1, pose.rotation.coeffs()), add(2, pose.velocity), add(3, pose.spin);
    }
    const std::size_t count = info.bodies.size();
    for (std::size_t k = 0; k < values.size(); ++k) {
        file.put(variables[body_variables[k].name], {frames, 0, 0}, {1, count, values[k].size() / count},
                 values[k].data());
        sum.add(values[k].data(), values[k].size());
    }
}

// of(grain, component) gives the values of grains for which there(grain) is true; the others get those of
// `absent`.
template <class Value, class There, class Of>
std::vector<Value> rows_of(std::size_t places, const std::vector<Value>& absent, std::size_t grains,
                           const There& there, const Of& of) {
    std::vector<Value> rows;
    rows.reserve(places * absent.size());
    for (std::size_t i = 0; i < places; ++i)
        for (std::size_t k = 0; k < absent.size(); ++k)
            rows.push_back(i < grains && there(i) ? static_cast<Value>(of(i, static_cast<int>(k)))
                                                  : absent[k]);
    return rows;
}

void TrajectoryWriter::Impl::write_grains(const State& f) {
    Checksum sum = begin_sum();
    const TrajectoryVariable* variable = grain_variables.data();
    const auto is_here = [&](std::size_t i) { return !info.traffic || present[i] != 0; };
    const auto has_been = [](std::size_t) { return true; };
    const auto put = [&](const auto& absent, const auto& there, const auto& of) {
        const auto rows = rows_of(places, absent, f.size(), there, of);
        std::vector<std::size_t> start{frames, 0}, size{1, places};
        if (absent.size() > 1) start.push_back(0), size.push_back(absent.size());
        file.put(variables[variable->name], start, size, rows.data());
        sum.add(rows.data(), rows.size());
        ++variable;
    };
    using Ints = std::vector<int>;
    using Floats = std::vector<float>;
    using Doubles = std::vector<double>;
    const Vec3& corner = info.cell.origin;
    put(Ints{-1}, has_been, [&](std::size_t i, int) { return f.id[i]; });
    put(Ints{-1}, has_been, [&](std::size_t i, int) { return f.species[i] + 1; });
    put(Doubles{kAbsentRadius}, is_here, [&](std::size_t i, int) { return f.radius[i]; });
    put(Doubles(corner.begin(), corner.end()), is_here,
        [&](std::size_t i, int k) { return f.position[i][k]; });
    put(Floats{0, 0, 0}, is_here, [&](std::size_t i, int k) { return f.velocity[i][k]; });
    put(Floats{0, 0, 0}, is_here, [&](std::size_t i, int k) { return f.spin[i][k]; });
    GRAINREEL_CHECK(variable == grain_variables.data() + grain_variables.size());
    variable = &orientation_variable;
    if (info.orientation)
        put(Floats{0, 0, 0, 1}, is_here, [&](std::size_t i, int k) { return f.orientation[i].coeffs()[k]; });
    variable = &contact_number_variable;
    if (info.contact_numbers) put(Ints{0}, is_here, [&](std::size_t i, int) { return f.contact_number[i]; });
    variable = &mass_variable;
    if (info.masses) put(Doubles{0}, is_here, [&](std::size_t i, int) { return f.mass[i]; });
    variable = &half_lengths_variable;
    if (info.shapes) put(Floats{0, 0, 0}, is_here, [&](std::size_t i, int k) { return f.shape[i].half[k]; });
    variable = &blockiness_variable;
    if (info.shapes)
        put(Floats{2, 2}, is_here,
            [&](std::size_t i, int k) { return k == 0 ? f.shape[i].along : f.shape[i].around; });
    variable = &present_variable;
    if (info.traffic) put(Ints{0}, has_been, [&](std::size_t i, int) { return present[i]; });
    write_sum(grain_checksum, sum);
}

// Takes a frame into `kept` and `present`. A new grain gets the place after all earlier ones. In our runs its
// id is larger than theirs; in runs of other programs it may be between them.
void TrajectoryWriter::Impl::keep(const State& frame) {
    present.assign(kept.size(), 0);
    std::size_t next = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        while (next < by_id.size() && kept.id[by_id[next]] < frame.id[i]) ++next;
        if (next == by_id.size() || kept.id[by_id[next]] != frame.id[i]) {
            add_place(frame, i);
            by_id.insert(by_id.begin() + static_cast<std::ptrdiff_t>(next), kept.size() - 1);
        }
        const std::size_t at = by_id[next];
        kept.position[at] = frame.position[i];
        kept.velocity[at] = frame.velocity[i];
        kept.spin[at] = frame.spin[i];
        if (info.orientation) kept.orientation[at] = frame.orientation[i];
        if (info.contact_numbers) kept.contact_number[at] = frame.contact_number[i];
        if (info.masses) kept.mass[at] = frame.mass[i];
        if (info.shapes) kept.shape[at] = frame.shape[i];
        present[at] = 1;
    }
}

void TrajectoryWriter::Impl::add_place(const State& frame, std::size_t i) {
    if (kept.size() == places)
        throw RunError("{}: more grains came than the {} that the file has places for", name, places);
    kept.id.push_back(frame.id[i]);
    kept.species.push_back(frame.species[i]);
    kept.radius.push_back(frame.radius[i]);
    kept.position.emplace_back(), kept.velocity.emplace_back(), kept.spin.emplace_back();
    if (info.orientation) kept.orientation.emplace_back();
    if (info.contact_numbers) kept.contact_number.push_back(0);
    if (info.masses) kept.mass.push_back(0);
    if (info.shapes) kept.shape.emplace_back();
    present.push_back(1);
}

void TrajectoryWriter::Impl::write_sum(const char* variable, const Checksum& sum) {
    file.put(variables[variable], {frames, 0}, {1, 2}, sum.words().data());
}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& path, const TrajectoryInfo& info)
    : impl_(std::make_unique<Impl>(path, info, NetcdfFile::create(path, format_for(info.capacity)))) {
    impl_->define();
    impl_->write_labels();
}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& path, const TrajectoryInfo& info,
                                   std::size_t frames)
    : impl_(std::make_unique<Impl>(path, info, NetcdfFile::append(path, frames))) {
    impl_->info.contact_numbers = impl_->file.has_variable(contact_number_variable.name);
    impl_->find_variables();
    impl_->frames = frames;
    if (info.traffic) impl_->read_kept(path);
}

TrajectoryWriter::~TrajectoryWriter() = default;

bool TrajectoryWriter::goes_on_with(const TrajectoryInfo& info, const std::filesystem::path& path) {
    const TrajectoryInfo there = TrajectoryReader(path).info();
    if (there.species != info.species || there.bodies != info.bodies || there.traffic != info.traffic ||
        there.orientation != info.orientation || there.masses != info.masses || there.shapes != info.shapes ||
        there.container_turns != info.container_turns || !same_meshes(there.meshes, info.meshes) ||
        !there.checksums)
        throw UserError("{}: is of another scene, or of another version of grainreel", path.string());
    return there.capacity == std::max<std::size_t>(info.capacity, 1);
}

KeptRecords TrajectoryWriter::kept_of(const std::filesystem::path& path, std::size_t frames) {
    const TrajectoryReader reader(path);
    for (std::size_t k = 0; reader.info().traffic && k < frames; ++k) reader.read(k);
    return NetcdfFile::kept_of(path, frames);
}

void TrajectoryWriter::write_again(const std::filesystem::path& path, std::size_t frames,
                                   const std::filesystem::path& to, TrajectoryInfo info) {
    const TrajectoryReader reader(path);
    info.contact_numbers = reader.info().contact_numbers;
    TrajectoryWriter writer(to, info);
    for (std::size_t k = 0; k < frames; ++k) {
        writer.set_cell(reader.cell(k));
        writer.write(reader.read(k));
    }
}

void TrajectoryWriter::set_cell(const TrajectoryCell& cell) {
    impl_->info.cell = cell;
}

void TrajectoryWriter::write(const State& frame) {
    GRAINREEL_CHECK(!impl_->info.orientation || frame.orientation.size() == frame.size());
    GRAINREEL_CHECK(!impl_->info.contact_numbers || frame.contact_number.size() == frame.size());
    GRAINREEL_CHECK(!impl_->info.masses || frame.mass.size() == frame.size());
    GRAINREEL_CHECK(!impl_->info.shapes || frame.shape.size() == frame.size());
    GRAINREEL_CHECK(frame.bodies.size() == kFirstPlaneBody + impl_->info.bodies.size());
    if (frame.size() > impl_->info.capacity) {
        throw RunError("{}: has places for {} grains, and a frame has {}", impl_->name, impl_->info.capacity,
                       frame.size());
    }
    if (impl_->info.traffic) impl_->keep(frame);
    impl_->write_pose(frame);
    impl_->write_grains(impl_->info.traffic ? impl_->kept : frame);
    impl_->file.sync(impl_->frames + 1);
    ++impl_->frames;  // only now, because a frame that failed does not count
}

std::int64_t TrajectoryWriter::frames() const {
    return static_cast<std::int64_t>(impl_->frames);
}

}  // namespace grainreel
