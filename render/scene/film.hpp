// What a scene file says of its film: plain values in SI units, defaults filled in.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/scene/live_text.hpp"

namespace grainreel {

// How the pictures of the film are lit, and where the bed is opened.

// A plane that opens the bed: grains are kept on the side that its normal points away from, those that it
// crosses show a flat face. It goes with the container.
struct FilmCut {
    bool present = false;
    Vec3 normal{1, 0, 0};  // unit, towards what is taken away
    double at = 0;         // m, of the plane from the origin, along the normal
    double thickness = 0;  // m, of the slab that is kept; 0: all behind the plane
    bool operator==(const FilmCut&) const = default;
};

// How meshes are drawn.
struct FilmWalls {
    // plain: as walls are; else by what the grains do to each triangle: how hard they press on it, or how
    // they wear it.
    enum class Colour { plain, pressure, wear };
    Colour colour = Colour::plain;
    // Range of the colours for the whole film, in Pa or J/m2. It has no meaning where walls are plain.
    std::array<double, 2> range{0, 0};
    bool fixed = false;              // the range is the user's
    double edge_angle = 30;          // degrees; edges whose faces turn more are drawn
    std::vector<std::string> solid;  // names of meshes that are solid from all sides
    std::vector<std::string> glass;  // names of meshes that are glass from outside
    bool coloured() const { return colour != Colour::plain; }
    // Steps of the colour are ratios; else, where the range begins at 0, differences.
    bool logarithmic() const { return range[0] > 0; }
    bool operator==(const FilmWalls&) const = default;
};

struct FilmLook {
    enum class Style { studio, flat, dark };
    Style style = Style::studio;
    bool occlusion = true;  // darkness between grains
    bool shadows = true;    // of grains on grains
    bool ground = true;     // a ground that the container throws its shadow on
    bool rotation = false;  // two-tone grains that show how they turn; needs orientations
    FilmCut cut;
    FilmWalls walls;
    bool operator==(const FilmLook&) const = default;

    // What a style means where nothing else is said.
    static FilmLook of(Style style) {
        const bool lit = style != Style::flat;
        return {style, lit, lit, lit, false, {}, {}};
    }
};

// What the film says with colours and marks, beyond which species a grain is. Plain values in SI units.

// What the colour of a grain stands for.
enum class GrainValue {
    species,
    speed,              // m/s
    vertical_velocity,  // m/s, upwards
    start_height,       // m, above the floor's rest position in the film's first frame; in bands
    displacement,       // m, how far the grain has come in one period of the drive
    rise,               // m, how much higher it is than one period ago
    spin,               // rad/s
    kinetic_energy,     // J, of translation and rotation
    coordination,       // contacts that carry force, walls included
    contact_force,      // N, sum of the normal forces on the grain
};

enum class ColourMap { viridis, cividis, vik, bilbao };  // bilbao: of walls alone

struct GrainColouring {
    GrainValue by = GrainValue::species;
    // These have no meaning when grains are coloured by species.
    ColourMap map = ColourMap::viridis;
    std::array<double, 2> range{0, 1};  // of the quantity, for the whole film
    bool fixed = false;                 // the range is the user's
    std::string unit;                   // of the colour bar; empty for pure numbers
    int layers = 5;                     // bands of start_height
    bool as_field = false;              // a layer of means before pale grains, in place of coloured grains
    bool logarithmic = false;           // equal ratios have equal distances on the bar; the range is positive
    bool of_grains() const { return by != GrainValue::species && !as_field; }
    bool of_field() const { return by != GrainValue::species && as_field; }
    bool operator==(const GrainColouring&) const = default;
};

// What a profile shows: means over the container of the picture's moment.
enum class ProfileOf {
    nothing,
    solid_fraction,       // of each species
    share,                // of each species in the solid volume there
    horizontal_velocity,  // m/s, along y
    vertical_velocity,    // m/s, along z
};

// A plot beside the grains: a column of measures.csv against time, or a profile.
struct FilmPlot {
    std::string column;                          // as in the file: "height_difference", "centre_z_m"
    std::string label;                           // in words, without the unit
    std::optional<std::array<double, 2>> range;  // SI; of a column: grows with the data when empty
    Dimension dimension = Dimension::number;
    ProfileOf profile = ProfileOf::nothing;  // in place of a column
    bool across = false;                     // of a profile: against the place across, else against height
    bool period = false;  // velocities or a column: means over the last period of the drive
    bool is_profile() const { return profile != ProfileOf::nothing; }
    bool of_velocity() const {
        return profile == ProfileOf::horizontal_velocity || profile == ProfileOf::vertical_velocity;
    }
    bool operator==(const FilmPlot&) const = default;
};

// The grains' mean velocity in the y-z plane: an arrow in each cell.
struct FilmArrows {
    int across = 0;      // cells across the container's width; 0: no arrows
    double speed = 0;    // m/s; an arrow of this speed spans one cell
    bool period = true;  // over the last period of the drive, else of this moment
    bool operator==(const FilmArrows&) const = default;
};

// The same velocity as pieces of streamlines.
struct FilmStreamlines {
    int across = 0;      // lines across the container's width; 0: none
    double speed = 0;    // m/s, from which on lines have their full width
    bool period = true;  // as of arrows
    bool operator==(const FilmStreamlines&) const = default;
};

// Arrows of the mean force on each wall since the row of measures before.
struct FilmWallForces {
    bool wanted = false;
    double scale = 0;  // N, of an arrow a quarter as long as the container is wide
    bool operator==(const FilmWallForces&) const = default;
};

// Where grains have come from.
struct FilmTrails {
    std::vector<std::size_t> species;
    std::vector<std::int32_t> grains;  // ids, beside them
    double duration = 0;               // s
    bool wanted() const { return !species.empty() || !grains.empty(); }
    bool operator==(const FilmTrails&) const = default;
};

// Grains of which a quantity lies above or below a limit.
struct GrainCondition {
    GrainValue of = GrainValue::species;  // of no meaning: there is no condition
    bool above = true;
    double limit = 0;  // SI
    std::string text;  // "speed > 20 cm/s", as it was written
    bool wanted() const { return of != GrainValue::species; }
    bool operator==(const GrainCondition&) const = default;
};

struct FilmShows {
    GrainColouring colour;
    std::vector<std::size_t> hidden;        // species that are not drawn
    std::vector<std::size_t> ghosts;        // species that are seen through
    std::vector<std::int32_t> highlighted;  // ids
    GrainCondition highlight_if;            // and those
    std::string text;                       // beside the grains, as it was written
    std::vector<LiveWords> live_words;      // what it says
    std::vector<FilmPlot> plots;
    FilmArrows arrows;
    FilmStreamlines streamlines;
    FilmTrails trails;
    bool force_chains = false;  // lines between grains that touch, as wide as they push
    FilmWallForces wall_forces;
    bool outflow = false;  // how much has flowed out through the outlet
    bool operator==(const FilmShows&) const = default;
};

// Which words and signs stand beside the grains. Film::words says where.
struct WordKinds {
    bool title = true;
    bool legend = true;  // species, colours and marks
    bool time = true;
    bool cycle = true;  // of the drive, and its phase
    bool dial = true;
    bool drive = true;     // f, Gamma and amplitude
    bool playback = true;  // what is said of time
    bool scale = true;     // bar of a length
    bool arrows = true;    // gravity and vibration
    bool counts = true;    // of grains that have flowed out or lie in the tray
    bool captions = true;  // with the headings of panels
    bool operator==(const WordKinds&) const = default;
};

// What the film needs of a frame beyond the grains' state: Frame::displacement, ...
inline bool shows_value(const FilmShows& look, GrainValue value) {
    return look.colour.by == value || look.highlight_if.of == value;
}
inline bool needs_displacement(const FilmShows& look) {
    return shows_value(look, GrainValue::displacement) || shows_value(look, GrainValue::rise) ||
           (look.arrows.across > 0 && look.arrows.period) ||
           (look.streamlines.across > 0 && look.streamlines.period) ||
           std::any_of(look.plots.begin(), look.plots.end(),
                       [](const FilmPlot& plot) { return plot.of_velocity() && plot.period; });
}
// ... Frame::measures, ...
inline bool needs_measures(const FilmShows& look) {
    return look.wall_forces.wanted ||
           std::any_of(look.plots.begin(), look.plots.end(),
                       [](const FilmPlot& plot) { return !plot.is_profile(); }) ||
           std::any_of(look.live_words.begin(), look.live_words.end(),
                       [](const LiveWords& part) { return !part.column.empty(); });
}
// ... Frame::touches.
inline bool needs_touches(const FilmShows& look) {
    return look.force_chains || shows_value(look, GrainValue::coordination) ||
           shows_value(look, GrainValue::contact_force);
}

struct Colour {
    double red = 0, green = 0, blue = 0;  // sRGB, 0 to 1
    bool operator==(const Colour&) const = default;
};

struct FilmSegment {
    enum class Kind { motion, locked };
    Kind kind = Kind::motion;
    std::optional<double>
        duration;         // s simulated; at most one segment has none and takes what the others leave
    double playback = 1;  // motion: simulated seconds a second of film (0.1 = ten times slower)
    int every = 1;        // locked: one frame every 1, 2 or 4 periods ...
    double phase = 0;     // ... at this phase, turns
    // What each picture shows up to its moment; at most one of the two.
    int average = 0;      // whole periods, in which the grains' mean places are drawn; 0: none
    double exposure = 0;  // s, of an open shutter; 0: one moment
    int exposures = 16;   // moments in that time; locked: at most one a period
    bool operator==(const FilmSegment&) const = default;
};

// Words that the film shows for a while.
struct FilmCaption {
    double from = 0, to = 0;  // s of simulated time
    std::string text;
    double hold = 0;  // s of film that the picture stands still at the caption's beginning
    bool operator==(const FilmCaption&) const = default;
};
// Whether it is there at that simulated time, s; a frame that is early by rounding counts as there.
inline bool shows_caption(const FilmCaption& caption, double time) {
    constexpr double rounding = 1e-9;
    return time >= caption.from - rounding && time < caption.to - rounding;
}

// Words beside a grain.
struct FilmLabel {
    int id = 0;
    std::string text;
    bool operator==(const FilmLabel&) const = default;
};

// Where the camera is at one moment of the film; what is left empty follows from the other keys.
struct CameraKey {
    double time = 0;  // s of film
    std::optional<double> azimuth, elevation, zoom;
    std::optional<Vec3> target;
    bool operator==(const CameraKey&) const = default;
};

// What the automatic framing has in the picture: all of the container, the bed at rest, or what the grains
// reach in the course of the film. Of a container higher than that the upper part runs out of the picture.
enum class CameraFrame { container, bed, reach };

struct Camera {
    CameraFrame frame = CameraFrame::reach;
    std::optional<double> reach;  // m above the floor's rest position; estimated, or measured, when empty
    double azimuth = 20;    // degrees, about z: 0 looks along -x at the wide face, positive goes to the right
    double elevation = 10;  // degrees above the horizon
    double field_of_view = 25;         // degrees, vertical; 0 for orthographic
    double zoom = 1;                   // over the automatic framing
    Vec3 up{0, 0, 1};                  // unit; against gravity where that is level. Azimuth is about it
    bool follow = false;               // true: the container's own frame, false: the lab's
    std::optional<Vec3> position;      // m, in place of azimuth, elevation and automatic framing
    std::optional<Vec3> target;        // m, the middle of the picture; the container's when empty
    double orbit = 0;                  // degrees turned about the vertical through the target ...
    std::optional<double> orbit_time;  // s of film in which it does so; all the film when empty
    std::vector<CameraKey> keys;       // by rising time
    bool moves() const { return orbit != 0 || !keys.empty(); }
    // Whether the picture's framing is the user's, not one that has the container whole.
    bool framed_by_user() const;
    bool operator==(const Camera&) const = default;
};

enum class FilmFormat { mp4, webm, av1, gif, ffv1, png, y4m };  // docs/guide/films.md says what each is

// Where the words of a frame are: beside the picture, or over it on plates. automatic: over it with a camera
// that the user frames.
enum class WordPlace { automatic, gutters, plates, none };

struct Film {
    int width = 1920, height = 1080;
    double rate = 30;   // frames a second of film
    std::string title;  // shown on the frame; empty: none is
    std::vector<FilmSegment> segments;
    std::vector<FilmCaption> captions;  // by rising time; none over another
    std::vector<FilmLabel> labels;
    int periods = 0;  // of the drive, that locked frames, displacements and means go by; 0: as the bed does
    Camera camera;
    Colour background{1, 1, 1};
    FilmLook look;
    int quality = 20;  // x264 crf; other codecs take what looks alike
    std::string preset = "veryfast";
    WordPlace words = WordPlace::automatic;
    WordKinds word_kinds;
    bool axes = false;        // x, y and z beside the picture
    bool wall_ghost = false;  // the outline of the container at rest
    double exaggerate = 1;    // of the container's motion, grains and all
    FilmShows shows;
    FilmFormat format = FilmFormat::mp4;
    bool transparent = false;              // no background: alpha in its place
    std::optional<std::int64_t> max_size;  // bytes, of the film's file
    std::array<int, 2> sheet{0, 0};        // columns and rows of the contact sheet; zeros: none
    std::string purpose;                   // whose defaults were taken ("journal"); empty: nobody's
    bool operator==(const Film&) const = default;
};

// The words that scenes use for choices of their film, once for the reader, the writer and the list of keys.

inline const Words<FilmLook::Style> style_words{
    {"studio", FilmLook::Style::studio}, {"flat", FilmLook::Style::flat}, {"dark", FilmLook::Style::dark}};
inline const Words<CameraFrame> camera_frame_words{
    {"container", CameraFrame::container}, {"bed", CameraFrame::bed}, {"reach", CameraFrame::reach}};
inline const Words<WordPlace> word_place_words{{"automatic", WordPlace::automatic},
                                               {"gutters", WordPlace::gutters},
                                               {"plates", WordPlace::plates},
                                               {"none", WordPlace::none}};
inline const Words<FilmFormat> film_format_words{{"mp4", FilmFormat::mp4},   {"webm", FilmFormat::webm},
                                                 {"av1", FilmFormat::av1},   {"gif", FilmFormat::gif},
                                                 {"ffv1", FilmFormat::ffv1}, {"png", FilmFormat::png},
                                                 {"y4m", FilmFormat::y4m}};

// Colours by name, chosen to be told apart by everybody.

// "#rrggbb" or a name of Okabe and Ito's palette (2008, jfly.uni-koeln.de/color), or black, white, grey.
std::optional<Colour> parse_colour(std::string_view text);

// The first of the palette's eight colours, from orange on, that is taken least often: not at all while one
// is free.
Colour default_colour(const std::vector<Colour>& taken);

// "#rrggbb".
std::string colour_text(const Colour& colour);

// The background of a film's pictures, where the scene names none.
Colour default_background(FilmLook::Style style);

}  // namespace grainreel
