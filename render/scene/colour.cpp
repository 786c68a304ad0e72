#include "render/scene/colour.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace grainreel {

namespace {

struct Named {
    std::string_view name;
    unsigned rgb;
};

// The first names are Okabe and Ito's palette. Species without a colour of their own take them in this order.
constexpr std::size_t palette_size = 8;
constexpr std::array<Named, 10> named_colours{{
    {"orange", 0xe69f00},
    {"sky-blue", 0x56b4e9},
    {"green", 0x009e73},
    {"yellow", 0xf0e442},
    {"blue", 0x0072b2},
    {"vermilion", 0xd55e00},
    {"purple", 0xcc79a7},
    {"black", 0x000000},
    {"white", 0xffffff},
    {"grey", 0x999999},
}};

Colour from_rgb(unsigned rgb) {
    return {((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0, (rgb & 255) / 255.0};
}

}  // namespace

std::optional<Colour> parse_colour(std::string_view text) {
    for (const Named& named : named_colours)
        if (named.name == text) return from_rgb(named.rgb);
    unsigned rgb = 0;
    if (text.size() != 7 || text.front() != '#') return std::nullopt;
    const auto [end, failure] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
    if (failure != std::errc() || end != text.data() + 7) return std::nullopt;
    return from_rgb(rgb);
}

Colour default_colour(const std::vector<Colour>& taken) {
    const auto uses = [&](const Named& named) {
        return std::count(taken.begin(), taken.end(), from_rgb(named.rgb));
    };
    const auto end = named_colours.begin() + palette_size;
    return from_rgb(std::min_element(named_colours.begin(), end, [&](const Named& a, const Named& b) {
                        return uses(a) < uses(b);
                    })->rgb);
}

std::string colour_text(const Colour& colour) {
    const auto byte = [](double share) { return static_cast<int>(std::lround(share * 255)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.red), byte(colour.green), byte(colour.blue));
}

}  // namespace grainreel
