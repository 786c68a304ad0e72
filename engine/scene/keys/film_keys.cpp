// The keys of the film.
#include "engine/scene/film/grain_values.hpp"
#include "engine/scene/film/purposes.hpp"
#include "engine/scene/keys/key_parts.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel::keys {
namespace {

// What is drawn beside grains and walls, and how the walls' motion is shown.
void add_film_marks(Keys& keys) {
    keys.push_back(choice("film.words", all_of(word_place_words), literal("\"automatic\""),
                          "Words beside the picture, on plates over it, or none; automatic: plates with a "
                          "zoom, position or target of your own."));
    keys.push_back(entry("film.axes", KeyKind::flag, note("true where the camera moves"),
                         "Arrows along x, y and z as the camera sees them."));
    keys.push_back(entry("film.wall_ghost", KeyKind::flag, literal("false"),
                         "A faint outline of the container at rest."));
    keys.push_back(quantity("film.exaggerate", Dimension::number, {1, 1000, false, false}, literal("1"),
                            "The container's motion drawn so many times as large, its grains with it."));
}

const Range magnification{0.001, 10000, false, false};

// How the camera stands and moves.
void add_camera_path(Keys& keys) {
    const auto place = [&](const char* path, const char* fallback, const char* about) {
        keys.push_back(
            of_dimension(entry(path, KeyKind::vector, note(fallback), about), Dimension::length, any));
    };
    keys.push_back(choice("film.camera.frame", all_of(camera_frame_words), literal("\"reach\""),
                          "Framed: all of the container, the bed at rest, or what the grains reach."));
    keys.push_back(quantity("film.camera.reach", Dimension::length, positive,
                            note("of a live run estimated, of a finished one measured"),
                            "Height above the floor that the grains reach."));
    place("film.camera.position", "by azimuth, elevation and automatic framing",
          "Where the camera stands; nothing is framed then.");
    place("film.camera.target", "the container's middle",
          "The middle of the picture, and what an orbit turns about.");
    keys.push_back(quantity("film.camera.orbit", Dimension::degrees, any, literal("0"),
                            "Turned about the vertical through the target; negative to the left."));
    keys.push_back(quantity("film.camera.orbit_time", Dimension::time, positive, note("the film's length"),
                            "Film time in which the orbit is turned; it goes on after that."));
    keys.push_back(quantity("film.camera.key[].time", Dimension::time, not_negative, required(),
                            "Film time at which the camera is there; smoothly in between."));
    keys.push_back(quantity("film.camera.key[].azimuth", Dimension::degrees, any,
                            note("film.camera's at first, then between keys"),
                            "As film.camera.azimuth; beyond 360 it turns on."));
    keys.push_back(quantity("film.camera.key[].elevation", Dimension::degrees, {-90, 90, false, false},
                            note("film.camera's at first, then between keys"), "As film.camera.elevation."));
    keys.push_back(quantity("film.camera.key[].zoom", Dimension::number, magnification,
                            note("film.camera's at first, then between keys"), "As film.camera.zoom."));
    place("film.camera.key[].target", "film.camera's at first, then between keys", "As film.camera.target.");
}

Key ids(std::string path, const char* about) {
    Key key = integer(std::move(path), 0, most_grains, note("none"), about);
    key.kind = KeyKind::integer_list;
    return key;
}

void add_shows(Keys& keys) {
    keys.push_back(choice("film.colour.by", all_of(grain_value_words), literal("\"species\""),
                          "What a grain's colour stands for; see docs/guide/colours.md."));
    keys.push_back(choice("film.colour.map", all_of(colour_map_words),
                          note("viridis; vik for what has two signs"),
                          "All three are safe for the colour-blind; vik runs from blue over white to red."));
    keys.push_back(entry("film.colour.range", KeyKind::interval, note("from the drive and the bed"),
                         "Of the quantity, [\"0 m/s\", \"0.5 m/s\"]: the map's ends, for the whole film."));
    keys.push_back(entry("film.colour.unit", KeyKind::text, note("one that fits the range"),
                         "Of the colour bar, for example \"cm/s\"."));
    keys.push_back(integer("film.colour.layers", 2, 12, literal("5"), "Bands of start-height."));
    keys.push_back(entry("film.text", KeyKind::text, note("none"),
                         "Words beside the grains; {lacey} or {kinetic:mJ} are values of measures.csv."));
    keys.push_back(entry("film.plot[].y", KeyKind::text, required(),
                         "A column of measures.csv, drawn against time: height_difference, lacey, kinetic."));
    keys.push_back(entry("film.plot[].label", KeyKind::text, note("by the column"), "Above the plot."));
    keys.push_back(
        entry("film.plot[].range", KeyKind::interval, note("grows with the data"), "Of the vertical axis."));
    keys.push_back(integer("film.arrows.grid", 2, 100, note("required in this table"),
                           "Cells across the container's width; one arrow each: the grains' mean velocity."));
    keys.push_back(choice("film.arrows.of", {"period", "now"}, note("period with a drive, else now"),
                          "Of the last period of the drive, or of this moment."));
    keys.push_back(quantity("film.arrows.speed", Dimension::speed, positive,
                            note("a diameter in five periods; of now: the drive's"),
                            "Of an arrow as long as a cell is wide."));
    keys.push_back(
        entry("film.trails.species", KeyKind::name_list, note("none"), "Species whose grains leave trails."));
    keys.push_back(ids("film.trails.grains", "Ids of grains that leave trails."));
    keys.push_back(quantity("film.trails.duration", Dimension::time, positive,
                            note("10 periods; a tenth of the run without a drive"), "How long they are."));
}

void add_film_cut(Keys& keys) {
    keys.push_back(entry("film.cut.normal", KeyKind::vector, note("[1, 0, 0]"),
                         "Opens the bed along a plane: what lies on this side of it is taken away."));
    keys.push_back(quantity("film.cut.at", Dimension::length, any, note("0"),
                            "Distance of that plane from the origin, along the normal."));
    keys.push_back(quantity("film.cut.thickness", Dimension::length, positive, note("all behind it"),
                            "Of the slab behind the plane that is kept."));
}

}  // namespace

void add_film(Keys& keys) {
    keys.push_back(
        entry("film.size", KeyKind::picture_size, literal("\"1920x1080\""), "Width and height, pixels."));
    keys.push_back(
        quantity("film.rate", Dimension::number, {1, 240, false, false}, literal("30"), "Frames a second."));
    keys.push_back(integer("film.periods", 1, 4, note("as the bed does"),
                           "Periods of the drive that locked frames, displacements and means go by."));
    keys.push_back(entry("film.title", KeyKind::text, note("`title`"), "Shown on the frame."));
    keys.push_back(integer("film.quality", 0, 51, note("20; 18 with `max_size`"),
                           "x264's crf: 18 near-lossless, 23 small; other codecs take what looks alike."));
    keys.push_back(choice(
        "film.preset",
        {"ultrafast", "superfast", "veryfast", "faster", "fast", "medium", "slow", "slower", "veryslow"},
        literal("\"veryfast\""), "x264's preset (veryfast with subme=1): slower makes smaller files."));
    keys.push_back(choice("film.for", purpose_names(), note("none"),
                          "Defaults for what the film is for: size, rate, format, quality, max_size."));
    keys.push_back(choice("film.format", all_of(film_format_words), literal("\"mp4\""),
                          "mp4 is H.264, webm VP9, ffv1 lossless; docs/guide/films.md compares them."));
    keys.push_back(entry("film.transparent", KeyKind::flag, literal("false"),
                         "png and ffv1 only: alpha in place of the background."));
    keys.push_back(
        entry("film.max_size", KeyKind::text, literal("\"none\""),
              "mp4, webm and gif only: largest file, as in \"10 MB\" (kB, MB, GB, KiB, MiB, GiB)."));
    keys.push_back(entry("film.sheet", KeyKind::picture_size, note("none"),
                         "Columns x rows of sheet.png, frames spread evenly over the film."));
    keys.push_back(entry("film.background", KeyKind::colour, note("\"#ffffff\"; \"#12151b\" with dark"),
                         "As species.colour."));
    keys.push_back(
        choice("film.style", all_of(style_words), literal("\"studio\""),
               "Of the light: soft shadows; even colours with outlines, for print; for dark rooms."));
    keys.push_back(entry("film.occlusion", KeyKind::flag, note("true; false with flat"),
                         "Less light reaches the gaps between grains."));
    keys.push_back(
        entry("film.shadows", KeyKind::flag, note("true; false with flat"), "Of grains on other grains."));
    keys.push_back(entry("film.ground", KeyKind::flag, note("true; false with flat"),
                         "Under the container, to show its shadow."));
    keys.push_back(entry("film.rotation", KeyKind::flag, literal("false"),
                         "Grains are light on one half and dark on the other and so show how they turn."));
    add_film_marks(keys);
    keys.push_back(entry("film.hide", KeyKind::name_list, note("none"), "Species that are not drawn."));
    keys.push_back(entry("film.ghost", KeyKind::name_list, note("none"),
                         "Species that the others are seen through, as if of glass."));
    keys.push_back(ids("film.highlight", "Ids of grains that are ringed."));
    keys.push_back(
        entry("film.highlight_if", KeyKind::text, note("none"),
              "Rings around grains of which this holds: \"speed > 20 cm/s\", \"coordination < 2\"."));
    keys.push_back(entry("film.force_chains", KeyKind::flag, literal("false"),
                         "Lines between grains that touch, as wide as they push."));
    add_film_cut(keys);
    keys.push_back(quantity("film.camera.azimuth", Dimension::degrees, any, literal("20"),
                            "About z; 0 looks along -x at the wide face, positive goes to the right."));
    keys.push_back(quantity("film.camera.elevation", Dimension::degrees, {-90, 90, false, false},
                            literal("10"), "Above the horizon."));
    keys.push_back(quantity("film.camera.field_of_view", Dimension::degrees, {0, 120, false, false},
                            literal("25"), "Vertical; 0 for orthographic."));
    keys.push_back(quantity("film.camera.zoom", Dimension::number, magnification, literal("1"),
                            "Over the automatic framing."));
    keys.push_back(
        entry("film.camera.follow", KeyKind::flag, literal("false"), "Stand in the container's own frame."));
    add_camera_path(keys);
    keys.push_back(choice("film.segment[].kind", {"motion", "locked"}, literal("\"motion\""),
                          "Even in time, or one frame every so many periods at a fixed phase."));
    keys.push_back(quantity("film.segment[].duration", Dimension::time, positive,
                            note("what the others leave"), "Simulated time; one segment may go without."));
    keys.push_back(quantity("film.segment[].playback", Dimension::number, positive, literal("1"),
                            "motion: simulated seconds a second of film; 0.1 is ten times slower."));
    keys.push_back(
        integer("film.segment[].every", 1, 4, literal("1"), "locked: periods a frame, 1, 2 or 4."));
    keys.push_back(quantity("film.segment[].phase", Dimension::phase, any, literal("0"),
                            "locked: \"90 deg\" or 0.25 turns; beyond one turn with a unit only."));
    keys.push_back(integer("film.segment[].average", 1, 1000, note("no mean"),
                           "Whole periods up to the picture, of which it shows the grains' mean places."));
    keys.push_back(
        quantity("film.segment[].exposure", Dimension::time, positive, note("one moment"),
                 "Time up to the picture for which the shutter is open: what moves leaves a streak."));
    keys.push_back(integer("film.segment[].exposures", 2, 1000, literal("16"),
                           "Moments in that time; locked: whole periods apart."));
    add_shows(keys);
}

}  // namespace grainreel::keys
