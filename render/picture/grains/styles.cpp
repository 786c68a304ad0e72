#include "render/picture/grains/styles.hpp"

namespace grainreel {

Lamp lamp_of(const FilmLook& look, bool colours_are_read) {
    Lamp lamp;
    if (look.style == FilmLook::Style::flat) {  // a hint of form, and outlines that survive a photocopier
        lamp.key = 0.22f;
        lamp.sky = 0.80f;
        lamp.ground = 0.72f;
        lamp.rim = 0.12f;
        lamp.rim_width = 0.42f;
        lamp.shine = 0;
        lamp.cap = 0.90f;
    } else if (look.style == FilmLook::Style::dark) {  // a harder key, less fill
        lamp.key = 0.90f;
        lamp.sky = 0.50f;
        lamp.ground = 0.20f;
        lamp.rim = 0.85f;
        lamp.shine = 0.20f;
    }
    if (colours_are_read && look.style != FilmLook::Style::flat) {  // half as far from the map's colours
        lamp.key = 0.45f;
        lamp.sky = 0.50f;
        lamp.ground = 0.35f;
        lamp.even = 0.32f;
        lamp.shine = 0.05f;
    }
    lamp.occlusion = look.occlusion;
    lamp.shadows = look.shadows;
    return lamp;
}

}  // namespace grainreel
