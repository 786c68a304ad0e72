#include "render/picture/base/picture.hpp"

#include <algorithm>

namespace grainreel {

void copy_part(const Picture& from, const Rectangle& part, Picture& to) {
    for (int y = part.y; y < part.y + part.height; ++y)
        std::copy_n(from.pixel(part.x, y), 4 * part.width, to.pixel(part.x, y));
}

void divide_by_alpha(Picture& picture, const Rectangle& port) {
    for (int y = 0; y < port.height; ++y) {
        std::uint8_t* pixel = picture.pixel(port.x, port.y + y);
        for (int x = 0; x < port.width; ++x, pixel += 4) {
            const unsigned alpha = pixel[3];
            if (alpha == 0 || alpha == 255) continue;
            for (int c = 0; c < 3; ++c)
                pixel[c] = static_cast<std::uint8_t>(std::min(255u, (pixel[c] * 255 + alpha / 2) / alpha));
        }
    }
}

double least_letters(const Film& film) {
    constexpr double digits = 0.729;  // height of a digit of DejaVu Sans, as a share of its letters' size
    constexpr double smallest = 10, legible = 11 / digits, whole_size = 480;
    return std::clamp(legible * std::min(film.width, film.height) / whole_size, smallest, legible);
}

// Sizes go by the picture's height, but in very narrow pictures by its width.
TypeScale type_scale(const Film& film, double shrink) {
    const double height = film.height, width = film.width, least = least_letters(film);
    TypeScale type{};
    type.minor = std::max(least, shrink * std::min(0.0225 * height, 0.04 * width));
    type.main = std::max(1.06 * least, shrink * std::min(0.028 * height, 0.05 * width));
    type.title =
        std::max(1.18 * least, shrink * std::min((width < height ? 0.03 : 0.036) * height, 0.055 * width));
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
