// Round ticks and the upright axis of plots.
#include "render/picture/plots/axes.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace grainreel {

namespace {

// The smallest 1, 2 or 5 times a power of ten that is not below `least`.
double round_step(double least) {
    const double decade = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * decade >= least * (1 - 1e-9)) return factor * decade;
    return 10 * decade;
}

constexpr double hair = 1e-9;  // tolerance for rounding errors, as a share of a step between ticks

}  // namespace

std::vector<double> round_ticks(double low, double high, int most) {
    double step = round_step((high - low) / most);
    while (std::floor(high / step + hair) - std::ceil(low / step - hair) + 1 > most)
        step = round_step(1.5 * step);
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - hair); k <= high / step + hair; ++k) ticks.push_back(k * step);
    return ticks;
}

AxisTicks axis_ticks(double low, double high, int most, int finest) {
    for (int many = most; many <= std::max(most, finest); ++many) {
        const std::vector<double> ticks = round_ticks(low, high, many);
        if (ticks.size() < 2) continue;
        if (many == most) return {ticks, ticks[1] - ticks[0]};
        return {{ticks.front(), ticks.back()}, ticks[1] - ticks[0]};
    }
    return {round_ticks(low, high, most), high - low};
}

std::vector<double> power_ticks(double low, double high, int most) {
    const int first = static_cast<int>(std::ceil(std::log10(low) - hair)),
              last = static_cast<int>(std::floor(std::log10(high) + hair));
    std::vector<double> ticks;
    if (last - first < 1) {
        for (int power = first - 1; power <= last; ++power)
            for (const double factor : {1.0, 2.0, 5.0})
                if (const double at = factor * std::pow(10, power);
                    at >= low * (1 - hair) && at <= high * (1 + hair))
                    ticks.push_back(at);
        return ticks;
    }
    const int step = (last - first) / most + 1;
    for (int power = last - (last - first) / step * step; power <= last; power += step)
        ticks.push_back(std::pow(10, power));
    return ticks;
}

std::array<double, 2> round_limits(double low, double high, int most) {
    const double least = std::max({high - low, 1e-6 * std::max(std::abs(low), std::abs(high)), 1e-30});
    double step = round_step(least / (most - 1));
    const auto floor_of = [&] { return std::floor(low / step + hair); };
    const auto ceiling_of = [&] { return std::ceil(high / step - hair); };
    while (ceiling_of() - floor_of() + 1 > most) step = round_step(1.5 * step);
    const double from = floor_of(), to = std::max(ceiling_of(), from + 1);
    return {from * step, to * step};
}

std::string tick_text(double value, double distance) {
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(distance) - hair)), 0, 9);
    const double shown = std::abs(value) < 1e-6 * distance ? 0 : value;
    return (shown < 0 ? "−" : "") + fmt::format("{:.{}f}", std::abs(shown), decimals);
}

AxisTicks upright_ticks(const PlotBox& box, const TypeScale& type, double low, double high) {
    const int fit =
        std::clamp(static_cast<int>((box.bottom - box.top) / (1.6 * type.minor)), 2, most_axis_ticks);
    return axis_ticks(low, high, fit, most_axis_ticks + 1);
}

void draw_upright_axis(cairo_t* on, const PlotBox& box, const AxisTicks& ticks,
                       const std::function<double(double tick)>& height_of, const TypeScale& type,
                       const Palette& palette) {
    const TextStyle minor{type.minor, false};
    const double pen = std::max(1.0, type.main / 20), tick = 0.3 * type.minor;
    for (const double value : ticks.at) {
        const double y = height_of(value);
        cairo_set_line_width(on, 0.7 * pen);
        set_colour(on, palette.ink, 0.15);
        draw_line(on, box.left, y, box.right, y);
        const std::string text = tick_text(value, ticks.distance);
        const TextSize words = measure_text(text, minor);
        draw_text(on, box.left - tick - words.width, y - 0.5 * words.height, text, minor, palette.faint_ink);
    }
    set_colour(on, palette.faint_ink);
    cairo_set_line_width(on, pen);
    draw_line(on, box.left, box.top, box.left, box.bottom);
}

}  // namespace grainreel
