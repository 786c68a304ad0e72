// What the film says with colours and marks, beyond which species a grain is. Plain values in SI units.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/scene/live_text.hpp"

namespace grainreel {

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

}  // namespace grainreel
