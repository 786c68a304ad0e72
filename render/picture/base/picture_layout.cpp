#include "render/picture/base/picture_layout.hpp"

#include <algorithm>

namespace grainreel {

// By the height, but in very narrow pictures by the width.
TypeScale type_scale(const Film& film, double shrink) {
    const double height = film.height, width = film.width;
    TypeScale type{};
    type.main = std::max(10.0, shrink * std::min(0.0265 * height, 0.05 * width));
    type.minor = std::max(10.0, shrink * std::min(0.0195 * height, 0.037 * width));
    type.title = std::max(11.0, shrink * std::min((width < height ? 0.029 : 0.034) * height, 0.055 * width));
    type.gap = 0.6 * type.main;
    type.margin = std::max(4.0, 0.03 * std::min(width, height));
    return type;
}

PictureLayout bare_layout(const Film& film) {
    PictureLayout layout;
    layout.type = type_scale(film);
    layout.port = {0, 0, film.width, film.height};
    return layout;
}

}  // namespace grainreel
