#include "engine/run/import/import_run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/processor.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/import/import_measures.hpp"
#include "engine/run/import/import_ranges.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/wall_motion.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// A new folder that is removed at the end unless it is kept.
class NewFolder {
  public:
    explicit NewFolder(fs::path path) : path_(std::move(path)) {
        std::error_code error;
        if (!fs::create_directories(path_, error) || error)
            throw RunError(fmt::format("{}: cannot be made: {}", path_.string(),
                                       error ? error.message() : std::string("it is there already")));
    }
    ~NewFolder() {
        std::error_code ignored;
        if (!kept_) fs::remove_all(path_, ignored);
    }
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    const fs::path& path() const { return path_; }
    void keep() { kept_ = true; }

  private:
    fs::path path_;
    bool kept_ = false;
};

ImportSurvey survey_of(const ForeignArchive& archive, const std::function<void(std::size_t)>& told) {
    ImportSurvey survey;
    const std::size_t species = archive.world().species.size();
    survey.smallest.assign(species, 0);
    survey.largest.assign(species, 0);
    survey.most.assign(species, 0);
    survey.low = Vec3::Constant(1e300);
    survey.high = -survey.low;
    std::set<std::int32_t> ids;
    for (std::size_t k = 0; k < archive.moments().size(); ++k) {
        const Frame frame = archive.grains(k);
        std::vector<std::int64_t> count(species, 0);
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const auto s = static_cast<std::size_t>(frame.species[i]);
            const double diameter = 2 * frame.radius[i];
            survey.smallest[s] = survey.smallest[s] > 0 ? std::min(survey.smallest[s], diameter) : diameter;
            survey.largest[s] = std::max(survey.largest[s], diameter);
            survey.low = survey.low.cwiseMin(frame.position[i] - frame.radius[i] * Vec3::Ones());
            survey.high = survey.high.cwiseMax(frame.position[i] + frame.radius[i] * Vec3::Ones());
            ++count[s];
        }
        // Most frames have the same grains as the frame before, in the same order.
        for (const std::int32_t id : frame.id) ids.insert(ids.end(), id);
        for (std::size_t s = 0; s < species; ++s) survey.most[s] = std::max(survey.most[s], count[s]);
        told(k);
    }
    if (ids.empty()) survey.low = -(survey.high = Vec3::Constant(0.5));
    survey.ids = static_cast<std::int64_t>(ids.size());
    return survey;
}

// Completes a frame as a run of the scene would write it: with the drive's clock and the poses of the
// container.
class AsRun {
  public:
    AsRun(const Scene& scene, const std::vector<Frame>& moments, bool with_container)
        : scene_(scene),
          clock_(clock_of(scene, moments)),
          with_container_(with_container),
          bodies_(bodies_of(scene)) {}

    const Clock& clock() const { return clock_; }
    void complete(Frame& frame) const {
        frame.cycles = clock_.cycles(frame.step);
        frame.phase = clock_.phase(frame.step);
        const Pose drive = WallMotion(scene_.drive, clock_).at(frame.step);
        // The motions of the files' walls are part of the scene and pass through each moment.
        frame.bodies = poses_of(bodies_, drive);
        if (!with_container_ || scene_.drive.moves != Drive::Moves::container) return;
        for (std::size_t i = 0; i < frame.size(); ++i) {
            frame.position[i] += drive.offset;
            frame.velocity[i] += drive.velocity;
        }
    }

  private:
    const Scene& scene_;
    Clock clock_;
    bool with_container_;
    std::vector<Body> bodies_;
};

std::vector<SavedContact> records_of(const std::vector<Touch>& touches, const Frame& frame) {
    const auto row = [&](std::int32_t id) { return frame.row_of(id); };
    std::vector<SavedContact> records;
    for (const Touch& touch : touches) {
        const std::optional<std::size_t> first = row(touch.first);
        if (!first) continue;
        SavedContact one{touch.first, touch.second, touch.force, Vec3(0, 0, 0), frame.position[*first]};
        if (touch.second >= 0) {
            const std::optional<std::size_t> second = row(touch.second);
            // Contacts of grains that do not touch in the frame are left out. They are contacts across a
            // periodic side, or of another moment.
            if (!second) continue;
            const Vec3 between = frame.position[*second] - frame.position[*first];
            const double reach = frame.radius[*first] + frame.radius[*second];
            if (between.norm() > 1.04 * reach) continue;
            one.point = frame.position[*first] + between * (frame.radius[*first] / reach);
        }
        records.push_back(one);
    }
    return records;
}

// Reads the scene that was just written. Errors in it come from the files or the options.
Scene scene_of(const fs::path& file, const ImportRequest& request) {
    try {
        return read_scene(file, {}, measurable_in);
    } catch (const UserError& why) {
        throw UserError(fmt::format("{}: cannot be shown as a run: {}", request.from.string(), why.what()));
    }
}

}  // namespace

namespace {

ImportedRun import_of(const ImportRequest& request, const ForeignArchive& archive) {
    ImportedRun run;
    run.news = archive.news();
    const double frames = static_cast<double>(archive.moments().size());
    const auto tell = [&](double done) {
        if (request.watcher && !request.watcher(done / (2 * frames)))
            throw RunError("stopped while frames were read");
    };
    if (archive.moments().empty()) throw UserError(fmt::format("{}: holds no frame", request.from.string()));
    NewFolder folder(request.folder);
    const ImportSurvey survey = survey_of(archive, [&](std::size_t k) { tell(static_cast<double>(k)); });

    write_import_scene(folder.path(), archive, survey, request.reading, run.news);
    const Scene scene = scene_of(folder.path() / "scene.toml", request);
    const AsRun as_run(scene, archive.moments(), request.reading.moves_with_container);

    World world = world_of(scene);
    world.title = archive.world().title;
    world.program_version = request.program_version;
    world.traffic = true;  // in a run of another program any grain may come and go
    world.most_grains = static_cast<std::size_t>(std::max<std::int64_t>(1, survey.ids));
    if (archive.world().cell) world.cell = archive.world().cell;
    FrameSupply supply = archive.supply();
    TrajectoryWriter trajectory(folder.path() / "trajectory.nc", trajectory_info(world, supply));
    std::optional<ContactsWriter> contacts;
    if (supply.contacts)
        contacts.emplace(folder.path() / "contacts.nc", world.title, request.program_version,
                         file_facts(scene));
    ImportMeasures measures(scene, as_run.clock(), supply);
    MeasuresWriter table(folder.path() / "measures.csv", measures.names());
    std::optional<ImportWear> wear;
    if (ImportWear::known(archive)) {
        wear.emplace(folder.path() / "fields.nc", scene, archive, request.program_version);
        for (std::string& line : wear->news()) run.news.push_back(std::move(line));
    }
    ImportRanges ranges(scene, supply);
    std::int64_t last_step = std::numeric_limits<std::int64_t>::min();
    for (std::size_t k = 0; k < archive.moments().size(); ++k) {
        Frame frame = archive.grains(k);
        if (frame.step <= last_step && k > 0) continue;  // a second frame of the same moment
        if (!archive.world().time_known && archive.moments().size() == 1) frame.step = 0;
        last_step = frame.step;
        as_run.complete(frame);
        run.most_grains = std::max(run.most_grains, static_cast<std::int64_t>(frame.size()));
        trajectory.write(frame);
        const std::vector<Touch> touches = archive.touches(k).value_or(std::vector<Touch>());
        if (contacts) contacts->write(run.frames, records_of(touches, frame));
        table.write(measures.row(frame, touches));
        ranges.add(frame, touches);
        if (wear) wear->write(k);
        ++run.frames;
        tell(frames + static_cast<double>(k));
    }
    ranges.write(folder.path());
    run.folder = folder.path();
    folder.keep();
    return run;
}

}  // namespace

// In long files the types of grains are looked for only in some frames. If another frame has more types, all
// frames are looked at.
ImportedRun import_run(const ImportRequest& request) {
    try {
        return import_of(request, ForeignArchive(request.from, request.reading));
    } catch (const UnknownType&) {
        return import_of(request, ForeignArchive(request.from, request.reading, ForeignArchive::Looks::all));
    }
}

}  // namespace grainreel
