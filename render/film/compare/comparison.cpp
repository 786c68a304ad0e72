#include "render/film/compare/comparison.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/compare/comparison_words.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

std::vector<FilmedScene> scenes_of(const Comparison& all) {
    std::vector<FilmedScene> scenes;
    for (const auto& member : all.members) scenes.push_back(member->scene());
    return scenes;
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
    const std::vector<FilmedScene> scenes = scenes_of(all);
    std::vector<std::string> captions = all.labels.empty() ? captions_of(scenes) : all.labels;
    if (what.captions) captions = all.captions = split(*what.captions);
    for (const std::string& caption : captions)
        if (letters_in(caption) > kMostLetters)
            throw UserError("--captions: one has {} characters, and the most are {}; shorten it",
                            letters_in(caption), kMostLetters);
    if (captions.size() != scenes.size())
        throw UserError(
            "--captions: has {} parts between its bars for {} panels; write one for each, "
            "as in \"Γ = 1|Γ = 3\"",
            captions.size(), scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        all.panels.push_back({scenes[i], captions[i], {}});
        // A still has no words about how fast it plays.
        if (all.still)
            all.panels[i].playback.resize(all.pictures.segments.size());
        else
            all.panels[i].playback = playback_of(all.members[i]->source(), all);
        // All plots and clocks cover the time that is shown.
        if (all.film_end > 0) all.panels[i].scene.run.duration = all.film_end;
    }
    share_colours(all.panels);
    share_reach(all.panels);
    if (!common_of(all.panels).exaggerated)  // if the factors differ, each panel has its own words
        for (Panel& panel : all.panels)
            if (panel.scene.film.exaggerate != 1)
                panel.caption += fmt::format(", wall motion drawn {:.3g}×", panel.scene.film.exaggerate);
    const PanelLayout layout = layout_of(all.panels, all.film.film);
    if (layout.places.empty())
        throw UserError("{}: {}x{} is too small for {} panels; make it larger", all.film.where("film.size"),
                        all.film.film.width, all.film.film.height, scenes.size());
    warn_of_single_moments(all);
    warn_of_pace(all);
    warn_of_what_is_left_out(layout, all);
    warn_of_missing_letters(all);
}

// The scene that stands for the whole film. It has the film of the first scene, a name made of all names, and
// a title on the film only if all scenes have the same one.
FilmedScene whole(const std::vector<FilmedScene>& scenes) {
    FilmedScene film = scenes.front();
    film.name.clear();
    for (const FilmedScene& scene : scenes) {
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
    if (!what.at && !film.film && !film.frames)
        throw UserError("--no-film: leaves nothing to draw; add --frames for the pictures");
    Comparison all;
    read_members(what, all);
    all.film = whole(scenes_of(all));
    fit_to_paper(all.film.film, what.print);
    all.dots_an_inch = dots_an_inch(what.print);
    all.pdf = what.print.pdf;
    choose_moments(what, all);
    make_panels(what, all);
    return all;
}

// Chooses the moments that all panels show: the moments of the film's segments, or, where a finished run
// cannot give these, the moments that it kept.

namespace {

constexpr double hair = 1e-9;  // s: tolerance of times

// Index of the finished run with the fewest frames a second; the other runs have frames at least as often.
// None when there is no finished run.
std::optional<std::size_t> coarsest(const Comparison& all) {
    std::optional<std::size_t> found;
    double longest = 0;
    for (std::size_t i = 0; i < all.members.size(); ++i) {
        const StateArchive* archive = all.members[i]->archive();
        if (!archive || (found && archive->mean_interval() <= longest)) continue;
        longest = archive->mean_interval();
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

// Number of periods after which the beds of all finished runs repeat themselves.
int common_periods(const Comparison& all) {
    int periods = 1;
    for (const auto& member : all.members)
        if (member->archive()) periods = std::lcm(periods, member->archive()->periods());
    return periods;
}

bool has_all(const ComparedMember& member, const Pictures& pictures) {
    return member.record() == nullptr || member.record()->has_all(pictures);
}

// Takes the moments of the film's schedule. Returns false if there are none, or if a finished run lacks one
// of them.
bool take_moments_of_schedule(Comparison& all) {
    all.reference = reference_of(scenes_of(all));
    const Clock& clock = all.members[all.reference]->clock();
    if (clock.step <= 0) return false;
    const Span common = common_time(all);
    const bool any_moment = std::all_of(all.members.begin(), all.members.end(),
                                        [](const auto& member) { return member->source().has_any_moment(); });
    FilmedScene film = all.film;
    if (!any_moment) film.film.segments = of_single_moments(segments_of(film.film));
    for (FilmSegment& segment : film.film.segments) segment = spanning(segment, common_periods(all));
    Pictures pictures;
    pictures.instants = instants_of(film, clock, std::llround(common.to / clock.step));
    std::erase_if(pictures.instants, [&](const Instant& one) {
        return one.time < common.from - hair || one.time > common.to + 0.5 * clock.step;
    });
    pictures.segments = film.film.segments;
    if (pictures.instants.empty()) return false;
    for (const auto& member : all.members)
        if (!has_all(*member, pictures)) return false;
    all.film = std::move(film);
    all.pictures = std::move(pictures);
    return true;
}

void warn_of_schedule(Comparison& all) {
    const std::vector<FilmedScene> scenes = scenes_of(all);
    for (std::string& line : pace_warnings(all.film, all.members[all.reference]->clock()))
        all.warnings.push_back(std::move(line));
    std::set<double> frequencies;
    for (const FilmedScene& scene : scenes) {
        if (!scene.drive.present || !frequencies.insert(scene.drive.frequency).second) continue;
        for (std::string& strobe : strobe_warnings(all.film.film, scene.drive, scene.run.duration))
            all.warnings.push_back(std::move(strobe));
    }
    if (frequencies.size() > 1)
        all.warnings.push_back(
            fmt::format("the drives have {} frequencies: locked frames follow that of {}, and each panel "
                        "shows the moment of its own phase that is nearest in time",
                        frequencies.size(), scenes[all.reference].name));
}

void take_moments_of_record(Comparison& all) {
    all.by_schedule = false;
    all.reference = *coarsest(all);
    const StateArchive& run = *all.members[all.reference]->archive();
    const auto [from, to] = common_time(all);
    const double room = 1e-3 * run.mean_interval();
    std::vector<State> moments;
    for (const State& moment : run.moments())
        if (moment.time >= from - room && moment.time <= to + room) moments.push_back(moment);
    if (moments.empty())
        throw UserError("{}: shares no time with the others, which show {:.6g} to {:.6g} s",
                        run.path().string(), from, to);
    moments = alike(moments, common_periods(all));
    for (const State& moment : moments) all.pictures.instants.push_back({moment.time, 0});
    const Drive& drive = all.members[all.reference]->scene().drive;
    all.film.film.segments = {pacing_of(moments, drive, all.film.film.rate).value_or(FilmSegment())};
    all.pictures.segments = all.film.film.segments;
    std::set<std::string> said;
    for (const auto& member : all.members) {
        const std::string why = member->record() ? member->record()->why_not_all() : "";
        if (!why.empty() && said.insert(why).second)
            all.warnings.push_back(
                fmt::format("{}; the film shows the moments that {} kept, and not its segments", why,
                            run.path().string()));
    }
}

// s: how long the trails are that the panels draw; 0 without trails.
double trails_of(const Comparison& all) {
    double longest = 0;
    for (const auto& member : all.members) {
        const FilmTrails& trails = member->scene().film.shows.trails;
        if (trails.wanted()) longest = std::max(longest, trails.duration);
    }
    return longest;
}

// Puts the film's moments before the still's one, back to where its trails begin, if all panels have them.
void take_moments_of_trails(const std::vector<Instant>& film, Comparison& all) {
    constexpr double room = 1.001;
    const double longest = trails_of(all);
    Pictures with_trails = all.pictures;
    std::vector<Instant>& instants = with_trails.instants;
    const Instant first = instants.front(), last = instants.back();
    const bool from_start = instants.size() > 1;
    for (const Instant& one : film)
        if (one.time < last.time - hair && one.time >= last.time - room * longest &&
            (!from_start || one.time > first.time + hair))
            instants.insert(instants.end() - 1, {one.time, last.segment});
    if (std::all_of(all.members.begin(), all.members.end(),
                    [&](const auto& member) { return has_all(*member, with_trails); }))
        all.pictures = std::move(with_trails);
}

// Takes the one moment of a still. It is shown even if the segment there is locked to a phase and the moment
// has another phase.
void take_one(double at, Comparison& all) {
    const Span common = common_time(all);
    // The ends of runs lie at whole steps, and messages show times with six digits.
    double room = hair + 1e-5 * std::abs(at);
    for (const auto& member : all.members) room = std::max(room, 1.001 * member->clock().step);
    if (at < common.from - room || at > common.to + room)
        throw UserError(
            "--at: {:.6g} s is outside the time that all show, which goes from {:.6g} "
            "to {:.6g} s",
            at, common.from, common.to);
    at = std::clamp(at, common.from, common.to);
    std::vector<Instant>& instants = all.pictures.instants;
    const std::vector<Instant> film = instants;
    const auto after = std::upper_bound(instants.begin(), instants.end(), at + hair,
                                        [](double time, const Instant& one) { return time < one.time; });
    const std::ptrdiff_t place = std::max<std::ptrdiff_t>(0, after - instants.begin() - 1);
    all.still = static_cast<double>(place) / all.film.film.rate;
    const int segment = instants.at(static_cast<std::size_t>(place)).segment;
    // Heights at the start are those of the film's first picture.
    const Instant first = instants.front();
    const bool from_start =
        first.time < at - hair && std::any_of(all.members.begin(), all.members.end(), [](const auto& member) {
            return shows_value(member->scene().film.shows, GrainValue::start_height);
        });
    instants = {{at, segment}};
    if (from_start) instants.insert(instants.begin(), {first.time, segment});
    for (FilmSegment& one : all.pictures.segments) one.kind = FilmSegment::Kind::motion;
    if (trails_of(all) > 0) take_moments_of_trails(film, all);
    for (const auto& member : all.members) {
        if (has_all(*member, all.pictures)) continue;
        const double shown = member->source().moments(all.pictures).back().time;
        all.warnings.push_back(
            fmt::format("--at: {:.6g} s was not kept ({}); {:.6g} s is drawn of {}, the "
                        "kept moment that is nearest",
                        at, member->record()->why_not_all(), shown, member->place()));
    }
}

}  // namespace

void choose_moments(const CompareRequest& what, Comparison& all) {
    if (take_moments_of_schedule(all))
        warn_of_schedule(all);
    else if (coarsest(all))
        take_moments_of_record(all);
    else
        throw UserError("the scenes share no moment that a film could show");
    all.film_pictures = static_cast<std::int64_t>(all.pictures.instants.size());
    all.film_end = all.pictures.instants.back().time;
    if (what.at) take_one(*what.at, all);
}

}  // namespace grainreel
