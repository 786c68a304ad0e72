#include "render/run/frames/saved_state.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/state/grain_table.hpp"
#include "engine/start/restart.hpp"
#include "render/run/frames/recorded_scene.hpp"
#include "render/run/frames/same_run.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::int32_t most_types = 1000;

Frame moment_of(const Frame& frame) {
    Frame moment;
    moment.step = frame.step;
    moment.time = frame.time;
    moment.cycles = frame.cycles;
    moment.phase = frame.phase;
    moment.bodies = frame.bodies;
    return moment;
}

// Questions find grains by their ids, so the rows come by rising id.
Frame by_id(const Frame& table) {
    std::vector<std::size_t> order(table.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return table.id[a] < table.id[b]; });
    Frame frame;
    for (const std::size_t i : order) {
        frame.id.push_back(table.id[i]);
        frame.species.push_back(table.species[i]);
        frame.radius.push_back(table.radius[i]);
        frame.position.push_back(table.position[i]);
        frame.velocity.push_back(table.velocity[i]);
        frame.spin.push_back(table.spin[i]);
        if (!table.orientation.empty()) frame.orientation.push_back(table.orientation[i]);
    }
    return frame;
}

// Of a table that lies alone.
Scene scene_of_types(const Frame& frame) {
    Scene scene;
    scene.container.shape = Container::Shape::none;
    for (std::int32_t type = 0; type <= *std::max_element(frame.species.begin(), frame.species.end());
         ++type) {
        Species species;
        species.name = fmt::format("type {}", type + 1);
        double sum = 0;
        for (std::size_t i = 0; i < frame.size(); ++i) {
            if (frame.species[i] != type) continue;
            ++species.count;
            sum += 2 * frame.radius[i];
        }
        species.diameter.mean = species.count > 0 ? sum / static_cast<double>(species.count) : unknown;
        species.density = unknown;
        scene.species.push_back(species);
    }
    return scene;
}

}  // namespace

SavedState::SavedState(const fs::path& file, const Assignments& sets) : file_(file) {
    if (is_checkpoint(file))
        read_checkpoint(sets);
    else
        read_table(sets);
    moments_ = {moment_of(frame_)};
    clock_ = clock_of(scene_, moments_);
    if (scene_.run.step) clock_.step = *scene_.run.step;
}

void SavedState::read_checkpoint(const Assignments& sets) {
    const Simulation run = run_of_checkpoint(file_, 1);
    scene_ = scene_of_checkpoint(file_, sets_for_drawing(sets));
    scene_.name = file_.stem().string();
    frame_ = run.frame();
    measured_ = MeasuredRow{frame_.time, run.measured(), run.measures().values()};
    std::error_code error;
    checkpoints_ = {{run.step(), file_, fs::file_size(file_, error)}};
}

void SavedState::read_table(const Assignments& sets) {
    frame_ = by_id(read_grain_table(file_));
    frame_.time = frame_.cycles = unknown;
    news_.push_back(fmt::format(
        "{}: holds neither time nor walls; heights are counted from the floor at rest", file_.string()));
    const std::int32_t last = *std::max_element(frame_.species.begin(), frame_.species.end());
    const fs::path beside = file_.parent_path();
    std::error_code error;
    if (fs::exists(beside / "scene.toml", error)) {
        scene_ = scene_of_run(beside.empty() ? fs::path(".") : beside, sets);
        if (static_cast<std::size_t>(last) >= scene_.species.size())
            throw UserError(
                fmt::format("{}: has grains of type {}, but the scene.toml beside it has {} species; "
                            "they are of two runs",
                            file_.string(), last + 1, scene_.species.size()));
        check_all_are_there();
        return;
    }
    if (last >= most_types)
        throw UserError(fmt::format("{}: has grains of type {}; there may be {} types at most",
                                    file_.string(), last + 1, most_types));
    if (!sets.empty())
        throw UserError(fmt::format("{}: there is no scene.toml beside {}, so nothing of it can be set",
                                    sets.front().place(), file_.string()));
    scene_ = scene_of_types(frame_);
    news_.push_back(fmt::format("{}: there is no scene.toml beside it; names, masses and walls are not known",
                                file_.string()));
}

// Where no grain comes or goes, the table of a run has as many as its scene.
void SavedState::check_all_are_there() const {
    const bool traffic = !scene_.feeds.empty() || (scene_.container.outlet && !scene_.container.tray);
    const auto grains = static_cast<std::int64_t>(frame_.size());
    if (traffic || file_.filename() != kFinalTable || grains == scene_.grains()) return;
    throw UserError(
        fmt::format("{}: has {} grains, but the scene.toml beside it has {}; it was cut off, or they "
                    "are of two runs",
                    file_.string(), grains, scene_.grains()));
}

std::vector<Frame> SavedState::moments(const Pictures& pictures) const {
    return std::vector<Frame>(pictures.instants.size(), moments_.front());
}

std::optional<Taken> SavedState::next(const GoOn& go_on) {
    if (!go_on() || next_ == pictures_.instants.size()) return std::nullopt;
    const Instant& instant = pictures_.instants[next_++];
    return Taken{std::make_shared<const Frame>(frame_), instant.segment, 1};
}

}  // namespace grainreel
