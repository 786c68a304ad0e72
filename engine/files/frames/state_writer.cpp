#include "engine/files/frames/state_writer.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/fields_file.hpp"

// All formats. NAME stands for a function WriteFormat NAME_format() in engine/files/frames/writers.
#define GRAINREEL_FRAME_FORMATS(one)                                                                         \
    one(trajectory) one(lammps_dump) one(lammps_data) one(xyz_writer) one(csv) one(vtk) one(vtkhdf) one(stl) \
        one(gsd_writer) one(gltf) one(blender) one(grain_table)

namespace grainreel {

#define GRAINREEL_DECLARE(name) WriteFormat name##_format();
GRAINREEL_FRAME_FORMATS(GRAINREEL_DECLARE)
#undef GRAINREEL_DECLARE

const std::vector<WriteFormat>& frame_formats() {
#define GRAINREEL_LIST(name) name##_format(),
    static const std::vector<WriteFormat> all{GRAINREEL_FRAME_FORMATS(GRAINREEL_LIST)};
#undef GRAINREEL_LIST
    return all;
}

std::unique_ptr<StateWriter> frame_writer(const std::string& format, const std::filesystem::path& path) {
    std::string known;
    for (const WriteFormat& one : frame_formats()) {
        if (format == one.name) return one.make(path);
        known += fmt::format("\n  {:<12}  {}", one.name, one.about);
    }
    throw UserError("'{}' is no format of frames. There are:{}", format, known);
}

}  // namespace grainreel
namespace grainreel {

namespace fs = std::filesystem;

namespace {

std::vector<std::size_t> chosen(const StateArchive& frames, const ExportChoice& choice) {
    const std::vector<State>& moments = frames.moments();
    const auto check = [&](const char* option, const std::optional<double>& time) {
        if (time) frames.check_time(option, *time, moments.back().time, frames.usual_slack(*time));
    };
    check("--at", choice.at);
    check("--from", choice.from);
    check("--until", choice.until);
    if (choice.from && choice.until && *choice.from > *choice.until)
        throw UserError("--from: {:.6g} s is later than --until, {:.6g} s; exchange the two", *choice.from,
                        *choice.until);
    if (choice.at) return {frames.nearest(*choice.at)};
    std::vector<std::size_t> all = frames.between(choice.from, choice.until, choice.every);
    if (all.empty())
        throw UserError("{}: no frame lies there; they go from {:.6g} to {:.6g} s", frames.path().string(),
                        moments.front().time, moments.back().time);
    return all;
}

void add_fields(const StateArchive& frames, const std::vector<std::size_t>& wanted, StateWriter& writer) {
    const std::shared_ptr<const FieldsReader> fields = frames.fields();
    if (!fields) return;
    const double hair = 1e-9;
    std::vector<std::size_t> records;
    for (std::size_t record = 0; record < fields->records(); ++record) {
        const auto [begin, end] = fields->span(record);
        const bool has_frame =
            std::any_of(wanted.begin(), wanted.end(), [&, from = begin, to = end](std::size_t k) {
                const double time = frames.moments()[k].time;
                return time >= from - hair && time <= to + hair;
            });
        if (has_frame) records.push_back(record);
    }
    writer.fields(*fields, records);
}

std::uintmax_t bytes_of(const fs::path& path) {
    std::error_code error;
    if (is_plain(path)) return fs::file_size(path, error);
    std::uintmax_t bytes = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path, error))
        if (entry.is_regular_file(error)) bytes += entry.file_size(error);
    return bytes;
}

// A path beside the wanted one. The file there is removed at the end unless it was renamed.
class PartName {
  public:
    explicit PartName(const fs::path& path)
        : path_(path.parent_path() /
                fmt::format(".{}.{}.part{}", path.stem().string(), ::getpid(), path.extension().string())) {}
    ~PartName() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    PartName(const PartName&) = delete;
    PartName& operator=(const PartName&) = delete;
    const fs::path& path() const { return path_; }

    // A message with the name that the file will have in place of this one.
    std::string renamed(std::string text, const fs::path& path) const {
        const std::string own = path_.filename().string();
        for (std::size_t place = text.find(own); place != std::string::npos; place = text.find(own, place))
            text.replace(place, own.size(), path.filename().string());
        return text;
    }

  private:
    fs::path path_;
};

void write_all(const StateArchive& frames, const std::vector<std::size_t>& wanted, StateWriter& writer,
               const std::function<bool(double)>& watcher) {
    writer.begin(frames.world(), frames.supply());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        State frame = frames.grains(wanted[k]);
        // Without steps the frames are numbered, for formats that cannot do without a number.
        frame.step =
            frames.written_step(wanted[k]).value_or(static_cast<std::int64_t>(frames.place(wanted[k])));
        writer.cell(frames.cell(wanted[k]));
        const std::optional<std::vector<Link>> touches = frames.touches(wanted[k]);
        if (writer.takes_all())
            if (const std::optional<std::vector<SavedContact>> all = frames.contacts(wanted[k]))
                writer.contacts(*all);
        writer.frame(frame, touches.value_or(std::vector<Link>()));
        if (!watcher(static_cast<double>(k + 1) / static_cast<double>(wanted.size())))
            throw RunError("stopped while frames were written; nothing is left of them");
    }
    if (writer.takes_all()) add_fields(frames, wanted, writer);
    writer.end();
}

}  // namespace

void check_free(const fs::path& path, bool replace) {
    check_folder_around(path, "--out " + path.string());
    if (is_there(path) && !replace)
        throw UserError("--out {}: exists already; choose another name, or --force to replace it",
                        path.string());
}

Exported export_frames(const StateArchive& frames, const std::string& format, const fs::path& path,
                       const ExportChoice& choice, bool replace, const std::function<bool(double)>& watcher) {
    std::error_code error;
    check_free(path, replace);
    const std::vector<std::size_t> wanted = chosen(frames, choice);
    const PartName part(path);
    std::vector<std::string> news;
    try {
        const std::unique_ptr<StateWriter> writer = frame_writer(format, part.path());
        write_all(frames, wanted, *writer, watcher);
        news = frames.news_of_frames();  // it is known when all frames were read
        for (const std::string& line : writer->news()) news.push_back(part.renamed(line, path));
    } catch (const RunError& error_of_part) {
        throw RunError(part.renamed(error_of_part.what(), path));
    } catch (const UserError& error_of_part) {
        const std::string renamed = part.renamed(error_of_part.what(), path);
        if (renamed == error_of_part.what()) throw;
        throw UserError(renamed);
    }
    if (is_folder(path)) fs::remove_all(path, error);
    fs::rename(part.path(), path, error);
    if (error) throw RunError("{}: cannot be made: {}", path.string(), error.message());
    Exported made{path, static_cast<std::int64_t>(wanted.size()), bytes_of(path),
                  frames.moments()[wanted.front()].time};
    if (choice.at)
        made.is_asked = std::abs(made.first - *choice.at) <=
                        std::max(0.51 * frames.step_length(), 1e-5 * std::abs(*choice.at));
    made.news = std::move(news);
    return made;
}

}  // namespace grainreel
namespace grainreel {

WorldCell box_of(const StoredWorld& world, const State& frame) {
    Vec3 low = Vec3::Constant(0), high = low;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3 reach = frame.radius[i] * Vec3::Ones();
        low = i == 0 ? Vec3(frame.position[i] - reach) : Vec3(low.cwiseMin(frame.position[i] - reach));
        high = i == 0 ? Vec3(frame.position[i] + reach) : Vec3(high.cwiseMax(frame.position[i] + reach));
    }
    if (frame.size() == 0) high = Vec3::Ones();
    WorldCell box;
    box.origin = low;
    for (int axis = 0; axis < 3; ++axis) box.edges[axis] = (high - low)[axis] * Vec3::Unit(axis);
    if (!world.cell) return box;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        if (!world.cell->periodic[edge]) continue;
        box.edges[edge] = world.cell->edges[edge];
        box.origin[static_cast<Eigen::Index>(edge)] = world.cell->origin[static_cast<Eigen::Index>(edge)];
        box.periodic[edge] = true;
    }
    return box;
}

void refuse_unknown_motion(const fs::path& path, const State& frame) {
    for (std::size_t i = 0; i < frame.size(); ++i)
        for (const auto& [what, motion] :
             {std::pair("velocity", &frame.velocity[i]), {"spin", &frame.spin[i]}})
            if (!motion->allFinite())
                throw UserError(
                    "{}: the {} of grain {} is not known, and a run cannot start with it; take "
                    "another moment by --at, or write its {} into the file",
                    path.string(), what, frame.id[i], what);
}

std::vector<std::string> news_of_rest(const fs::path& path, const StateSupply& supply) {
    if (supply.velocities && supply.spins) return {};
    return {fmt::format("{}: {} are not known, and are 0 in it", path.filename().string(),
                        supply.velocities ? "spins"
                        : supply.spins    ? "velocities"
                                          : "velocities and spins")};
}

std::string one_word(const std::string& name) {
    std::string word = name.empty() ? "grain" : name;
    for (char& c : word)
        if (static_cast<unsigned char>(c) <= ' ' || c == '"' || c == ',') c = '_';
    return word;
}

}  // namespace grainreel
