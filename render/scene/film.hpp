// The film that a scene file asks for: plain values in SI units, with defaults filled in, and colours by
// name. A new key is a member here and an entry in keys/. Nearly all of render includes this header: keep it
// light.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/colour.hpp"
#include "render/scene/live_text.hpp"
#include "render/scene/wording.hpp"

namespace grainreel {

// A plane that opens the bed. Grains on the side that its normal points to are taken away, and grains that it
// crosses show a flat face. It moves with a floor that shakes, but not with one that turns.
struct FilmCut {
    bool present = false;
    Vec3 normal{1, 0, 0};  // unit, towards the part that is taken away
    double at = 0;         // m: distance of the plane from the origin, along the normal
    double thickness = 0;  // m: thickness of the slab that is kept; 0: all behind the plane is kept
    bool operator==(const FilmCut&) const = default;
};

// How meshes are drawn.
struct FilmWalls {
    // plain: walls have their usual look. Otherwise colours show what the grains do to each triangle: how
    // hard they press on it, or how much they wear it.
    enum class Colour { plain, pressure, wear };
    Colour colour = Colour::plain;
    // Pa or J/m2: the range of the colours for the whole film. It has no meaning where walls are plain.
    std::array<double, 2> range{0, 0};
    bool fixed = false;              // the range is the user's
    double edge_angle = 30;          // degrees; edges whose faces turn more are drawn
    std::vector<std::string> solid;  // names of meshes that are solid from all sides
    std::vector<std::string> glass;  // names of meshes that are glass from outside
    bool clear = false;              // all walls, those of the container too, are glass from both sides
    bool coloured() const { return colour != Colour::plain; }
    // Whether equal ratios of values have equal distances on the colour bar. Where the range begins at 0,
    // equal differences have equal distances instead.
    bool logarithmic() const { return range[0] > 0; }
    bool operator==(const FilmWalls&) const = default;
};

// How the pictures of the film are lit, and where the bed is opened.
struct FilmLook {
    enum class Style { studio, flat, dark };
    Style style = Style::studio;
    bool occlusion = true;  // darkness between grains
    bool shadows = true;    // grains throw shadows on grains
    bool ground = true;     // a ground that the container throws its shadow on
    bool rotation = false;  // two-tone grains show how they turn; needs orientations
    FilmCut cut;
    FilmWalls walls;
    bool operator==(const FilmLook&) const = default;

    // The look of a style where the scene says nothing else.
    static FilmLook of(Style style) {
        const bool lit = style != Style::flat;
        return {style, lit, lit, lit, false, {}, {}};
    }
};

// What the colour of a grain stands for.
enum class GrainValue {
    species,
    speed,              // m/s
    vertical_velocity,  // m/s, upwards
    start_height,       // m above the floor, in the film's first frame; in bands
    displacement,       // m, how far the grain has come in one period of the drive
    rise,               // m, how much higher it is than one period ago
    spin,               // rad/s
    kinetic_energy,     // J, of translation and rotation
    coordination,       // contacts that carry force, walls included
    contact_force,      // N, sum of the normal forces on the grain
    own,                // the user's own values (Shot::own); no scene can name them
};

enum class ColourMap { viridis, cividis, vik, bilbao };  // bilbao: only for walls

struct GrainColouring {
    GrainValue by = GrainValue::species;
    // The following have no meaning when grains are coloured by species.
    ColourMap map = ColourMap::viridis;
    std::array<double, 2> range{0, 1};   // SI: range of the quantity for the whole film
    bool fixed = false;                  // the range is the user's
    std::string unit;                    // unit on the colour bar; empty for pure numbers
    int layers = 5;                      // bands of start_height
    bool as_field = false;               // shows means as a layer in front of pale grains
    std::vector<std::size_t> species{};  // the species that are coloured by it; empty: all
    bool logarithmic = false;  // equal ratios have equal distances on the bar; the range is positive
    std::string title{};       // words above the colour bar, of own values only
    bool of_grains() const { return by != GrainValue::species && !as_field; }
    // Whether the colours of this species' grains stand for a quantity.
    bool colours(std::size_t one) const {
        return of_grains() &&
               (species.empty() || std::find(species.begin(), species.end(), one) != species.end());
    }
    bool of_field() const { return by != GrainValue::species && as_field; }
    bool operator==(const GrainColouring&) const = default;
};

// What a profile shows: means over the container at the picture's moment.
enum class ProfileOf {
    nothing,
    solid_fraction,       // solid fraction of each species
    share,                // share of each species in the solid volume there
    horizontal_velocity,  // m/s, along y
    vertical_velocity,    // m/s, along z
};

// A plot beside the grains: a column of measures.csv against time, or a profile.
struct FilmPlot {
    std::string column;  // its name in the file: "height_difference", "centre_z_m"
    std::string label;   // the quantity in words, without the unit
    // SI. If it is empty, the range of a column grows with the data.
    std::optional<std::array<double, 2>> range;
    Dimension dimension = Dimension::number;
    ProfileOf profile = ProfileOf::nothing;  // the profile shown in place of a column
    bool across = false;                     // a profile runs over the width, else over the height
    // Velocities are means over the last period of the drive. So is the line of a column, and its rows are a
    // faint line behind it.
    bool period = false;
    double window = 0;       // s: a plot of a column shows the last so long; 0: the whole run
    bool own_label = false;  // the label is the scene's own, and not the column's
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

// The grains' mean velocity in the y-z plane: pieces of streamlines.
struct FilmStreamlines {
    int across = 0;      // lines across the container's width; 0: none
    double speed = 0;    // m/s: lines have their full width from this speed on
    bool period = true;  // over the last period of the drive, else of this moment
    bool operator==(const FilmStreamlines&) const = default;
};

// Arrows of the mean force on each wall, over the time since the row of measures before.
struct FilmWallForces {
    bool wanted = false;
    double scale = 0;  // N: an arrow of this force is a quarter as long as the container is wide
    bool operator==(const FilmWallForces&) const = default;
};

// The paths that grains have come.
struct FilmTrails {
    std::vector<std::size_t> species;
    std::vector<std::int32_t> grains;  // ids of more grains
    double duration = 0;               // s, the time that they show
    bool wanted() const { return !species.empty() || !grains.empty(); }
    bool operator==(const FilmTrails&) const = default;
};

// A condition for grains: a quantity lies above or below a limit.
struct GrainCondition {
    GrainValue of = GrainValue::species;  // species: there is no condition
    bool above = true;
    double limit = 0;  // SI
    std::string text;  // "speed > 20 cm/s", as it was written
    bool wanted() const { return of != GrainValue::species; }
    bool operator==(const GrainCondition&) const = default;
};

// What the film shows by colours, marks, plots and words, besides the species of the grains.
struct FilmShows {
    GrainColouring colour;
    std::vector<std::size_t> hidden;        // species that are not drawn
    std::vector<std::size_t> ghosts;        // species that are seen through
    std::vector<std::int32_t> highlighted;  // ids of grains with a ring
    GrainCondition highlight_if;            // grains that meet it have a ring, too
    std::string text;                       // words beside the grains, as they were written
    std::vector<LiveWords> live_words;      // the parts of that text
    std::vector<FilmPlot> plots;
    FilmArrows arrows;
    FilmStreamlines streamlines;
    FilmTrails trails;
    bool force_chains = false;  // lines between grains that touch, wider for larger forces
    FilmWallForces wall_forces;
    bool outflow = false;  // how much has flowed out through the outlet
    bool operator==(const FilmShows&) const = default;
};

// Which words and signs stand beside the grains. Film::words says where. By default there are three signs:
// the time with its pace, what shakes, and the scale.
struct WordKinds {
    bool title = true;
    bool legend = true;  // species, colours and marks
    bool time = true;
    bool playback = true;  // how fast the film plays
    bool shaking = true;   // what shakes and which way, its frequency and Gamma
    bool scale = true;     // bar of a length
    bool cycle = false;    // number of the drive's cycle, and its phase
    bool dial = false;
    bool drive = false;    // f, Gamma and amplitude
    bool arrows = false;   // gravity, vibration, and the scale beside the floor
    bool counts = true;    // numbers of grains that have flowed out or lie in the tray
    bool captions = true;  // captions, and the headings of panels
    bool operator==(const WordKinds&) const = default;
};

// The functions needs_*() tell which parts of a frame the film needs besides the state of the grains:
// Shot::displacement, Shot::measures, Shot::touches.
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
inline bool needs_measures(const FilmShows& look) {
    return look.wall_forces.wanted ||
           std::any_of(look.plots.begin(), look.plots.end(),
                       [](const FilmPlot& plot) { return !plot.is_profile(); }) ||
           has_values(look.live_words);
}
inline bool needs_touches(const FilmShows& look) {
    return look.force_chains || shows_value(look, GrainValue::coordination) ||
           shows_value(look, GrainValue::contact_force);
}

// A stretch of simulated time and how the film shows it.
struct FilmSegment {
    enum class Kind { motion, locked };
    Kind kind = Kind::motion;
    // s of simulated time. At most one segment has no duration; it takes what the others leave.
    std::optional<double> duration;
    double playback = 1;  // motion: simulated seconds for each second of film (0.1 = ten times slower)
    int every = 1;        // locked: one frame every 1, 2 or 4 periods
    double phase = 0;     // locked: turns, the phase of these frames
    // locked: number of pictures between two of these frames, with the grains on the straight way.
    int between = 0;
    // A picture may show what happened up to its moment: by `average` or by `exposure`, but not by both.
    int average = 0;      // number of periods over which mean places of grains are drawn; 0: none
    double exposure = 0;  // s for which the shutter is open; 0: one moment
    int exposures = 16;   // moments in that time; locked: at most one a period
    bool operator==(const FilmSegment&) const = default;
};

// Words that the film shows for a while.
struct FilmCaption {
    double from = 0, to = 0;  // s of simulated time
    std::string text;
    double hold = 0;                 // s of film for which the picture stands still when the caption appears
    std::vector<LiveWords> words{};  // the parts of the text; empty: it is shown as it is
    bool operator==(const FilmCaption&) const = default;
};
// Whether a caption is shown at a simulated time, s. A frame that is early by rounding shows it.
inline bool shows_caption(const FilmCaption& caption, double time) {
    constexpr double rounding = 1e-9;
    return time >= caption.from - rounding && time < caption.to - rounding;
}

inline bool has_values(const std::vector<FilmCaption>& captions) {
    return std::any_of(captions.begin(), captions.end(),
                       [](const FilmCaption& caption) { return has_values(caption.words); });
}

// Words beside a grain.
struct FilmLabel {
    int id = 0;
    std::string text;
    bool operator==(const FilmLabel&) const = default;
};

// Where the camera is at one moment of the film. A member that is empty follows from the keys before and
// after that have it.
struct CameraKey {
    double time = 0;  // s of film
    std::optional<double> azimuth, elevation, zoom;
    std::optional<Vec3> target;
    bool operator==(const CameraKey&) const = default;
};

// How much the automatic framing shows: all of the container, the bed at rest, or as high as the grains get
// in the course of the film. The part of the container above that is cut off.
enum class FramingScope { container, bed, reach };

struct Camera {
    FramingScope frame = FramingScope::reach;
    std::optional<double> reach;  // m above the floor's rest position; when empty it is estimated or measured
    double azimuth = 20;    // degrees about `up`: 0 looks along -x at the wide face, positive is to the right
    double elevation = 10;  // degrees above the horizon
    double field_of_view = 25;         // degrees, vertical; 0 for orthographic
    double zoom = 1;                   // magnifies the automatic framing
    Vec3 up{0, 0, 1};                  // unit; z, or against gravity if gravity is horizontal
    bool follow = false;               // stands in the container's own frame, else in the lab
    std::optional<Vec3> position;      // m, in place of azimuth, elevation and automatic framing
    std::optional<Vec3> target;        // m, the middle of the picture; when empty the middle of the container
    double orbit = 0;                  // degrees that the camera turns about the vertical through the target
    std::optional<double> orbit_time;  // s of film that the orbit takes; the whole film when empty
    std::vector<CameraKey> keys;       // by rising time
    bool moves() const { return orbit != 0 || !keys.empty(); }
    // Whether the user frames the picture, which then may not show the whole container.
    bool framed_by_user() const;
    bool operator==(const Camera&) const = default;
};

enum class FilmFormat { mp4, webm, av1, gif, ffv1, png, y4m };  // docs/guide/films.md says what each is

// Where words stand: in gutters beside the picture, or on plates over it. automatic: on plates where the user
// frames the picture, else in gutters.
enum class WordPlace { automatic, gutters, plates, none };

// Where the two gutters of words lie. A gutter as wide as the picture has its words in rows, another has a
// column. The first says what is seen, the second what changes with time.
enum class GutterPlace {
    sides,            // columns left and right
    row_above,        // both beside each other in one row above
    row_below,        // the same below
    column,           // one column at the left, with the words of both gutters below each other
    above_and_below,  // rows above and below
    below,            // both below
    above_and_side,   // the first above, the second at the right
    below_and_side,   // the first below, the second at the right
    side_and_below,   // the first at the left, the second below
};

// Gutters as the user wants them, so that several films look alike.
struct FilmGutters {
    bool wanted = false;  // else they are chosen by the room that words and container need
    GutterPlace place = GutterPlace::sides;
    double letters = 1;  // over their usual size
    // Least sizes: widths of columns as shares of the picture's width, heights of rows as shares of its
    // height. Of one row `first` is the height, and `second` the width of the second gutter.
    double first = 0, second = 0;
    bool operator==(const FilmGutters&) const = default;
};

struct Film {
    int width = 1920, height = 1080;
    double rate = 30;   // frames a second of film
    std::string title;  // shown on the frame; empty: no title
    std::vector<FilmSegment> segments;
    std::vector<FilmCaption> captions;  // by rising time; they do not overlap
    std::vector<FilmLabel> labels;
    // Periods of the drive by which locked frames, displacements and means count; 0: as many as the bed takes
    // to repeat itself.
    int periods = 0;
    Camera camera;
    Colour background{1, 1, 1};
    FilmLook look;
    int quality = 20;  // crf of x264; other codecs take a value that looks alike
    std::string preset = "veryfast";
    WordPlace words = WordPlace::automatic;
    FilmGutters gutters;
    WordKinds word_kinds;
    Wording wording;          // language and own words
    bool axes = false;        // arrows along x, y and z beside the picture
    bool wall_ghost = false;  // the outline of the container at rest
    double exaggerate = 1;    // the motion of the container and its grains is drawn so many times as large
    FilmShows shows;
    FilmFormat format = FilmFormat::mp4;
    bool transparent = false;              // alpha in place of a background
    std::optional<std::int64_t> max_size;  // bytes, of the film's file
    std::array<int, 2> sheet{0, 0};        // columns and rows of the contact sheet; zeros: none
    std::string purpose;                   // the purpose whose defaults were taken ("journal"); empty: none
    bool operator==(const Film&) const = default;
};

// See needs_measures(const FilmShows&); captions too may show values.
inline bool needs_measures(const Film& film) {
    return needs_measures(film.shows) || has_values(film.captions);
}

// The background of pictures where the scene names none.
Colour default_background(FilmLook::Style style);

}  // namespace grainreel
