#include "render/film/run/resumed_film.hpp"

#include <algorithm>

#include "engine/files/run_names.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/sampling/timeline.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr double shown_for = 2;  // s of simulated time that the caption stays

// Whether each picture shows one moment, and nothing that the kept moment lacks.
bool is_of_single_moments(const Film& film) {
    const bool spans =
        std::any_of(film.segments.begin(), film.segments.end(),
                    [](const FilmSegment& segment) { return segment.exposure > 0 || segment.average > 0; });
    return !spans && !needs_displacement(film.shows) && !needs_touches(film.shows);
}

// The first step before `end` at which the film that is to be made and the pictures whose moments were kept
// differ; `end` when there is none. A locked picture may have been left out.
std::int64_t film_agrees_until(const FilmedScene& scene, const Plan& plan,
                               const std::vector<std::int64_t>& kept, std::int64_t first, std::int64_t end) {
    const std::vector<Instant> instants = instants_of(scene, plan.clock, plan.steps);
    std::size_t k = 0;
    for (const Shot& shot : shots_at(instants, scene.film.segments, plan.clock, plan.steps)) {
        if (shot.step >= end) break;
        if (shot.step < first) continue;
        if (k < kept.size() && kept[k] == shot.step) {
            ++k;
            continue;
        }
        const FilmSegment& rule = scene.film.segments.at(static_cast<std::size_t>(shot.segment));
        const bool left_out =
            rule.kind == FilmSegment::Kind::locked && k < kept.size() && kept[k] > shot.step;
        if (!left_out) return k < kept.size() ? std::min(shot.step, kept[k]) : shot.step;
    }
    return k < kept.size() ? std::min(end, kept[k]) : end;
}

// Captions do not overlap: the one that is there then ends, and the next one comes when it did.
void add_caption(FilmedScene& scene, double time, const std::string& text) {
    std::vector<FilmCaption>& captions = scene.film.captions;
    const auto next = std::find_if(captions.begin(), captions.end(),
                                   [&](const FilmCaption& caption) { return caption.from >= time; });
    if (next != captions.end() && next->from == time) {
        next->text += "\n" + text;
        return;
    }
    double end = std::min(time + shown_for, scene.run.duration);
    if (next != captions.end()) end = std::min(end, next->from);
    if (next != captions.begin()) (next - 1)->to = std::min((next - 1)->to, time);
    captions.insert(next, {time, end, text, 0});
}

}  // namespace

bool has_film(const FilmedScene& scene, const fs::path& run) {
    const std::string name = film_file_name(scene.film.format);
    return (!name.empty() && (is_there(run / name) || is_there(run / (name + ".part")))) ||
           is_there(run / "movie.work") || is_there(run / "frames") || is_there(run / kFilmMoments);
}

FramesReach reach_of_film(const FilmedScene& scene, const Plan& plan) {
    return [&](const std::vector<std::int64_t>& kept, std::int64_t first, std::int64_t last) {
        return is_of_single_moments(scene.film) ? film_agrees_until(scene, plan, kept, first, last) : first;
    };
}

void add_caption_of_change(FilmedScene& scene, double time, const std::string& text) {
    if (text.empty()) return;
    add_caption(scene, time, text);
    tell_engine(scene);
}

}  // namespace grainreel
