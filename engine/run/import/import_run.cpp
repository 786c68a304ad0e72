#include "engine/run/import/import_run.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/files/run_names.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/import/arrival.hpp"
#include "engine/run/import/import_doubts.hpp"
#include "engine/run/import/import_measures.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// A new folder that is removed at the end unless it is kept.
class NewFolder {
  public:
    explicit NewFolder(fs::path path) : path_(std::move(path)) {
        std::error_code error;
        if (!fs::create_directories(path_, error) || error)
            throw RunError("{}: cannot be made: {}", path_.string(),
                           error ? error.message() : std::string("it is there already"));
    }
    ~NewFolder() {
        std::error_code ignored;
        if (!kept_) fs::remove_all(path_, ignored);
    }
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    void keep() { kept_ = true; }

  private:
    fs::path path_;
    bool kept_ = false;
};

// Whether one of two boxes is not where the other is.
bool differ(const std::optional<WorldCell>& a, const std::optional<WorldCell>& b) {
    if (!a || !b) return false;
    constexpr double share = 1e-6;  // text files have six digits or more
    const double room = share * (a->edges[0].norm() + a->edges[1].norm() + a->edges[2].norm());
    double farthest = (a->origin - b->origin).norm();
    for (std::size_t edge = 0; edge < 3; ++edge)
        farthest = std::max(farthest, (a->edges[edge] - b->edges[edge]).norm());
    return farthest > room;
}

// Writes scene.toml and reads it. Errors in it come from the files or the options.
Scene written_and_read(const std::string& text, const ImportRequest& request) {
    const fs::path file = request.folder / "scene.toml";
    write_import_text(file, text);
    try {
        return read_scene(file, {}, measurable_in);
    } catch (const UserError& why) {
        throw UserError("{}: cannot be shown as a run: {}", request.from.string(), why.what());
    }
}

ArrivalFacts arrival_facts(const Scene& scene, const ForeignArchive& archive, const ImportSurvey& survey,
                           const ImportRequest& request) {
    StoredWorld world = world_of(scene);
    world.title = archive.world().title;
    world.program_version = request.program_version;
    world.traffic = true;  // in a run of another program any grain may come and go
    world.most_grains = std::max<std::size_t>(1, survey.places);
    if (archive.world().cell) world.cell = archive.world().cell;
    // A single moment without a time gets the step 0 (Import::take).
    const bool single = !archive.world().time_known && archive.moments().size() == 1;
    world.steps_known = archive.keeps_steps() && (!single || archive.moments().front().step == 0);
    world.first_id = archive.world().first_id;
    ArrivalFacts facts;
    facts.supply = archive.supply();
    facts.supply.masses = survey.masses;
    const auto& species = archive.world().species;
    facts.weighed = survey.masses || std::all_of(species.begin(), species.end(), [](const WorldSpecies& one) {
                        return std::isfinite(one.density) && one.density > 0;
                    });
    facts.header = trajectory_info(world, facts.supply);
    facts.clock = clock_of(scene, archive.moments());
    facts.in_container = request.reading.moves_with_container && scene.drive.moves == Drive::Moves::container;
    facts.ranges = true;
    return facts;
}

}  // namespace

// The files while they are written.
struct Import::Files {
    Files(const ImportRequest& request, const ForeignArchive& archive, const ImportSurvey& survey,
          std::vector<std::string>& news);

    const ImportWalls walls;
    const std::string scene_text;
    const Scene scene;
    const bool masses;  // whether the grains have masses of their own
    Arrival arrival;
    std::optional<ImportWear> wear;
    // What these files can hold.
    const std::vector<std::string> types;
    const StateSupply supply;
    const std::size_t bodies, places;
};

Import::Files::Files(const ImportRequest& request, const ForeignArchive& archive, const ImportSurvey& survey,
                     std::vector<std::string>& news)
    : walls(write_import_walls(request.folder, archive, request.reading, news)),
      scene_text(import_scene_text(archive, survey, request.reading, walls, news)),
      scene(written_and_read(scene_text, request)),
      masses(survey.masses),
      arrival(request.folder, scene, arrival_facts(scene, archive, survey, request)),
      types(archive.types()),
      supply(archive.supply()),
      bodies(archive.world().bodies.size()),
      places(survey.places) {
    for (std::string& doubt : doubts_about_sizes(scene, request, archive)) news.push_back(std::move(doubt));
    if (!ImportWear::known(archive)) return;
    wear.emplace(request.folder / "fields.nc", scene, archive, request.program_version);
    for (std::string& line : wear->news()) news.push_back(std::move(line));
}

Import::Import(ImportRequest request, bool at_end)
    : request_(std::move(request)),
      archive_(request_.from, request_.reading, ForeignArchive::Looks::first),
      at_end_(at_end),
      depends_on_box_(!archive_.world().cell && request_.reading.container.empty()) {
    if (known() == 0) throw UserError("{}: holds no frame", request_.from.string());
    // The first grains say what the columns mean.
    if (!at_end && archive_.world().most_grains == 0)
        throw UserError("{}: holds no grain yet", request_.from.string());
}

Import::~Import() = default;

std::size_t Import::known() const {
    return at_end_ ? archive_.moments().size() : archive_.whole_moments();
}

ImportSurvey Import::first_guess() {
    const std::size_t first = archive_.first_with_grains();
    archive_.take_types(first);
    ImportSurvey guess;
    guess.add(archive_.grains(first), archive_.types(), archive_.world());
    guess.places = std::max(guess.places, archive_.world().most_grains);
    return guess;
}

// may_fail: whether a scene that cannot be read only means that the guess is wrong.
void Import::begin(const ImportSurvey& guess, bool may_fail) {
    run_ = Imported();
    run_.folder = request_.folder;
    run_.news = archive_.news();
    try {
        files_ = std::make_unique<Files>(request_, archive_, guess, run_.news);
    } catch (const UserError&) {
        if (!may_fail) throw;
    }
}

// Gives up the files that were begun, and their room on the disk.
void Import::drop() {
    files_.reset();
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(request_.folder, ignored))
        fs::remove(entry.path(), ignored);
}

ImportSurvey Import::read_all(const ImportSurvey& guess) {
    ImportSurvey survey;
    const std::size_t frames = known();
    for (next_ = 0; next_ < frames; ++next_) {
        if (request_.watcher && !request_.watcher(static_cast<double>(next_) / static_cast<double>(frames)))
            throw RunError("stopped while frames were read");
        archive_.take_types(next_);
        State frame = archive_.grains(next_);
        survey.add(frame, archive_.types(), archive_.world());
        if (files_ && !survey.within(guess, depends_on_box_)) drop();
        if (files_) take(next_, std::move(frame));
    }
    return survey;
}

void Import::take(std::size_t index, State frame) {
    if (run_.frames > 0 && frame.step <= last_step_) return;  // a second frame of the same moment
    last_step_ = frame.step;
    if (!archive_.world().time_known && archive_.moments().size() == 1) frame.step = 0;
    if (!files_->masses) frame.mass.clear();
    files_->arrival.complete(frame);
    files_->arrival.take(frame, archive_.touches(index).value_or(std::vector<Link>()));
    if (files_->wear) files_->wear->write(index);
    if (!first_box_) first_box_ = archive_.cell(index);
    box_changes_ = box_changes_ || differ(first_box_, archive_.cell(index));
    run_.frames = files_->arrival.frames();
    run_.most_grains = std::max(run_.most_grains, static_cast<std::int64_t>(frame.size()));
}

// Says which contacts the files have and the run has not.
void Import::tell_of_contacts() {
    const Arrival::LeftOut& left = files_->arrival.contacts_left_out();
    const auto passed = static_cast<std::int64_t>(archive_.contacts_passed_over());
    std::vector<std::string> why;
    const auto add = [&](std::int64_t count, const char* reason) {
        if (count > 0) why.push_back(fmt::format("{} {}", count, reason));
    };
    add(left.without_grain, "with a grain that is not in the frame");
    add(left.apart, "of grains that are apart in it (across a periodic side, or of another moment)");
    add(passed, "between walls, or without ids or a finite force");
    if (why.empty()) return;
    run_.news.push_back(fmt::format("{}: {} of {} contacts are left out: {}", request_.from.string(),
                                    left.without_grain + left.apart + passed, left.of + passed,
                                    fmt::join(why, ", ")));
}

// The walls that are drawn of a box are those of the first frame.
void Import::tell_of_box() {
    const std::vector<MovingWall>& walls = archive_.walls();
    if (box_changes_ &&
        std::any_of(walls.begin(), walls.end(), [](const MovingWall& wall) { return wall.is_box; }))
        run_.news.push_back(fmt::format("{}: its box changes; its sides are drawn as they were at first",
                                        request_.from.string()));
}

std::vector<std::string> Import::later_news() const {
    std::vector<std::string> lines = archive_.news_of_frames();
    std::erase_if(lines, [&](const std::string& line) { return contains(run_.news, line); });
    return lines;
}

// The scene's text also says where grains were and how many there were at most.
void Import::finish(const ImportSurvey& survey) {
    std::vector<std::string> told_before;
    const std::string text =
        import_scene_text(archive_, survey, request_.reading, files_->walls, told_before);
    if (text != files_->scene_text) {
        const Scene scene = written_and_read(text, request_);
        // Refuses what cannot be.
        ImportMeasures(scene, clock_of(scene, archive_.moments()), archive_.supply(), false);
    }
    tell_of_contacts();
    tell_of_box();
    files_->arrival.close();
    for (std::string& line : later_news()) run_.news.push_back(std::move(line));
    std::string news;
    for (const std::string& line : run_.news) news += line + "\n";
    write_import_text(request_.folder / kImportNews, news);
    ends_ = ends();
}

Imported Import::run() {
    ImportSurvey guess = first_guess();
    begin(guess, true);
    survey_ = read_all(guess);
    if (!files_ || !guess.within(survey_, depends_on_box_)) {
        drop();
        guess = std::move(survey_);
        begin(guess, false);
        survey_ = read_all(guess);
        if (!files_)
            throw UserError("{}: changed while it was read; try it again once it is whole",
                            request_.from.string());
    }
    finish(survey_);
    return run_;
}

// Step and time of the first and of the last moment that were taken. All others depend on the same tick.
std::array<std::pair<std::int64_t, double>, 2> Import::ends() const {
    const State &first = archive_.moments().front(), &last = archive_.moments().at(next_ - 1);
    return {{{first.step, first.time}, {last.step, last.time}}};
}

void Import::grow() {
    if (!archive_.grow() && files_) return;
    if (files_ && archive_.world().bodies.size() != files_->bodies)
        throw RunError("{}: its walls come apart, as they did not before; begin again",
                       request_.from.string());
    const StateSupply now = archive_.supply();
    // A single moment does not say how long a step is.
    const bool same = files_ && next_ > 1 && ends() == ends_ && now.velocities == files_->supply.velocities &&
                      now.contacts == files_->supply.contacts;
    if (!same || archive_.walls_come()) begin_again();
}

// Makes the files again, of the same frames, with room for more grains.
void Import::begin_again() {
    drop();
    ImportSurvey room = survey_;
    room.places *= 2;
    try {
        begin(room, false);
        for (std::size_t k = 0; k < next_; ++k) take(k, archive_.grains(k));
        finish(survey_);
    } catch (...) {
        drop();  // a part of the frames would pass for all of them
        throw;
    }
}

bool Import::take_next() {
    if (!files_ || next_ == known()) return false;
    archive_.take_types(next_);
    if (archive_.types() != files_->types)
        throw RunError("{}: has a type that the frames before lacked; name all types by --species",
                       request_.from.string());
    State frame = archive_.grains(next_++);
    survey_.add(frame, archive_.types(), archive_.world());
    if (survey_.places > files_->places || (survey_.masses && !files_->masses))
        begin_again();
    else
        take(next_ - 1, std::move(frame));
    ends_ = ends();
    return true;
}

Imported import_run(const ImportRequest& request) {
    Import import(request, true);
    NewFolder folder(request.folder);
    Imported run = import.run();
    folder.keep();
    return run;
}

}  // namespace grainreel
