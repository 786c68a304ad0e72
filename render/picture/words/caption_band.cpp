#include "render/picture/words/caption_band.hpp"

#include <algorithm>
#include <cmath>

#include "render/picture/words/captions.hpp"

namespace grainreel {
namespace {

constexpr double of_height = 1.0 / 25, of_width = 1.0 / 20;  // letters, as shares of the picture's size
constexpr double most_band = 0.22;                           // share of the picture's height
constexpr double shrinks[] = {1, 0.9, 0.8, 0.7, 0.6};

double inner_width(double width, double margin) {
    return std::max(1.0, width - 4 * margin);
}

TextStyle style_of(double letters) {
    return {letters, false, true};
}

// The plan with letters of this size.
CaptionPlan plan_with(const Film& film, double letters, double width) {
    CaptionPlan plan;
    plan.letters = letters;
    plan.margin = 0.4 * letters;
    const double line = measure_text("0", style_of(letters)).height, inner = inner_width(width, plan.margin);
    const int most = std::max(1, static_cast<int>((most_band * film.height - 2 * plan.margin) / line));
    for (const FilmCaption& caption : film.captions) {
        const double high = measure_text(longest_caption(caption), style_of(letters), inner, 100).height;
        plan.cut = plan.cut || high > (most + 0.5) * line;
        plan.height = std::max(plan.height, std::min(high, most * line));
    }
    plan.lines = static_cast<int>(std::lround(plan.height / line));
    return plan;
}

}  // namespace

int CaptionPlan::band() const {
    return height > 0 ? static_cast<int>(std::ceil(height + 2 * margin)) : 0;
}

CaptionPlan plan_captions(const Film& film, double width) {
    if (film.captions.empty() || !film.word_kinds.captions) return {};
    const double usual = std::min(of_height * film.height, of_width * film.width);
    CaptionPlan plan;
    for (const double shrink : shrinks) {
        plan = plan_with(film, std::max(least_letters(film), shrink * usual), width);
        if (!plan.cut) break;
    }
    return plan;
}

void draw_caption(const Writer& writer, const CaptionPlan& plan, const std::string& caption, double width) {
    if (caption.empty()) return;
    const TextStyle style = style_of(plan.letters);
    const double inner = inner_width(width, plan.margin);
    const double high = measure_text(caption, style, inner, plan.lines).height;
    // The narrowest width at which the caption has no more lines makes lines of about equal length.
    double narrow = std::min(inner, longest_word(caption, style)), wide = inner;
    while (wide - narrow > plan.letters) {
        const double middle = 0.5 * (narrow + wide);
        (measure_text(caption, style, middle, plan.lines + 1).height > high * 1.01 ? narrow : wide) = middle;
    }
    if (plan.cut) wide = inner;
    writer.write(0.5 * (width - wide), plan.margin + 0.5 * (plan.height - high), caption, style,
                 writer.palette.ink, wide, plan.lines);
}

}  // namespace grainreel
