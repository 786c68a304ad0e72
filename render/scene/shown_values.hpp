// The quantities that can colour grains: their words, dimensions and units.
#pragma once

#include <array>
#include <string>

#include "engine/scene/chapters/words.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

inline const Words<GrainValue> grain_value_words{{"species", GrainValue::species},
                                                 {"speed", GrainValue::speed},
                                                 {"vertical-velocity", GrainValue::vertical_velocity},
                                                 {"start-height", GrainValue::start_height},
                                                 {"displacement", GrainValue::displacement},
                                                 {"rise", GrainValue::rise},
                                                 {"spin", GrainValue::spin},
                                                 {"kinetic-energy", GrainValue::kinetic_energy},
                                                 {"coordination", GrainValue::coordination},
                                                 {"contact-force", GrainValue::contact_force}};
inline const Words<ColourMap> colour_map_words{
    {"viridis", ColourMap::viridis}, {"cividis", ColourMap::cividis}, {"vik", ColourMap::vik}};

inline Dimension dimension_of(GrainValue value) {
    switch (value) {
        case GrainValue::speed:
        case GrainValue::vertical_velocity:
            return Dimension::speed;
        case GrainValue::start_height:
        case GrainValue::displacement:
        case GrainValue::rise:
            return Dimension::length;
        case GrainValue::spin:
            return Dimension::spin;
        case GrainValue::kinetic_energy:
            return Dimension::energy;
        case GrainValue::contact_force:
            return Dimension::force;
        case GrainValue::species:
        case GrainValue::coordination:
            break;
    }
    return Dimension::number;
}

// Has two signs: wants a diverging map and a range that is even on both sides.
inline bool is_signed(GrainValue value) {
    return value == GrainValue::vertical_velocity || value == GrainValue::rise;
}

// Low and high of the colours when the scene does not say: of the whole film, from the scene alone, so that a
// colour means the same in every frame, while the run goes on and when it is drawn again. Estimated such that
// 99 of 100 grains lie between in the course of the film. {0, 0} when the scene gives no scale.
std::array<double, 2> usual_range(GrainValue value, const Scene& scene);
// N of a contact whose line is as wide as lines of force get.
double widest_chain_force(const Scene& scene);
// m/s, of a fast circulation: a grain's diameter in five periods. Of velocities of a moment: the drive's
// speed, or that of a fall from the outlet's half-width if it is larger. 0 when the scene gives no scale.
double usual_flow_speed(const Scene& scene, bool period);
// The values' axis of a profile that has no range of its own.
std::array<double, 2> usual_profile_range(const Scene& scene, const FilmPlot& plot);

// The quantities that can colour meshes: their words, units and usual ranges.

inline const Words<FilmWalls::Colour> wall_colour_words{{"plain", FilmWalls::Colour::plain},
                                                        {"pressure", FilmWalls::Colour::pressure},
                                                        {"wear", FilmWalls::Colour::wear}};

inline Dimension dimension_of(FilmWalls::Colour colour) {
    return colour == FilmWalls::Colour::wear ? Dimension::stiffness : Dimension::pressure;  // J/m2 is N/m
}

// Low and high of the colours when the scene does not say, Pa or J/m2: of the whole film, from the scene
// alone, so that a colour means the same in every frame, while the run goes on and when it is drawn again.
// Three powers of ten, around the pressure that the bed's weight makes, or the work of rubbing under it at
// the speed of the fastest mesh. {0, 0} when the scene gives no scale.
std::array<double, 2> usual_range(FilmWalls::Colour colour, const Scene& scene);

// What the colour bar counts in.
struct WallUnit {
    std::string name;  // "kPa"
    double size = 1;   // SI
};
WallUnit unit_of(const FilmWalls& walls);

}  // namespace grainreel
