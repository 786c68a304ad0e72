#include "render/scene/film.hpp"

#include <algorithm>

namespace grainreel {

bool Camera::framed_by_user() const {
    return position || target || zoom != 1 ||
           std::any_of(keys.begin(), keys.end(), [](const CameraKey& key) { return key.zoom || key.target; });
}

Colour default_background(FilmLook::Style style) {
    if (style == FilmLook::Style::dark) return {18 / 255.0, 21 / 255.0, 27 / 255.0};
    return {1, 1, 1};
}

}  // namespace grainreel
