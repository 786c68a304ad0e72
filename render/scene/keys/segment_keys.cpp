// The keys of [[film.segment]]: which stretches of time the film shows, and how fast.
#include <fmt/format.h>

#include "engine/base/numbers.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

using namespace keys;
using Kind = FilmSegment::Kind;

const ChoiceWords<Kind> kind_words{{"motion", Kind::motion}, {"locked", Kind::locked}};

const char* of_locked(const char* reason, const FilmSegment& segment) {
    return segment.kind == Kind::motion ? reason : nullptr;
}

const char* beside_average(const FilmSegment& segment) {
    return segment.average > 0 ? "a mean over periods has no shutter; keep one of the two" : nullptr;
}

const char* without_exposure(const FilmSegment& segment) {
    return segment.exposure == 0 ? "they are moments of an 'exposure'" : nullptr;
}

const KeyTable<FilmSegment>& segment_table() {
    using S = FilmSegment;
    static const KeyTable<S> table{
        choice("kind", &S::kind, kind_words, initial(),
               "Even in time, or one frame every so many periods at a fixed phase.")
            .owns({"playback", "every", "phase", "between"})
            .read_at(-1),
        quantity("duration", &S::duration, Dimension::time, positive, note("what the others leave"),
                 "Simulated time; one segment may go without."),
        quantity("playback", &S::playback, Dimension::number, positive, initial(),
                 "motion: simulated seconds a second of film; 0.1 is ten times slower.")
            .useless_for([](const S& segment) {
                return segment.kind == Kind::locked ? "a locked segment has 'every' and 'phase'" : nullptr;
            }),
        integer("every", &S::every, 1, 4, initial(), "locked: periods a frame, 1, 2 or 4.")
            .useless_for(
                [](const S& segment) { return of_locked("a segment in motion has a 'playback'", segment); }),
        quantity("phase", &S::phase, Dimension::phase, any, initial(),
                 "locked: \"90 deg\" or 0.25 turns; beyond one turn with a unit only.")
            .useless_for(
                [](const S& segment) { return of_locked("a segment in motion shows every phase", segment); }),
        integer(
            "between", &S::between, 0, 30, initial(),
            "locked: pictures between two of these frames, with the grains on the straight way from one to "
            "the next.")
            .useless_for(
                [](const S& segment) { return of_locked("a segment in motion shows every moment", segment); })
            .unwritten_if([](const S& segment) { return segment.between == 0; }),
        integer("average", &S::average, 1, 1000, note("no mean"),
                "The picture shows the grains' mean places over so many whole periods that end at its "
                "moment.")
            .unwritten_if([](const S& segment) { return segment.average == 0; }),
        quantity("exposure", &S::exposure, Dimension::time, positive, note("one moment"),
                 "Time up to the picture for which the shutter is open: what moves leaves a streak.")
            .useless_for(beside_average)
            .unwritten_if(without_exposure),
        integer("exposures", &S::exposures, 2, 1000, initial(),
                "Moments in that time; locked: whole periods apart.")
            .useless_for(without_exposure),
    };
    return table;
}

FilmSegment read_segment(Document& document, const Scene& scene, const std::string& table) {
    FilmSegment segment;
    segment_table().read(document, scene, table, segment);
    if (segment.average > 0 && !scene.drive.present)
        document.fail(table + ".average",
                      "counts periods of the drive, but nothing oscillates; add [drive] or leave it");
    if (segment.kind == Kind::locked && !scene.drive.present)
        document.fail(table + ".kind",
                      "is \"locked\", but nothing oscillates; add [drive] or write \"motion\"");
    if (segment.between > 0 && (segment.average > 0 || segment.exposure > 0))
        document.fail(
            table + ".between",
            "puts grains on their way between two moments, which 'average' and 'exposure' do not go "
            "with; keep one of them");
    if (segment.every == 3) document.fail(table + ".every", "must be 1, 2 or 4, but is 3; write 2 or 4");
    return segment;
}

// The durations of segments must fit in the run. If the command line makes the run shorter, they are
// shortened too: to half of the run in all if some segment takes the rest, otherwise to all of the run.
void fit_segments(Document& document, FilmedScene& scene) {
    double given = 0;
    std::size_t open = 0;
    for (std::size_t i = 0; i < scene.film.segments.size(); ++i) {
        const FilmSegment& segment = scene.film.segments[i];
        given += segment.duration.value_or(0);
        if (!segment.duration && ++open > 1)
            document.fail(
                fmt::format("film.segment[{}].duration", i),
                "is missing, and of an earlier segment too; only one may take what the others leave");
    }
    const double duration = scene.run.duration;
    if (open > 0 ? clearly_less(given, duration) : !clearly_more(given, duration)) return;
    if (!document.from_command_line("run.duration"))
        document.fail("film.segment",
                      fmt::format("shows {:.6g} s{}, but the run has {:.6g} s; shorten the segments or "
                                  "lengthen run.duration",
                                  given, open > 0 ? " and more" : "", duration));
    const double scale = (open > 0 ? 0.5 : 1.0) * duration / given;
    for (FilmSegment& segment : scene.film.segments)
        if (segment.duration) *segment.duration *= scale;
}

}  // namespace

void list_segments(Keys& all) {
    segment_table().list(all, "film.segment[]");
}

void read_segments(Document& document, FilmedScene& scene) {
    Film& film = scene.film;
    for (std::size_t i = 0; i < document.size("film.segment"); ++i)
        film.segments.push_back(read_segment(document, scene, fmt::format("film.segment[{}]", i)));
    if (film.segments.empty()) film.segments = default_segments(scene);
    fit_segments(document, scene);
}

void write_segments(SceneText& out, const FilmedScene& scene) {
    for (const FilmSegment& segment : scene.film.segments) {
        out.element("film.segment");
        segment_table().write(out, scene, segment);
    }
}

}  // namespace grainreel
