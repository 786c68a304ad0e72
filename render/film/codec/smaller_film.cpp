#include "render/film/codec/smaller_film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainreel {
namespace {

constexpr double in_hand = 0.9, bytes_by_pixels = 0.7;
constexpr int least_height = 240;  // below, words are smaller than they can be read
constexpr std::int64_t least_frames = 10;

int even_below(double pixels) {
    return 2 * static_cast<int>(pixels / 2);
}

}  // namespace

std::string smaller_film(int width, int height, std::int64_t frames, double share) {
    const double scale = std::min(1.0, std::pow(in_hand * share, 0.5 / bytes_by_pixels));
    const int lines = even_below(scale * height), columns = even_below(scale * width);
    const auto fewer = static_cast<std::int64_t>(in_hand * share * static_cast<double>(frames));
    std::string text;
    if (lines >= least_height) text = fmt::format("--size {}x{}", columns, lines);
    if (fewer >= least_frames)
        text += fmt::format(
            "{}{} of its {} frames (a shorter --duration, a lower --fps, or segments that show "
            "less)",
            text.empty() ? "" : ", or ", fewer, frames);
    return text.empty() ? "no smaller picture and no shorter film that shows anything" : text;
}

}  // namespace grainreel
