// A run that lies on disk, as a source of pictures of any of its moments. Where a moment was not kept and
// cannot be brought back, a picture shows the nearest kept one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/run/driver/agenda.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/state/state.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/film_schedule.hpp"
#include "render/film/sources/picture_parts.hpp"
#include "render/film/sources/shot_source.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class StoredShots final : public ShotSource {
  public:
    // sets: changes to the scene that concern the drawing only: keys of [film], colours of species,
    // run.threads. replay: false if nothing may be brought back. sharers: number of runs that share the
    // machine. Throws UserError for another key, for a run that cannot be read, and for what the film shows
    // and the run lacks (film_needs.hpp).
    StoredShots(const std::filesystem::path& folder, const Assignments& sets, bool replay, int sharers = 1);

    // Reads all frames and leaves out damaged ones, with a line in news().
    void check_all() { run_.check_all(); }

    const StoredRun& run() const { return run_; }
    const Clock& clock() const { return run_.clock(); }
    // The moments that a film of this run shows.
    const FilmSchedule& film() const { return film_; }
    // The film's segments, without means and exposures when these cannot be had.
    std::vector<FilmSegment> segments() const;
    // Whether a picture of that step can show just this step, and not only a kept moment near it.
    bool has(std::int64_t step) const { return origin_of(step) != Origin::nowhere; }
    bool has_all(const Pictures& pictures) const;
    // Where the picture of that step comes from.
    Origin origin_of(std::int64_t step) const { return run_.origin_of(step, wants_touches()); }
    // The step that is shown in a picture of `step`.
    std::int64_t shown(std::int64_t step) const;
    // The film's shots after a step, each with the step that is shown. Each step is shown once.
    std::vector<Due> shown_shots(std::int64_t after = -1) const;
    // Compares a replay with a kept moment (StoredRun).
    void prove(std::int64_t step) {
        run_.prove(step, [](double) { return true; });
    }
    // The reason why not all of its moments can be had; empty when they can.
    std::string why_not_all() const;
    // Sets a function that is called during a replay with the share that is done; the usual go_on is called
    // too.
    void watch_replay(ReplayWatcher watcher) { watcher_ = std::move(watcher); }

    const FilmedScene& scene() const override { return scene_; }  // named after the folder
    bool has_any_moment() const override { return run_.brings_all_back(); }
    Span span() const override;
    const StateArchive* archive() const override { return &run_; }
    std::vector<State> moments(const Pictures& pictures) const override;
    void start(const Pictures& pictures) override;
    // Starts with shots by their steps. Each step is shown itself, or by the nearest kept one.
    void start(const std::vector<Due>& shots, const std::vector<FilmSegment>& segments);
    std::optional<Taken> next(const GoOn& go_on) override;
    std::vector<std::string> news() const override;

    // Only the grains and the container at a step that it has. Null when told to stop.
    StatePtr grains(std::int64_t step, const GoOn& go_on);

  private:
    std::vector<Due> shots_of(const Pictures& pictures) const;
    bool wants_touches() const { return needs_touches(scene_.film.shows); }
    // Takes the moment of a step; empty when told to stop.
    std::optional<StoredMoment> take(std::int64_t step, bool touches, const GoOn& go_on);
    bool keep_moments_until(std::int64_t step, const GoOn& go_on);
    StatePtr earlier(std::int64_t step) const;
    Beside beside(double time, std::optional<std::vector<Link>> touches) const;

    FilmedScene scene_;
    StoredRun run_;
    const bool replay_;
    std::vector<std::string> lacks_;  // lines about what is left out of the film
    std::vector<double> measured_;    // s, times of the rows of measures
    PictureParts parts_;
    FilmSchedule film_;
    ReplayWatcher watcher_;
    std::vector<Due> shots_;
    std::vector<FilmSegment> segments_;
    KeptStates earlier_;
    std::set<std::int64_t> wanted_;  // steps whose moments later pictures need
    std::size_t next_ = 0;           // index of the next shot
};

}  // namespace grainreel
