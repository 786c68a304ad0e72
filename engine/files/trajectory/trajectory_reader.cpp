// Reads trajectory.nc, our own or one of the same convention.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <netcdf.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/files/trajectory/trajectory_layout.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_bodies = 1000;
constexpr double most_steps = 9007199254740992;  // 2^53; doubles cannot hold all larger whole numbers

// Throws UserError where a variable is missing. A file of another program with the same convention is
// accepted if it has them all.
void check_complete(const NetcdfFile& file, const std::string& name) {
    std::vector<std::string> missing;
    const auto check = [&](const TrajectoryVariable& variable) {
        if (!file.has_variable(variable.name)) missing.emplace_back(variable.name);
    };
    std::for_each(frame_variables.begin(), frame_variables.end(), check);
    std::for_each(grain_variables.begin(), grain_variables.end(), check);
    if (missing.empty() && !file.has_records())
        throw UserError("{}: its header is damaged (its frames are not counted); copy the file again", name);
    if (missing.empty()) return;
    if (missing.size() == frame_variables.size() + grain_variables.size())
        throw UserError(
            "{}: has none of a trajectory's variables: it was cut off, or is another file; "
            "give the trajectory.nc of a run",
            name);
    throw UserError("{}: not a trajectory of grainreel: it lacks {}; give the trajectory.nc of a run", name,
                    fmt::join(missing, ", "));
}

// Throws UserError where more than one of the counted frames is not whole; the library would read zeros
// beyond the end of the file. A killed run may leave one such frame: if a frame lies in the first block of
// the file, the library writes it together with the count of frames, and the count first.
void check_whole(std::size_t counted, std::size_t whole, const std::string& name) {
    if (whole + 1 < counted)
        throw UserError("{}: was cut off: of its {} frames {} are whole; copy it again", name, counted,
                        whole);
}

}  // namespace

struct TrajectoryReader::Impl {
    explicit Impl(const std::filesystem::path& path) : source(path.string()), file(NetcdfFile::open(path)) {
        check_complete(file, source);
        const std::size_t counted = file.length("frame"), on_disk = file.records_on_disk(counted);
        check_whole(counted, on_disk, source);
        frames = std::min(counted, on_disk);
        cut_off = frames < counted;
        uncounted = on_disk - frames;
        info.title = file.text_attribute(NC_GLOBAL, "title");
        info.program_version = file.text_attribute(NC_GLOBAL, "programVersion");
        info.capacity = file.length("atom");
        info.orientation = file.has_variable(orientation_variable.name);
        info.contact_numbers = file.has_variable(contact_number_variable.name);
        info.masses = file.has_variable(mass_variable.name);
        info.shapes = file.has_variable(half_lengths_variable.name);
        info.velocities = is_known("velocities");
        info.spins = is_known("spin");
        info.traffic = file.has_variable(present_variable.name);
        if (file.has_variable(body_variables.front().name)) read_bodies();
        info.container_turns = file.has_variable(turn_variables.front().name);
        info.meshes = read_meshes(file, path, kFirstPlaneBody + info.bodies.size());
        std::istringstream names(file.text_attribute(file.find_variable("type"), "species"));
        for (std::string name; std::getline(names, name);) info.species.push_back(name);
        read_densities();
        info.steps_known = file.text_attribute(file.find_variable("step"), kStepsOf).empty();
        info.first_id = file.text_attribute(file.find_variable("id"), kFirstId) == "1" ? 1 : 0;
        info.checksums = file.has_variable(frame_checksum) && file.has_variable(grain_checksum);
        if (frames == 0) return;
        info.cell = cell(0);
    }

    TrajectoryCell cell(std::size_t frame) const {
        TrajectoryCell cell;
        file.get(file.find_variable("cell_origin"), {frame, 0}, {1, 3}, cell.origin.data());
        file.get(file.find_variable("cell_lengths"), {frame, 0}, {1, 3}, cell.length.data());
        file.get(file.find_variable("cell_angles"), {frame, 0}, {1, 3}, cell.angles.data());
        return cell;
    }

    bool is_known(const char* variable) const {
        return file.text_attribute(file.find_variable(variable), unknown_attribute).empty();
    }

    // "2500 7800 kg m-3" by species; missing in files of earlier versions.
    void read_densities() {
        std::istringstream text(file.text_attribute(file.find_variable("type"), "density"));
        for (double density = 0; info.facts.densities.size() < info.species.size() && text >> density;)
            info.facts.densities.push_back(density);
    }

    // The dimension `body` gives the number of bodies; their names are only for people.
    void read_bodies() {
        const std::size_t bodies = file.length("body");
        if (bodies > most_bodies)
            throw UserError("{}: says that it has {} walls beside the container's; copy it again", source,
                            bodies);
        std::istringstream names(file.text_attribute(file.find_variable("body_place"), "names"));
        info.bodies.resize(bodies);
        for (std::string& name : info.bodies) std::getline(names, name);
    }

    [[noreturn]] void damaged(std::size_t frame, const std::string& what) const {
        throw DamagedFrame(fmt::format(
            "{}: frame {} (the first is 0) is damaged: {}; copy the file again, or run the scene again",
            source, frame, what));
    }

    Checksum begin_sum(std::size_t frame) const {
        return begin_checksum(frame, info.capacity, info.species, info.orientation);
    }

    void check_sum(const char* variable, std::size_t frame, const Checksum& sum) const {
        if (!info.checksums) return;
        std::array<int, 2> words{};
        file.get(file.find_variable(variable), {frame, 0}, {1, 2}, words.data());
        if (words != sum.words()) damaged(frame, "its checksum is not that of its numbers");
    }

    // Reads the numbers as stored and adds them to the sum. places: 0 for a variable of the frame.
    template <class Value>
    std::vector<Value> read(const TrajectoryVariable& variable, std::size_t frame, std::size_t places,
                            std::size_t width, Checksum& sum) const {
        std::vector<std::size_t> start{frame}, count{1};
        if (places > 0) start.push_back(0), count.push_back(places);
        if (variable.dimension != nullptr) start.push_back(0), count.push_back(width);
        const int id = file.find_variable(variable.name);
        std::vector<Value> values(std::max<std::size_t>(places, 1) * width);
        file.get(id, start, count, values.data());
        sum.add(values.data(), values.size());
        return values;
    }

    struct Moment {
        State frame;  // without its grains
        std::size_t grains = 0;
    };
    Moment read_moment(std::size_t index) const;
    void read_turn(std::size_t index, State& frame, Checksum& sum) const;
    void read_bodies(std::size_t index, State& frame, Checksum& sum) const;
    std::vector<std::size_t> places_of(std::size_t index, std::size_t n) const;
    void read_grains(std::size_t index, std::size_t n, State& frame) const;
    // here: the places of the grains. sum: gets the numbers that are read.
    void read_shapes(std::size_t index, const std::vector<std::size_t>& here, State& frame,
                     Checksum& sum) const;

    std::string source;  // for messages
    NetcdfFile file;
    std::size_t frames = 0, uncounted = 0;
    bool cut_off = false;
    TrajectoryInfo info;
};

TrajectoryReader::Impl::Moment TrajectoryReader::Impl::read_moment(std::size_t index) const {
    Checksum sum = begin_sum(index);
    auto variable = frame_variables.begin();
    const auto number = [&] { return read<double>(*variable++, index, 0, 1, sum).front(); };
    const auto vector = [&] { return Vec3(read<double>(*variable++, index, 0, 3, sum).data()); };
    State frame;
    frame.time = number();
    frame.cycles = number();
    frame.phase = number();
    const double step = number();
    const int count = read<int>(*variable++, index, 0, 1, sum).front();
    for (Vec3* pose : {&frame.container().place, &frame.container().velocity, &frame.floor().place,
                       &frame.floor().velocity})
        *pose = vector();
    // The variables of the cell are read for the checksum only.
    for (; variable != frame_variables.end(); ++variable) read<double>(*variable, index, 0, 3, sum);
    if (info.container_turns) read_turn(index, frame, sum);
    read_bodies(index, frame, sum);
    check_sum(frame_checksum, index, sum);
    if (auto fault = moment_fault(frame)) damaged(index, *fault);
    if (!(std::abs(step) <= most_steps)) damaged(index, fmt::format("its step is {:.3g}", step));
    if (count < 0 || static_cast<std::size_t>(count) > info.capacity)
        damaged(index, fmt::format("it says that it has {} grains, in a file with places for {}", count,
                                   info.capacity));
    frame.step = std::llround(step);
    return {std::move(frame), static_cast<std::size_t>(count)};
}

void TrajectoryReader::Impl::read_turn(std::size_t index, State& frame, Checksum& sum) const {
    auto variable = turn_variables.begin();
    const auto next = [&](std::size_t width) { return read<double>(*variable++, index, 0, width, sum); };
    for (BodyPose* pose : {&frame.container(), &frame.floor()}) {
        pose->rotation = Quaternion(next(4).data());
        pose->spin = Vec3(next(3).data());
    }
}

// The poses of planes and meshes; container and floor have theirs already.
void TrajectoryReader::Impl::read_bodies(std::size_t index, State& frame, Checksum& sum) const {
    const std::size_t bodies = info.bodies.size();
    if (bodies == 0) return;
    auto variable = body_variables.begin();
    const auto next = [&](std::size_t width) { return read<double>(*variable++, index, bodies, width, sum); };
    const std::vector<double> place = next(3), rotation = next(4), velocity = next(3), spin = next(3);
    for (std::size_t b = 0; b < bodies; ++b)
        frame.bodies.push_back(
            {Vec3(&place[3 * b]), Quaternion(&rotation[4 * b]), Vec3(&velocity[3 * b]), Vec3(&spin[3 * b])});
}

using Places = std::vector<std::size_t>;

// The vectors at these places, from numbers x, y, z, x, y, z ...
template <class Value>
std::vector<Vec3> vectors(const std::vector<Value>& flat, const Places& places) {
    std::vector<Vec3> values;
    for (const std::size_t i : places) values.emplace_back(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
    return values;
}

template <class Value>
std::vector<Value> those_at(const std::vector<Value>& values, const Places& places) {
    std::vector<Value> those;
    for (const std::size_t i : places) those.push_back(values[i]);
    return those;
}

// The places of the n grains that are there. Without traffic these are the first n places.
Places TrajectoryReader::Impl::places_of(std::size_t index, std::size_t n) const {
    Places places(n);
    std::iota(places.begin(), places.end(), std::size_t{0});
    if (!info.traffic) return places;
    places.clear();
    Checksum apart = begin_sum(index);
    const std::vector<int> present = read<int>(present_variable, index, info.capacity, 1, apart);
    for (std::size_t i = 0; i < present.size(); ++i)
        if (present[i] != 0) places.push_back(i);
    if (places.size() != n)
        damaged(index, fmt::format("it says that it has {} grains, but {} are present", n, places.size()));
    return places;
}

void TrajectoryReader::Impl::read_shapes(std::size_t index, const Places& here, State& frame,
                                         Checksum& sum) const {
    const auto half = vectors(read<float>(half_lengths_variable, index, info.capacity, 3, sum), here);
    const std::vector<float> powers = read<float>(blockiness_variable, index, info.capacity, 2, sum);
    for (std::size_t k = 0; k < here.size(); ++k)
        frame.shape.push_back({half[k], powers[2 * here[k]], powers[2 * here[k] + 1]});
}

void TrajectoryReader::Impl::read_grains(std::size_t index, std::size_t n, State& frame) const {
    Checksum sum = begin_sum(index);
    auto variable = grain_variables.begin();
    const std::size_t places = info.capacity;
    Places here = places_of(index, n);
    const std::vector<int> ids = read<int>(*variable++, index, places, 1, sum);
    if (info.traffic)
        std::stable_sort(here.begin(), here.end(),
                         [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    frame.id = those_at(ids, here);
    frame.species = those_at(read<int>(*variable++, index, places, 1, sum), here);
    frame.radius = those_at(read<double>(*variable++, index, places, 1, sum), here);
    frame.position = vectors(read<double>(*variable++, index, places, 3, sum), here);
    frame.velocity = vectors(read<float>(*variable++, index, places, 3, sum), here);
    frame.spin = vectors(read<float>(*variable++, index, places, 3, sum), here);
    if (info.orientation) {
        const std::vector<float> flat = read<float>(orientation_variable, index, places, 4, sum);
        for (const std::size_t i : here)  // Quaternion takes w first, the file has it last
            frame.orientation.emplace_back(flat[4 * i + 3], flat[4 * i], flat[4 * i + 1], flat[4 * i + 2]);
    }
    if (info.contact_numbers)
        frame.contact_number = those_at(read<int>(contact_number_variable, index, places, 1, sum), here);
    if (info.masses) frame.mass = those_at(read<double>(mass_variable, index, places, 1, sum), here);
    if (info.shapes) read_shapes(index, here, frame, sum);
    if (info.traffic) read<int>(present_variable, index, places, 1, sum);
    check_sum(grain_checksum, index, sum);
    for (std::int32_t& type : frame.species) type = type < 1 ? -1 : type - 1;
    if (auto fault = grains_fault(frame, info.species.size(), info.checksums)) damaged(index, *fault);
}

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
TrajectoryReader::~TrajectoryReader() = default;

std::size_t TrajectoryReader::frames() const {
    return impl_->frames;
}
bool TrajectoryReader::cut_off() const {
    return impl_->cut_off;
}
std::size_t TrajectoryReader::uncounted() const {
    return impl_->uncounted;
}
const TrajectoryInfo& TrajectoryReader::info() const {
    return impl_->info;
}

State TrajectoryReader::read(std::size_t index) const {
    GRAINREEL_CHECK(index < impl_->frames);
    Impl::Moment moment = impl_->read_moment(index);
    impl_->read_grains(index, moment.grains, moment.frame);
    return std::move(moment.frame);
}

TrajectoryCell TrajectoryReader::cell(std::size_t index) const {
    GRAINREEL_CHECK(index < impl_->frames);
    return impl_->cell(index);
}

State TrajectoryReader::read_moment(std::size_t index) const {
    GRAINREEL_CHECK(index < impl_->frames);
    return impl_->read_moment(index).frame;
}

}  // namespace grainreel
