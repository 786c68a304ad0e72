// The quantities of grains and walls that pictures show, with their words, units and usual ranges. Also the
// words that scenes use for other choices of their film.
#pragma once

#include <array>
#include <string>

#include "engine/scene/chapters/words.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

inline const ChoiceWords<FilmLook::Style> style_words{
    {"studio", FilmLook::Style::studio}, {"flat", FilmLook::Style::flat}, {"dark", FilmLook::Style::dark}};
inline const ChoiceWords<FramingScope> camera_frame_words{
    {"container", FramingScope::container}, {"bed", FramingScope::bed}, {"reach", FramingScope::reach}};
inline const ChoiceWords<WordPlace> word_place_words{{"automatic", WordPlace::automatic},
                                                     {"gutters", WordPlace::gutters},
                                                     {"plates", WordPlace::plates},
                                                     {"none", WordPlace::none}};
inline const ChoiceWords<FilmFormat> film_format_words{{"mp4", FilmFormat::mp4},   {"webm", FilmFormat::webm},
                                                       {"av1", FilmFormat::av1},   {"gif", FilmFormat::gif},
                                                       {"ffv1", FilmFormat::ffv1}, {"png", FilmFormat::png},
                                                       {"y4m", FilmFormat::y4m}};

// "species" must stay first: the reader of film.highlight_if skips it.
inline const ChoiceWords<GrainValue> grain_value_words{{"species", GrainValue::species},
                                                       {"speed", GrainValue::speed},
                                                       {"vertical-velocity", GrainValue::vertical_velocity},
                                                       {"start-height", GrainValue::start_height},
                                                       {"displacement", GrainValue::displacement},
                                                       {"rise", GrainValue::rise},
                                                       {"spin", GrainValue::spin},
                                                       {"kinetic-energy", GrainValue::kinetic_energy},
                                                       {"coordination", GrainValue::coordination},
                                                       {"contact-force", GrainValue::contact_force}};
inline const ChoiceWords<ColourMap> colour_map_words{
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
        case GrainValue::own:
            break;
    }
    return Dimension::number;
}

// Whether values have both signs, so that they need a diverging colour map and a range symmetric about 0.
inline bool is_signed(GrainValue value) {
    return value == GrainValue::vertical_velocity || value == GrainValue::rise;
}

// The range of colours where the scene gives none. It is the same for the whole film and follows from the
// scene alone, so that a colour means the same in every frame, both during the run and when it is drawn
// again. 99 of 100 grains are estimated to lie in it in the course of the film. {0, 0} if nothing in the
// scene sets a scale.
std::array<double, 2> usual_range(GrainValue value, const Scene& scene);
// N: from this force on, the line of a contact has its full width.
double widest_chain_force(const Scene& scene);
// m/s: the usual speed of the mean flow. Over a period, it is the speed of a fast circulation: a grain's
// diameter in five periods. At a moment, it is the speed of the drive, or the speed of a fall from the
// outlet's half-width if that is larger. 0 when the scene gives no scale.
double usual_flow_speed(const Scene& scene, bool period);
// The range of the values' axis of a profile that has no range of its own.
std::array<double, 2> usual_profile_range(const Scene& scene, const FilmPlot& plot);

inline const ChoiceWords<FilmWalls::Colour> wall_colour_words{{"plain", FilmWalls::Colour::plain},
                                                              {"pressure", FilmWalls::Colour::pressure},
                                                              {"wear", FilmWalls::Colour::wear}};

inline Dimension dimension_of(FilmWalls::Colour colour) {
    return colour == FilmWalls::Colour::wear ? Dimension::stiffness : Dimension::pressure;  // J/m2 is N/m
}

// Pa or J/m2: the range of the walls' colours where the scene gives none, from the scene alone. It spans
// three powers of ten: around the pressure under the bed's weight, or below the work of rubbing under that
// pressure at the speed of the fastest mesh. {0, 0} if nothing in the scene sets a scale.
std::array<double, 2> usual_range(FilmWalls::Colour colour, const Scene& scene);

// The unit of the walls' colour bar.
struct WallUnit {
    std::string name;  // "kPa"
    double size = 1;   // SI
};
WallUnit unit_of(const FilmWalls& walls);

}  // namespace grainreel
