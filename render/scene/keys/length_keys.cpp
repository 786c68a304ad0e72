// The key `length` of [film], and the pace of a film whose scene gives no segments.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/lists.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

using namespace keys;
using Kind = FilmSegment::Kind;

// Slow motion at the ends of a film with a drive: at least ten times slower, and slow enough for 8 frames a
// period and for at most three periods a second of film; more would flash.
double slow_playback(const FilmedScene& scene) {
    const double frequency = scene.drive.highest_frequency();
    return std::min({0.1, scene.film.rate / (8 * frequency), 3 / frequency});
}

// s: the time in which a grain at rest falls its own diameter. Without gravity it is the time in which the
// fastest listed grain comes that far. 0 if the scene gives neither.
double time_of_a_diameter(const FilmedScene& scene) {
    const double diameter = mean_diameter(scene), gravity = scene.gravity.norm();
    if (gravity > 0) return std::sqrt(2 * diameter / gravity);
    double fastest = 0;
    for (const ListedGrain& grain : scene.start.grains) fastest = std::max(fastest, grain.velocity.norm());
    return fastest > 0 ? diameter / fastest : 0;
}

// The playback of a film without a drive: a grain takes a fifth of a second of film to fall its diameter,
// which the eye can follow. A long run is not slowed down so much: its film takes half a minute. Never faster
// than life.
double falling_playback(const FilmedScene& scene) {
    constexpr double seconds_a_diameter = 0.2, longest = 30;  // s of film
    const double time = time_of_a_diameter(scene);
    if (!(time > 0)) return 1;
    const double playback = std::max(time / seconds_a_diameter, scene.run.duration / longest);
    return std::min(1.0, playback);
}

// Periods of the drive that have gone by at a time, s.
double cycles_at(const Drive& drive, double time) {
    return drive.changes() ? DriveSchedule(drive).times().cycles(time) : time * drive.frequency;
}

// s of film that locked frames of this segment take from one simulated time to another.
double locked_seconds(const FilmedScene& scene, const FilmSegment& rule, double from, double to) {
    const int every = std::lcm(rule.every, std::max(1, scene.film.periods));
    const double moments = (cycles_at(scene.drive, to) - cycles_at(scene.drive, from)) / every;
    return moments * (rule.between + 1) / scene.film.rate;
}

double held_seconds(const Film& film) {
    double seconds = 0;
    for (const FilmCaption& caption : film.captions) seconds += caption.hold;
    return seconds;
}

// s of film, in the parts that film.length distinguishes.
struct Parts {
    double held = 0;       // pictures that stand still under captions
    double locked = 0;     // locked segments
    double in_motion = 0;  // segments in motion, at their present playback
    double slowed = 0;     // of these, those whose playback is to be found
    double simulated = 0;  // s of simulated time that these show
};

// open: the numbers of the segments whose playback is to be found.
Parts parts_of(const FilmedScene& scene, const std::vector<std::size_t>& open) {
    const std::vector<FilmSegment>& segments = scene.film.segments;
    double given = 0;
    for (const FilmSegment& segment : segments) given += segment.duration.value_or(0);
    const double left = std::max(0.0, scene.run.duration - given);
    Parts parts;
    parts.held = held_seconds(scene.film);
    double start = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const double lasts = segments[i].duration.value_or(left);
        if (segments[i].kind == Kind::locked) {
            parts.locked += locked_seconds(scene, segments[i], start, start + lasts);
        } else {
            parts.in_motion += lasts / segments[i].playback;
            if (contains(open, i)) {
                parts.slowed += lasts / segments[i].playback;
                parts.simulated += lasts;
            }
        }
        start += lasts;
    }
    return parts;
}

// The segments in motion that have no playback of their own; all in motion if each has one.
std::vector<std::size_t> open_segments(const Document& document, const std::vector<FilmSegment>& segments) {
    std::vector<std::size_t> moving, open;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (segments[i].kind != Kind::motion) continue;
        moving.push_back(i);
        if (!document.has(fmt::format("film.segment[{}].playback", i))) open.push_back(i);
    }
    return open.empty() ? moving : open;
}

// Without segments of its own, a film with a drive gets more or less slow motion at its ends. If even a film
// that is locked all the way is too long, fewer frames are locked.
void fit_own_segments(Document& document, FilmedScene& scene, double length) {
    std::vector<FilmSegment>& segments = scene.film.segments;
    const double duration = scene.run.duration, slow = slow_playback(scene);
    double all_locked = 0;
    for (const int every : {1, 2, 4}) {
        segments[1].every = every;
        all_locked = locked_seconds(scene, segments[1], 0, duration);
        if (all_locked <= length) break;
    }
    if (all_locked > length)
        document.fail(
            "film.length",
            fmt::format("is {:.3g} s too short for one frame in four periods of the drive; write more, or "
                        "segments of your own",
                        all_locked - length));
    const double slower = 1 / slow - all_locked / duration;  // s of film that a second of slow motion adds
    const double ends = slower > 0 ? (length - all_locked) / slower : 0;
    if (ends >= duration || slower <= 0) {
        segments = {FilmSegment()};
        segments[0].playback = duration / length;
        return;
    }
    segments[0].duration = segments[2].duration = 0.5 * ends;
    if (ends <= 0) segments = {segments[1]};
}

void fit_length(Document& document, FilmedScene& scene, double length) {
    const bool own = document.size("film.segment") > 0;
    const double held = held_seconds(scene.film);
    if (length <= held)
        document.fail(
            "film.length",
            fmt::format("is {:.4g} s, but the film stands still for {:.4g} s under its captions (hold); "
                        "write more",
                        length, held));
    if (!own && scene.film.segments.size() > 1) return fit_own_segments(document, scene, length - held);
    const std::vector<std::size_t> open = open_segments(document, scene.film.segments);
    if (open.empty())
        document.fail(
            "film.length",
            "needs a segment in motion, whose playback follows from it; locked frames have 'every' and "
            "'between'");
    const Parts parts = parts_of(scene, open);
    const double room = length - parts.held - parts.locked - (parts.in_motion - parts.slowed);
    if (room <= 0)
        document.fail(
            "film.length",
            fmt::format("is {:.4g} s, but without the segments whose playback it decides the film takes "
                        "{:.4g} s; write more",
                        length, length - room));
    for (const std::size_t i : open) scene.film.segments[i].playback *= parts.slowed / room;
}

const KeyTable<FilmedScene>& length_table() {
    static const KeyTable<FilmedScene> table{
        bound_by<FilmedScene>(
            quantity("length", Dimension::time, positive, note("by the segments"),
                     "Of the whole film: the playback of segments in motion follows, of those that give "
                     "none, or of "
                     "all alike."),
            [](Document& document, const Scene&, const std::string& path, FilmedScene& scene) {
                double length = 0;
                keys::read_value(document, path, length);
                if (length > 0) fit_length(document, scene, length);
            },
            [](const FilmedScene&, const Scene&) { return std::string(); }),
    };
    return table;
}

}  // namespace

std::vector<FilmSegment> default_segments(const FilmedScene& scene) {
    FilmSegment motion;
    if (!scene.drive.present) {
        motion.playback = falling_playback(scene);
        return {motion};
    }
    motion.playback = slow_playback(scene);
    motion.duration = std::min(4 * motion.playback, 0.1 * scene.run.duration);
    FilmSegment between;
    between.kind = Kind::locked;
    return {motion, between, motion};
}

void list_length(Keys& all) {
    length_table().list(all, "film");
}

void read_length(Document& document, FilmedScene& scene) {
    length_table().read(document, scene, "film", scene);
}

}  // namespace grainreel
