#include "render/draw/numbers_plan.hpp"

#include <algorithm>
#include <cmath>

#include "render/draw/captions.hpp"
#include "render/draw/layout.hpp"

namespace grainreel {
namespace {

constexpr double most_plot = 0.25, least_plot = 0.16, least_row = 0.13;  // heights over that of the picture
constexpr double least_lines = 5;   // of a plot, in heights of minor letters
constexpr double plot_width = 0.2;  // in a gutter at the side, over the picture's width

Rectangle whole(double x, double y, double width, double height) {
    return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(width), static_cast<int>(height)};
}

double note_height(const Writer& measure, const Scene& scene, double inner) {
    if (scene.film.shows.text.empty()) return 0;
    return note_block(measure, longest_note(scene), 0, 0, inner).height + measure.type.gap;
}

// Clock, dial, drive and caption below each other, plots at the lower end.
void plan_column(const Writer& measure, const Scene& scene, double height, NumbersPlan& plan) {
    const TypeScale& type = measure.type;
    double y = plan.clock_end;
    if (scene.drive.present) {
        plan.dial = y + 0.6 * type.gap;
        const TextSize disc =
            plan.has_dial ? dial_block(measure, scene.drive, nullptr, plan.radius, 0, 0) : TextSize{};
        plan.drive = plan.dial + (plan.has_dial ? disc.height + 0.6 * type.gap : 0);
        plan.dial_end = plan.drive;
        plan.drive_x = plan.x;
        const TextSize drive = drive_block(measure, scene, 0, 0);
        y = plan.drive + drive.height + type.gap;
        plan.width = std::max({plan.width, disc.width, drive.width});
    }
    plan.caption = y;
    const double line = measure.write(0, 0, "0", measure.minor(), {}).height;
    const double note = note_height(measure, scene, plan.inner);
    plan.caption_lines = std::clamp(static_cast<int>((height - type.margin - y - note) / line), 1, 4);
    plan.caption_end = plan.note = y + plan.caption_lines * line;
    plan.note_end = plan.note + note;
    plan.height = plan.note_end;
    plan.fits = plan.width <= plan.inner && plan.height <= height - 0.5 * type.margin;
    const double free = height - type.margin - plan.note_end;
    const double least = std::max(least_plot * scene.film.height, least_lines * type.minor) + type.gap;
    const double count =
        std::min(static_cast<double>(scene.film.shows.plots.size()), std::floor(free / least));
    if (count < 1) return;
    plan.width = std::max(plan.width, plot_width * scene.film.width);
    const double room = free / count - type.gap;
    const double each = std::clamp(room, least_plot * scene.film.height, most_plot * scene.film.height);
    for (double k = 0; k < count; ++k)
        plan.plots.push_back(whole(plan.x, height - type.margin - (count - k) * (each + type.gap) + type.gap,
                                   plan.inner, each));
}

// Clock and caption, dial and numbers, plots: each of them in a row.
void plan_rows(const Writer& measure, const Scene& scene, double height, NumbersPlan& plan) {
    const TypeScale& type = measure.type;
    const double beside = plan.width + 2 * type.gap;
    plan.caption_beside = plan.inner - beside > 8 * type.minor;
    double y = plan.clock_end;
    if (plan.caption_beside) {
        plan.caption_x += beside;
        plan.caption_wrap -= beside;
        plan.caption = plan.clock + 0.3 * type.minor;
        plan.caption_lines = 3;
        y = std::max(y, plan.caption + 3 * 1.3 * type.minor) + 0.5 * type.gap;
    } else {
        // Two lines are kept for the caption, whatever it says, so that nothing moves.
        plan.caption = y;
        plan.caption_lines = 2;
        y += 2.6 * type.minor + type.gap;
    }
    plan.caption_end = plan.note = y;
    plan.note_end = y += note_height(measure, scene, plan.inner);
    double right = plan.width;
    if (scene.drive.present) {
        plan.dial = plan.drive = y;
        const TextSize disc =
            plan.has_dial ? dial_block(measure, scene.drive, nullptr, plan.radius, 0, 0) : TextSize{};
        const TextSize drive = drive_block(measure, scene, 0, 0);
        const TextSize arrows = plan.has_arrows ? arrows_block(measure, scene, nullptr, 0, 0) : TextSize{};
        plan.drive_x = plan.x + (plan.has_dial ? disc.width + type.gap : 0);
        plan.arrows_x = plan.drive_x + drive.width + 2 * type.gap;
        right = std::max(right, plan.has_arrows ? plan.arrows_x + arrows.width - plan.x
                                                : plan.drive_x + drive.width - plan.x);
        y += std::max({disc.height, drive.height, arrows.height});
        plan.dial_end = y + 0.2 * type.gap;
    }
    plan.fits = right <= plan.inner && (height <= 0 || y <= height - 0.5 * type.margin);
    const auto count = static_cast<double>(scene.film.shows.plots.size());
    const double room = height > 0 ? height - type.margin - y - type.gap : least_plot * scene.film.height;
    const double each = std::min(room, least_plot * scene.film.height);
    const double wide = (plan.inner - type.gap * (count - 1.0)) / std::max(count, 1.0);
    const double least = std::max(least_row * scene.film.height, least_lines * type.minor);
    for (double k = 0; k < count && room >= least; ++k)
        plan.plots.push_back(whole(plan.x + k * (wide + type.gap), y + type.gap, wide, each));
    if (!plan.plots.empty()) y += type.gap + each;
    plan.height = y;
}

NumbersPlan plan_with(const Writer& measure, const Scene& scene, double width, double height, bool portrait,
                      bool arrows, bool dial) {
    const TypeScale& type = measure.type;
    NumbersPlan plan;
    plan.has_arrows = arrows;
    plan.has_dial = dial;
    plan.x = portrait ? type.margin : 0.5 * type.margin;
    plan.inner = std::max(1.0, width - (portrait ? 2.0 : 1.5) * type.margin);
    plan.radius = portrait ? std::min(2.2 * type.main, 0.14 * plan.inner) : 2.2 * type.main;
    plan.caption_x = plan.x;
    plan.caption_wrap = plan.inner;
    plan.clock = type.margin;
    const TextSize clock = clock_block(measure, scene, widest_frame(), 0, 0);
    plan.clock_end = plan.clock + clock.height + 0.3 * type.gap;
    plan.width = clock.width;
    (portrait ? plan_rows : plan_column)(measure, scene, height, plan);
    return plan;
}

}  // namespace

NumbersPlan plan_numbers(const Writer& measure, const Scene& scene, double width, double height,
                         bool portrait) {
    NumbersPlan plan = plan_with(measure, scene, width, height, portrait, portrait, true);
    if (!plan.fits && portrait) plan = plan_with(measure, scene, width, height, portrait, false, true);
    if (!plan.fits) plan = plan_with(measure, scene, width, height, portrait, false, false);
    return plan;
}

}  // namespace grainreel
