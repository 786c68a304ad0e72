// The quantities that can colour meshes: their words, units and usual ranges.
#pragma once

#include <array>
#include <string>

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/film.hpp"

namespace grainreel {

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
