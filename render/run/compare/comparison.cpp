#include "render/run/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/team.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/text/reader.hpp"
#include "render/draw/panels/side_by_side.hpp"
#include "render/film/sampling/pacing.hpp"
#include "render/run/compare/comparison_words.hpp"
#include "render/run/frames/choice.hpp"
#include "render/run/frames/recorded_run.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_panels = 6;  // more, and each is too small to see anything in

bool is_run(const fs::path& input) {
    std::error_code ignored;
    return fs::is_directory(input, ignored);
}

// A pipe gives its scene once, and scenes may be read twice.
void check_not_pipe(const fs::path& input) {
    if (other_than_file(input, true) == "a pipe")
        throw UserError(
            fmt::format("{}: this is a pipe; give the path of a scene file (.toml)", input.string()));
}

// All scenes end when the shortest does; a film's segments are shortened with it.
std::vector<Scene> read_scenes(const CompareRequest& what, std::vector<std::string>& warnings) {
    std::vector<Scene> scenes;
    for (const fs::path& input : what.inputs)
        if (!is_run(input))
            check_not_pipe(input), scenes.push_back(read_scene(input, what.sets, measurable_in));
    if (scenes.empty()) return scenes;
    const auto by_duration = [](const Scene& a, const Scene& b) { return a.run.duration < b.run.duration; };
    const auto [shortest, longest] = std::minmax_element(scenes.begin(), scenes.end(), by_duration);
    if (shortest->run.duration == longest->run.duration) return scenes;
    warnings.push_back(fmt::format("{} lasts {:.6g} s, {} {:.6g} s: all are run and shown for {:.6g} s",
                                   shortest->file, shortest->run.duration, longest->file,
                                   longest->run.duration, shortest->run.duration));
    Assignments sets = what.sets;
    sets.push_back(fmt::format("run.duration={}", shortest->run.duration));
    for (Scene& scene : scenes) scene = read_scene(scene.file, sets, measurable_in);
    return scenes;
}

void check_start(const Scene& scene) {
    if (scene.start.keep_clock)
        throw UserError(
            fmt::format("{}: goes on at the clock of its start file, but scenes that are compared "
                        "all begin at 0; remove 'keep_clock'",
                        scene.where("start.keep_clock")));
}

// Each has a folder of its own in that of the comparison.
void number_names(std::vector<Scene>& scenes) {
    std::set<std::string> taken{"frames"};
    for (Scene& scene : scenes) {
        const std::string name = scene.name;
        for (int number = 2; !taken.insert(scene.name).second; ++number)
            scene.name = fmt::format("{}-{}", name, number);
    }
}

ThreadPlan plan_threads_for(const std::vector<Scene>& scenes) {
    if (scenes.empty()) return drawing_threads(0);
    const int wanted = scenes.front().run.threads;
    const int processors = wanted > 0 ? wanted : usable_processors();
    std::int64_t grains = 0;
    for (const Scene& scene : scenes) grains += scene.grains();
    ThreadPlan threads = plan_threads(processors, true, grains);
    threads.engine = std::max(1, threads.engine / static_cast<int>(scenes.size()));  // for each
    return threads;
}

void make_members(const CompareRequest& what, Comparison& all) {
    std::vector<Scene> scenes = read_scenes(what, all.warnings);
    number_names(scenes);
    all.threads = plan_threads_for(scenes);
    std::size_t next = 0;
    for (const fs::path& input : what.inputs) {
        if (is_run(input)) {
            auto record = std::make_unique<RecordedRun>(input, what.sets);
            record->leave_out_damaged();
            for (std::string& line : record->news()) all.warnings.push_back(std::move(line));
            all.members.push_back(std::make_unique<Member>(std::move(record)));
            continue;
        }
        const Scene& scene = scenes[next++];
        check_start(scene);
        const Plan plan = make_plan(scene);
        all.warnings.insert(all.warnings.end(), plan.warnings.begin(), plan.warnings.end());
        all.members.push_back(std::make_unique<Member>(scene, plan, all.threads.engine));
    }
}

std::vector<Scene> scenes_of(const Comparison& all) {
    std::vector<Scene> scenes;
    for (const auto& member : all.members) scenes.push_back(member->scene());
    return scenes;
}

double mean_interval(const std::vector<Frame>& moments) {
    return moments.size() < 2
               ? 0
               : (moments.back().time - moments.front().time) / static_cast<double>(moments.size() - 1);
}

// Of the finished runs the number of that with the fewest frames a second, whose moments the others can
// follow; none when there is no finished run.
std::optional<std::size_t> coarsest(const Comparison& all) {
    std::optional<std::size_t> found;
    double longest = 0;
    for (std::size_t i = 0; i < all.members.size(); ++i) {
        const FrameArchive* archive = all.members[i]->archive();
        if (!archive || (found && mean_interval(archive->moments()) <= longest)) continue;
        longest = mean_interval(archive->moments());
        found = i;
    }
    return found;
}

// The time that all panels can show.
Span common_time(const Comparison& all) {
    Span common{0, std::numeric_limits<double>::infinity()};
    for (const auto& member : all.members) {
        const Span span = member->source().span();
        common.from = std::max(common.from, span.from);
        common.to = std::min(common.to, span.to);
    }
    return common;
}

// Periods after which the beds of all finished runs repeat themselves.
int common_periods(const Comparison& all) {
    int periods = 1;
    for (const auto& member : all.members)
        if (member->archive()) periods = std::lcm(periods, member->archive()->periods());
    return periods;
}

void take_moments_of_record(Comparison& all) {
    const FrameArchive& run = *all.members[all.reference]->archive();
    const auto [from, to] = common_time(all);
    const double hair = 1e-3 * mean_interval(run.moments());
    std::vector<Frame> moments;
    for (const Frame& moment : run.moments())
        if (moment.time >= from - hair && moment.time <= to + hair) moments.push_back(moment);
    if (moments.empty())
        throw UserError(fmt::format("{}: shares no time with the others, which show {:.6g} to {:.6g} s",
                                    run.folder().string(), from, to));
    moments = alike(moments, common_periods(all));
    for (const Frame& moment : moments) all.pictures.instants.push_back({moment.time, 0});
    const Drive& drive = all.members[all.reference]->scene().drive;
    all.film.film.segments = {pacing_of(moments, drive, all.film.film.rate).value_or(FilmSegment())};
}

void take_moments_of_schedule(Comparison& all) {
    const std::vector<Scene> scenes = scenes_of(all);
    all.reference = reference_of(scenes);
    const Plan& plan = all.members[all.reference]->run()->plan();
    all.pictures.instants = instants_of(all.film, plan.clock, plan.steps);
    for (std::string& line : pace_warnings(all.film, plan.clock)) all.warnings.push_back(std::move(line));
    std::set<double> frequencies;
    for (const Scene& scene : scenes) {
        if (!scene.drive.present || !frequencies.insert(scene.drive.frequency).second) continue;
        for (std::string& strobe : strobe_warnings(all.film.film, scene.drive, scene.run.duration))
            all.warnings.push_back(std::move(strobe));
    }
    if (frequencies.size() > 1)
        all.warnings.push_back(
            fmt::format("the drives have {} frequencies: locked frames follow that of {}, and each panel "
                        "shows the moment of "
                        "its own phase that is nearest in time",
                        frequencies.size(), scenes[all.reference].name));
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == '|') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

void make_panels(const CompareRequest& what, Comparison& all) {
    const std::vector<Scene> scenes = scenes_of(all);
    std::vector<std::string> captions = captions_of(scenes);
    if (what.captions) captions = split(*what.captions);
    if (captions.size() != scenes.size())
        throw UserError(
            fmt::format("--captions: has {} parts between its bars for {} panels; write one for each, "
                        "as in \"Γ = 1|Γ = 3\"",
                        captions.size(), scenes.size()));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        all.panels.push_back({scenes[i], captions[i], playback_of(all.members[i]->source(), all)});
        // All plots and clocks are of the time that is shown.
        if (all.pictures.instants.back().time > 0)
            all.panels[i].scene.run.duration = all.pictures.instants.back().time;
    }
    share_colours(all.panels);
    share_reach(all.panels);
    if (!common_of(all.panels).exaggerated)  // then each panel has to say so
        for (Panel& panel : all.panels)
            if (panel.scene.film.exaggerate != 1)
                panel.caption += fmt::format(", wall motion drawn {:.3g}×", panel.scene.film.exaggerate);
    const PanelLayout layout = layout_of(all.panels, all.film.film);
    if (layout.places.empty())
        throw UserError(fmt::format("--size: {}x{} is too small for {} panels; make it larger",
                                    all.film.film.width, all.film.film.height, scenes.size()));
    warn_of_single_moments(all);
    warn_of_pace(all);
    warn_of_what_is_left_out(layout, all);
}

// Name, title and film of the whole: those of the first, a title only when all have it.
Scene whole(const std::vector<Scene>& scenes) {
    Scene film = scenes.front();
    film.name.clear();
    for (const Scene& scene : scenes) {
        film.name += (film.name.empty() ? "" : "-vs-") + scene.name;
        if (scene.film.title != film.film.title) film.film.title.clear();
    }
    constexpr std::size_t longest_name = 80;
    if (film.name.size() > longest_name)
        film.name = fmt::format("{}-and-{}-more", scenes.front().name, scenes.size() - 1);
    film.title = film.film.title.empty() ? film.name : film.film.title;
    return film;
}

}  // namespace

bool Comparison::all_recorded() const {
    return std::all_of(members.begin(), members.end(), [](const auto& member) { return member->archive(); });
}

Comparison read_comparison(const CompareRequest& what, const FilmRequest& film) {
    if (!film.film && !film.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
    if (const std::size_t count = what.inputs.size(); count < 2 || count > most_panels)
        throw UserError(fmt::format(
            "compare takes 2 to {} scenes or folders of runs, not {}; see grainreel compare --help",
            most_panels, count));
    Comparison all;
    make_members(what, all);
    all.film = whole(scenes_of(all));
    if (const auto record = coarsest(all)) {
        all.reference = *record;
        take_moments_of_record(all);
    } else {
        take_moments_of_schedule(all);
    }
    all.pictures.segments = all.film.film.segments;
    make_panels(what, all);
    return all;
}

}  // namespace grainreel
