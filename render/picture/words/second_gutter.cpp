// Plans the places of the blocks in the second gutter (blocks.hpp): a column at the side, or rows below the
// container.

#include <algorithm>
#include <cmath>

#include "render/picture/words/blocks.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/film_pace.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr double most_plot = 0.4;         // of the picture's height
constexpr double least_box = 0.125;       // height of a plot's box as a share of the picture's shorter side
constexpr double least_letters = 11;      // width of a plot in a row, in heights of minor letters
constexpr double most_plot_width = 0.24;  // of the picture's width
constexpr double plot_width = 0.2;        // in a gutter at the side, as a share of the picture's width
constexpr double note_width = 0.22;       // in a row, as a share of the gutter's width
constexpr int most_pace_lines = 6;        // of the caption of time
constexpr double caption_letters = 11;    // in a row, the caption's width in heights of minor letters

Rectangle whole(double x, double y, double width, double height) {
    const auto first = [](double pixels) { return static_cast<int>(pixels); };
    return {first(x), first(y), first(x + width) - first(x), first(y + height) - first(y)};
}

// Whether arrows and dial are wanted; they are left out where there is no room.
struct Wanted {
    bool arrows = true, dial = true;
};

class Planner {
  public:
    // at_left: the gutter is a column at the picture's left border, from which words keep a whole margin.
    Planner(const Writer& measure, const FilmedScene& scene, double width, double height, bool stacked,
            bool at_left, Wanted wanted)
        : measure_(measure),
          type_(measure.type),
          scene_(scene),
          width_(width),
          height_(height > 0 ? height : 1e9),
          x_(stacked || at_left ? measure.type.margin : 0.5 * measure.type.margin),
          inner_(std::max(1.0, width - (stacked ? 2.0 : 1.5) * measure.type.margin)),
          line_(measure.write(0, 0, "0", measure.minor(), {}).height),
          clock_(widest_clock(measure, scene)) {
        plan_.has_arrows = wanted.arrows && scene.drive.present && kinds_.arrows;
        plan_.has_dial = wanted.dial && scene.drive.present && kinds_.dial;
        plan_.radius = std::min(2.2 * type_.main, stacked ? 0.14 * inner_ : 1e9);
        if (plan_.has_dial) dial_ = dial_block(measure, scene.drive, nullptr, plan_.radius, 0, 0);
        if (scene.drive.present) drive_ = drive_block(measure, scene, nullptr, nullptr, 0, 0);
        if (plan_.has_arrows && stacked) arrows_ = arrows_block(measure, scene, nullptr, 0, 0);
        plan_.wraps = kinds_.playback || !longest_note(scene).empty() || count() > 0;
        plan_.empty =
            !plan_.wraps && !plan_.has_dial && std::max({clock_.height, drive_.height, arrows_.height}) <= 0;
    }

    NumbersPlan column();
    NumbersPlan rows();
    NumbersPlan row(bool plots_below = false);

  private:
    bool has_drive() const { return plan_.has_dial || drive_.height > 0; }
    double count() const { return static_cast<double>(scene_.film.shows.plots.size()); }
    // Pixels: the width of the longest words above a plot.
    double titles() const {
        double widest = 0;
        for (const FilmPlot& plot : scene_.film.shows.plots)
            widest = std::max(widest, measure_text(plot.label, measure_.main()).width + 1);
        return widest;
    }
    // Lines of the caption of time: `usual`, or as many as the longest one needs.
    int pace_lines(double wrap, int usual) const {
        double longest = 0;
        for (const std::string& caption : paces_)
            longest =
                std::max(longest, measure_text(caption, measure_.minor(), wrap, most_pace_lines).height);
        return std::max(usual, static_cast<int>(std::lround(longest / line_)));
    }
    double note_height(double wrap) const {
        const std::string note = longest_note(scene_);
        return note.empty() ? 0 : note_block(measure_, note, 0, 0, wrap, note_lines).height + type_.gap;
    }
    // Pixels: the least height of a plot of this width, with its title, ticks and the name of the axis of
    // time.
    double least_plot(double wide) const {
        double title = 0;
        for (const FilmPlot& plot : scene_.film.shows.plots)
            title = std::max(title, measure_text(plot.label + " (mm)", measure_.main(), wide, 2).height);
        return least_box * std::min(scene_.film.width, scene_.film.height) + title + 2 * line_ +
               0.95 * type_.minor;
    }
    // A part of the gutter in whole pixels.
    Rectangle part(double left, double top, double right, double bottom) const {
        const int x = std::max(0, static_cast<int>(left)), y = std::max(0, static_cast<int>(top));
        const auto end = [](double at, double most) {
            return static_cast<int>(std::ceil(std::min(at, most)));
        };
        return {x, y, std::max(0, end(right, width_) - x), std::max(0, end(bottom, height_) - y)};
    }
    void plots_in_row(double x, double y, double width, double height);

    const Writer& measure_;
    const TypeScale& type_;
    const FilmedScene& scene_;
    const WordKinds kinds_ = scene_.film.word_kinds;
    const double width_, height_, x_, inner_;
    const double line_;  // pixels: height of a line of minor letters
    const std::vector<std::string> paces_ = playback_captions(scene_.film, scene_.drive);
    const TextSize clock_;
    TextSize dial_, drive_, arrows_;
    NumbersPlan plan_;
};

// The plan at the side: clock, dial, drive and caption below each other, and plots at the lower end.
NumbersPlan Planner::column() {
    plan_.clock = {x_, type_.margin};
    double y = type_.margin + (clock_.height > 0 ? clock_.height + 0.3 * type_.gap : 0);
    plan_.clock_part = part(0, 0, width_, y);
    plan_.width = clock_.width;
    if (has_drive()) {
        plan_.dial = {x_, y + (clock_.height > 0 ? 0.6 * type_.gap : 0)};
        plan_.drive = {x_, plan_.dial.y + (plan_.has_dial ? dial_.height + 0.6 * type_.gap : 0)};
        plan_.dial_part = part(0, plan_.dial.y - 0.4 * type_.gap, width_, plan_.drive.y);
        y = plan_.drive.y + drive_.height + type_.gap;
        if (drive_lines_change(scene_.drive) && drive_.height > 0)
            plan_.drive_part = part(0, std::ceil(plan_.drive.y), width_, std::floor(y));
        plan_.width = std::max({plan_.width, dial_.width, drive_.width});
    }
    plan_.caption = {x_, y};
    plan_.caption_wrap = plan_.note_wrap = inner_;
    const double note = note_height(inner_);
    const int most_lines = pace_lines(inner_, count() > 0 ? 2 : 4);  // plots need the room more
    if (kinds_.playback)
        plan_.caption_lines =
            std::clamp(static_cast<int>((height_ - type_.margin - y - note) / line_), 1, most_lines);
    const double end = y + plan_.caption_lines * line_;
    plan_.caption_part = part(0, y, width_, end);
    plan_.note = {x_, end};
    plan_.note_part = part(0, end, width_, end + note);
    plan_.height = end + note;
    plan_.fits = plan_.width <= inner_ && plan_.height <= height_ - 0.5 * type_.margin;
    plan_.boxes.push_back({x_, plan_.clock.y, inner_, plan_.height - plan_.clock.y});
    const double free = height_ - type_.margin - plan_.height;
    const double least = least_plot(inner_) + type_.gap;
    const double fit = std::min(count(), std::floor(free / least));
    if (fit < 1) return plan_;
    plan_.width = std::max({plan_.width, plot_width * scene_.film.width,
                            std::min(titles(), most_plot_width * scene_.film.width)});
    const double each = std::min(free / fit - type_.gap, most_plot * scene_.film.height);
    const double top = height_ - type_.margin - fit * (each + type_.gap) + type_.gap;
    for (double k = 0; k < fit; ++k)
        plan_.plots.push_back(whole(x_, top + k * (each + type_.gap), inner_, each));
    plan_.boxes.push_back({x_, top, inner_, height_ - type_.margin - top});
    return plan_;
}

// Puts all plots beside each other, or none. They fill the height that is left. While the gutter's height is
// not known, they are as high as `height` says, but not lower than a plot may be.
void Planner::plots_in_row(double x, double y, double width, double height) {
    if (count() < 1) return;
    const double wide = (width - type_.gap * (count() - 1)) / count();
    const double least = least_plot(std::max(1.0, wide));
    const double room = height_ < 1e8 ? height_ - type_.margin - y : std::max(least, height);
    if (room < least || wide < least_letters * type_.minor) return;
    const double each = std::min(room, std::max(least, most_plot * scene_.film.height));
    for (double k = 0; k < count(); ++k)
        plan_.plots.push_back(whole(x + k * (wide + type_.gap), y, wide, each));
    plan_.height = std::max(plan_.height, y + each);
}

// The plan below a narrow picture whose words do not fit beside each other: three rows with clock and
// caption, dial and numbers, and plots.
NumbersPlan Planner::rows() {
    const bool has_clock = clock_.height > 0;
    const double top = type_.margin, beside = has_clock ? clock_.width + 2 * type_.gap : 0;
    const double middle = x_ + beside - 0.5 * type_.gap;
    const bool caption_beside = has_clock && inner_ - beside > 8 * type_.minor;
    plan_.clock = {x_, top};
    double y = top + (has_clock ? clock_.height + 0.3 * type_.gap : 0);
    if (!kinds_.playback) {
        plan_.clock_part = part(0, 0, width_, y);
    } else if (caption_beside) {
        plan_.clock_part = part(0, 0, middle, y);
        plan_.caption = {x_ + beside, top + 0.3 * type_.minor};
        plan_.caption_wrap = inner_ - beside;
        plan_.caption_lines = pace_lines(inner_ - beside, 3);
        y = std::max(y, plan_.caption.y + plan_.caption_lines * line_) + 0.5 * type_.gap;
        plan_.caption_part = part(std::floor(middle), plan_.caption.y, width_, y);
    } else {
        // The caption has the lines of the longest one, whatever it says, so that nothing moves.
        plan_.clock_part = part(0, 0, width_, y);
        plan_.caption = {x_, y};
        plan_.caption_wrap = inner_;
        plan_.caption_lines = pace_lines(inner_, 2);
        y += plan_.caption_lines * line_ + type_.gap;
        plan_.caption_part = part(0, plan_.caption.y, width_, y);
    }
    plan_.note = {x_, y};
    plan_.note_wrap = inner_;
    y += note_height(inner_);
    plan_.note_part = part(0, plan_.note.y, width_, y - 0.4 * type_.gap);  // the dial's part begins there
    double right = clock_.width;
    if (has_drive() || plan_.has_arrows) {
        plan_.dial = {x_, y};
        plan_.drive = {x_ + (plan_.has_dial ? dial_.width + type_.gap : 0), y};
        plan_.arrows = {plan_.drive.x + (drive_.width > 0 ? drive_.width + 2 * type_.gap : 0), y};
        right = std::max(
            right, (plan_.has_arrows ? plan_.arrows.x + arrows_.width : plan_.drive.x + drive_.width) - x_);
        const double end = y + std::max({dial_.height, drive_.height, arrows_.height});
        plan_.dial_part =
            part(0, y - 0.4 * type_.gap, plan_.drive.x - 0.4 * type_.gap, end + 0.2 * type_.gap);
        if (drive_lines_change(scene_.drive) && drive_.height > 0)
            plan_.drive_part = part(std::ceil(plan_.drive.x - 0.4 * type_.gap), y - 0.4 * type_.gap,
                                    plan_.arrows.x - type_.gap, end + 0.2 * type_.gap);
        y = end;
    }
    plan_.height = y;
    plan_.width = right;
    plan_.fits = right <= inner_ && y <= height_ - 0.5 * type_.margin;
    plots_in_row(x_, y + type_.gap, inner_, 0);
    plan_.boxes = {{x_, top, inner_, plan_.height - top}};
    return plan_;
}

// The plan below a wide picture: everything in one row. plots_below: plots have a second row.
NumbersPlan Planner::row(bool plots_below) {
    const double gap = 2 * type_.gap, top = 0.5 * type_.margin;
    double x = x_;
    const auto next = [&](double width) {
        const double at = x;
        x += width > 0 ? width + gap : 0;
        return WordPoint{at, top};
    };
    const double first = std::max(clock_.width, kinds_.playback ? caption_letters * type_.minor : 0);
    plan_.clock = next(first);
    plan_.caption = {plan_.clock.x, top + (clock_.height > 0 ? clock_.height + 0.3 * type_.gap : 0)};
    plan_.caption_wrap = std::max(1.0, first);
    plan_.caption_lines = kinds_.playback ? pace_lines(plan_.caption_wrap, 3) : 0;
    const double end = plan_.caption.y + plan_.caption_lines * line_, right = x - 0.5 * gap;
    plan_.clock_part = part(0, 0, right, plan_.caption.y);
    plan_.caption_part = part(0, plan_.caption.y, right, end);
    plan_.dial = next(dial_.width);
    plan_.dial_part = part(plan_.dial.x - 0.4 * gap, top, x - 0.6 * gap, top + dial_.height + 0.2 * gap);
    plan_.drive = next(drive_.width);
    if (drive_lines_change(scene_.drive) && drive_.height > 0)
        plan_.drive_part =
            part(plan_.drive.x - 0.4 * gap, top, x - 0.6 * gap, top + drive_.height + 0.2 * gap);
    plan_.arrows = next(arrows_.width);
    double height = std::max({end, top + dial_.height, top + drive_.height, top + arrows_.height});
    if (const double wrap = note_width * inner_, note = note_height(wrap); note > 0) {
        plan_.note = next(wrap);
        plan_.note_wrap = wrap;
        plan_.note_part = part(plan_.note.x, top, x - 0.5 * gap, top + note);
        height = std::max(height, top + note);
    }
    plan_.height = height;
    plan_.width = x - gap - x_;
    plan_.fits = plan_.width <= inner_ && height <= height_ - 0.5 * type_.margin;
    if (plots_below)
        plots_in_row(x_, height + type_.gap, inner_, 0);
    else
        plots_in_row(x, top, x_ + inner_ - x, height - top);
    plan_.boxes = {{x_, top, inner_, plan_.height - top}};
    return plan_;
}

}  // namespace

NumbersPlan plan_numbers(const Writer& measure, const FilmedScene& scene, double width, double height,
                         bool stacked, bool at_left) {
    if (width <= 0) {  // there is no gutter
        NumbersPlan none;
        none.has_dial = none.has_arrows = false;
        return none;
    }
    const auto planner = [&](Wanted wanted) {
        return Planner(measure, scene, width, height, stacked, at_left, wanted);
    };
    if (!stacked) {
        const NumbersPlan plan = planner({false, true}).column();
        return plan.fits ? plan : planner({false, false}).column();
    }
    const std::size_t plots = scene.film.shows.plots.size();
    for (const bool plots_below : {false, true}) {
        const NumbersPlan plan = planner({}).row(plots_below);
        if (plan.fits && plan.plots.size() == plots) return plan;
    }
    NumbersPlan plan = planner({}).rows();
    if (!plan.fits) plan = planner({false, true}).rows();
    if (!plan.fits) plan = planner({false, false}).rows();
    return plan;
}

NumbersPlan plan_numbers(const Writer& measure, const FilmedScene& scene, const PictureLayout& layout) {
    const Rectangle& gutter = layout.second;
    return plan_numbers(measure, scene, gutter.width, gutter.height, layout.stacked, gutter.x == 0);
}

}  // namespace grainreel
