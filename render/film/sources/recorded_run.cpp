#include "render/film/sources/recorded_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_names.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/state/container_faces.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/recorded_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// The archive with what the film shows beside the grains.
class AsFilmed final : public AskedRun {
  public:
    AsFilmed(const RecordedRun& run, std::shared_ptr<const RunArchive> archive)
        : AskedRun(std::move(archive)), run_(run) {}

    void add_kept(std::size_t index, Snapshot& snapshot) const override {
        AskedRun::add_kept(index, snapshot);
        Shot shot(std::move(snapshot.frame));
        run_.add_parts(shot);
        snapshot.displacement = std::move(shot.displacement);
        snapshot.worn = shot.worn;
        snapshot.flowed_out = shot.flowed_out;
        snapshot.frame = std::move(shot);
    }

  private:
    const RecordedRun& run_;
};

}  // namespace

std::optional<std::string> lacking_elsewhere(const FilmedScene& scene) {
    const FilmShows& shows = scene.film.shows;
    const std::string begin = "another engine computes the run, and ";
    if (scene.film.look.rotation) return begin + "its dumps have no orientations; let film.rotation be false";
    if (needs_touches(shows))
        return begin +
               "its dumps have no contacts; let film.colour.by be something else and film.force_chains false";
    if (shows.wall_forces.wanted)
        return begin + "forces on walls are not measured there; let film.wall_forces be false";
    if (shows_wear(scene))
        return begin + "wear of walls is not measured there; let film.walls.colour be \"plain\"";
    return std::nullopt;
}

RecordedRun::RecordedRun(const fs::path& folder, const Assignments& sets, Use use)
    : for_questions_(use.for_questions), scene_(scene_of_run(folder_of_run(folder), sets)) {
    archive_ = std::make_shared<RunArchive>(folder_of_run(folder), scene_, use.for_questions);
    record_ = std::make_unique<AsFilmed>(*this, archive_);
    const FilmShows& shows = scene_.film.shows;
    if (const auto lack = lacking_elsewhere(scene_); lack && is_elsewhere() && !use.for_questions)
        throw UserError(fmt::format("{}: {}", archive_->folder().string(), *lack));
    if (scene_.film.look.rotation && !archive_->supply().orientations && is_import())
        throw UserError(
            fmt::format("{}: its files say no orientations; let film.rotation be false", scene_.title));
    if (scene_.film.look.rotation && !archive_->supply().orientations)
        throw UserError(
            fmt::format("{}: has no orientations, and the film shows rotation; run it with "
                        "output.orientation = true, or let film.rotation be false",
                        name_of("trajectory.nc")));
    if (!use.for_questions) frame_what_is_reached();
    if (needs_touches(shows)) archive_->read_contacts(use.alone);
    if (needs_measures(shows)) read_measures_of_run();
    if (shows.outflow) read_outflow_of_run();
    if (shows_wear(scene_)) read_wear_of_run();
    if (scene_.film.periods > 0) archive_->set_periods(scene_.film.periods);
    parts_.emplace(scene_, clock(), moments().front().step);
    if (use.alone) do_without_others();
}

// Reports what the film lacks when there is only the trajectory, which holds some single moments of the run.
void RecordedRun::do_without_others() {
    if (needs_touches(scene_.film.shows) && !archive_->has_contacts() && !for_questions_)
        archive_->read_contacts(true);
    for (std::string& line : single_moment_warnings(
             scene_, is_elsewhere() ? "the moments that another engine wrote are single ones"
                                    : "frames that a run kept are single moments; let them be brought back, "
                                      "or run the scene again with `movie`"))
        archive_->note(std::move(line));
    if (needs_displacement(scene_.film.shows)) look_for_earlier_frames();
}

Supply RecordedRun::supply() const {
    const FrameSupply has = archive_->supply();
    return {false, has.contacts, has.measures, has.orientations};
}

// Frames the picture by how high the grains got: for a finished run this need not be estimated.
void RecordedRun::frame_what_is_reached() {
    Camera& camera = scene_.film.camera;
    if (camera.frame == CameraFrame::reach && !camera.reach && !camera.position)
        camera.reach = known_reach(*archive_);
}

void RecordedRun::read_measures_of_run() {
    const std::string name = name_of("measures.csv");
    std::error_code error;
    if (!fs::exists(name, error)) return leave_out_measures("is missing");
    if (!archive_->measures() || table().rows() == 0) return leave_out_measures("holds no row");
    check_columns();
    const std::size_t rows = table().rows();
    measured_ = table().values(*column_of(table(), "time_s"), 0, rows);
    const double last = measured_.back(), interval = rows > 1 ? last - measured_[rows - 2] : 0;
    const double end = moments().back().time;
    if (last < end - 1.5 * interval - 1e-9)
        archive_->note(
            fmt::format("{}: ends at {:.4g} s, the trajectory at {:.4g} s; plots and live words "
                        "stand still from there on",
                        name, last, end));
}

// Leaves out plots and live words. Empty plots, and words without values, would look like a result of the
// run.
void RecordedRun::leave_out_measures(const std::string& why) {
    FilmShows& shows = scene_.film.shows;
    std::vector<std::string> left_out;
    if (std::erase_if(shows.plots, [](const FilmPlot& plot) { return !plot.is_profile(); }) > 0)
        left_out.emplace_back("plots");
    if (std::exchange(shows.wall_forces.wanted, false)) left_out.emplace_back("forces on walls");
    if (needs_measures(shows)) {
        shows.live_words.clear();
        left_out.emplace_back("live words");
    }
    archive_->note(
        fmt::format("{}: {}; {} are left out", name_of("measures.csv"), why, fmt::join(left_out, " and ")));
}

void RecordedRun::check_columns() const {
    const bool imported = is_import();
    const auto need = [&](const std::string& name, const std::string& what) {
        if (name.empty() || column_of(table(), name)) return;
        if (imported)
            throw UserError(
                fmt::format("{}: {} {}, which is known of runs of ours alone; take that out of the film",
                            scene_.title, what, name));
        if (is_elsewhere())
            throw UserError(
                fmt::format("{}: {} {}, which is measured in runs of our own engine alone; take "
                            "that out of the film",
                            archive_->folder().string(), what, name));
        throw UserError(
            fmt::format("{}: lacks the column {}, which {}; take that out of the film, or run "
                        "the scene again with it",
                        name_of("measures.csv"), name, what));
    };
    need("time_s", "every run has");
    for (const FilmPlot& plot : scene_.film.shows.plots) need(plot.column, "film.plot shows");
    for (const LiveWords& part : scene_.film.shows.live_words) need(part.column, "film.text shows");
    if (!scene_.film.shows.wall_forces.wanted) return;
    for (const std::string& face : face_names(scene_)) need(face + "_force_z_N", "film.wall_forces shows");
}

void RecordedRun::read_outflow_of_run() {
    const std::string name = name_of("outflow.csv");
    outflow_ = OutflowSums::read(name, scene_);
    if (!outflow_) archive_->note(fmt::format("{}: is missing; how much has flowed out is left out", name));
}

bool RecordedRun::is_elsewhere() const {
    return is_of_another_engine(archive_->folder());
}

bool RecordedRun::is_import() const {
    std::error_code ignored;
    return fs::exists(name_of(kImportNews), ignored);
}

// Reads the wear of the walls. Walls without its colours would look as if nothing had touched them.
void RecordedRun::read_wear_of_run() {
    const bool imported = is_import();
    try {
        const std::string name = name_of("fields.nc");
        if (imported && !fs::exists(name))
            throw UserError(
                fmt::format("{}: its walls say no stress or wear of their triangles, and the film colours "
                            "walls by it; name files that do by --walls",
                            scene_.title));
        if (!fs::exists(name))
            throw UserError(fmt::format(
                "{}: is missing, and the film colours walls by it; run the scene with output.instruments = "
                "[\"wear\"]",
                name));
        wear_.emplace(name, scene_);
        if (imported) fit_range_of_import();
    } catch (const UserError& lack) {
        if (!for_questions_)
            throw UserError(fmt::format("{}, or draw walls without colours, by --set film.walls.colour=plain",
                                        lack.what()));
        scene_.film.look.walls.colour = FilmWalls::Colour::plain;
        archive_->note(fmt::format("{}; walls are plain", lack.what()));
    }
}

// Sets the colour range of an import to the largest value of all moments. Its scene knows no bed and no
// motion from which a range could be estimated.
void RecordedRun::fit_range_of_import() {
    FilmWalls& walls = scene_.film.look.walls;
    const bool by_pressure = walls.colour == FilmWalls::Colour::pressure;
    double most = 0;
    bool any = false;
    for (const Frame& moment : moments())
        for (const MeshWear& mesh : *wear_->until(moment.time))
            for (const double value : by_pressure ? mesh.pressure : mesh.wear) {
                if (std::isnan(value)) continue;
                any = true;
                if (std::isfinite(value)) most = std::max(most, value);
            }
    if (!any)
        throw UserError(
            fmt::format("{}: its walls say no {} of their triangles, and the film colours walls by it",
                        scene_.title, by_pressure ? "stress" : "wear"));
    if (!walls.fixed && most > 0) walls.range = {1e-3 * most, most};
}

void RecordedRun::look_for_earlier_frames() {
    const double first = moments().front().cycles + archive_->periods() - 1e-3;
    std::size_t lack = 0;
    for (const Frame& moment : moments())
        lack += moment.cycles >= first &&
                !archive_->index_at(clock().time(clock().step_at(moment.cycles - archive_->periods())));
    if (lack > 0)
        archive_->note(fmt::format(
            "{}: {} of its {} frames have none a period before them, and are drawn without displacements; "
            "run the scene with an output.trajectory_interval that divides the period",
            name_of("trajectory.nc"), lack, moments().size()));
}

FramePtr RecordedRun::at(std::int64_t step) const {
    const std::optional<std::size_t> index = archive_->index_at(clock().time(step));
    return index ? std::make_shared<const Frame>(archive_->grains(*index)) : nullptr;
}

std::vector<Touch> RecordedRun::touches(const Frame& frame) const {
    return archive_->touches(archive_->nearest(frame.time)).value_or(std::vector<Touch>());
}

std::optional<FlowedOut> RecordedRun::flowed_out(const Frame& frame) const {
    return outflow_ ? std::optional(outflow_->until(frame.time)) : std::nullopt;
}

std::shared_ptr<const std::vector<MeshWear>> RecordedRun::worn(const Frame& frame) const {
    return wear_ ? wear_->until(frame.time) : nullptr;
}

PartSupply::Measured RecordedRun::measured(const Frame& frame) const {
    const double end = frame.time * (1 + 1e-9) + 1e-12;
    const auto after = std::upper_bound(measured_.begin(), measured_.end(), end);
    return {archive_->measures(), static_cast<std::size_t>(after - measured_.begin())};
}

Shot RecordedRun::frame(std::size_t index) const {
    Shot shot = archive_->grains(index);
    add_parts(shot);
    return shot;
}

void RecordedRun::add_parts(Shot& shot) const {
    parts_->add(shot, FilmSegment(), archive_->periods(), *this);
}

std::vector<Frame> RecordedRun::moments(const Pictures& pictures) const {
    std::vector<Frame> all;
    for (const Instant& instant : pictures.instants)
        all.push_back(moments()[archive_->nearest(instant.time)]);
    return all;
}

void RecordedRun::start(const Pictures& pictures) {
    pictures_ = pictures;
}

std::optional<Taken> RecordedRun::next(const GoOn& go_on) {
    if (!go_on() || next_ == pictures_.instants.size()) return std::nullopt;
    const Instant& instant = pictures_.instants[next_++];
    const int periods = archive_->periods();
    Shot shot = archive_->grains(archive_->nearest(instant.time));
    parts_->add(shot, pictures_.segments.at(static_cast<std::size_t>(instant.segment)), periods, *this);
    return Taken{std::make_shared<const Shot>(std::move(shot)), instant.segment, periods};
}

}  // namespace grainreel
