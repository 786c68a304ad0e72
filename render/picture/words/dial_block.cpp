// The dial: where in its period the drive is, and where in its stroke the floor is.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/drive_schedule.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/captions.hpp"

namespace grainreel {

namespace {

// The floor's displacement from the middle of its stroke, in amplitudes. If a drive without a ramp starts in
// the middle of a period, that middle is not the rest position.
double share_of_stroke(const Drive& drive, const DriveSchedule::Now& now, const State& frame) {
    if (now.amplitude <= 0) return 0;
    const double place = frame.floor().place.dot(drive.direction) / now.amplitude;
    if (now.kind == DriveStage::Kind::taps) return place - 1;  // taps count from the lower end of the stroke
    const double middle = drive.ramp > 0 ? 0 : -std::sin(2 * std::numbers::pi * drive.phase);
    return place - middle;
}

// Places in the dial's block; pixels from its upper left corner. For a drive that goes up and down the bar
// stands at the right, for one that goes sideways it lies below. The tip of the hand is always as far along
// the bar as the sine of the phase.
struct Dial {
    double radius, pen, bar;  // bar: how far from the corner it lies
    bool sideways;
    double sign;  // +1 where the drive's positive direction is to the right

    Dial(const Writer& writer, const Drive& drive, double r, const View* view)
        : radius(r),
          pen(std::max(1.0, writer.type.main / 16)),
          bar(2 * r + 0.9 * writer.type.main),
          sideways(std::abs(drive.direction.z()) < 0.5),
          sign(view && drive.direction.dot(view->right) < 0 ? -1 : 1) {}

    Eigen::Vector2d middle() const { return {radius + pen, radius + pen}; }
    // The place of the hand's tip at a phase, in turns.
    Eigen::Vector2d tip(double phase) const {
        const double along = radius * std::sin(2 * std::numbers::pi * phase),
                     across = radius * std::cos(2 * std::numbers::pi * phase);
        if (sideways) return middle() + Eigen::Vector2d(sign * along, -across);
        return middle() + Eigen::Vector2d(across, -along);
    }
    // A place on the bar, `share` of an amplitude from its middle, and `off` pixels beside it.
    Eigen::Vector2d on_bar(double share, double off = 0) const {
        if (sideways) return {middle().x() + sign * share * radius, bar + off};
        return {bar + off, middle().y() - share * radius};
    }
    TextSize size(const TypeScale& type) const {
        const double disc = 2 * radius + 2 * pen, beyond = bar + 0.6 * type.main;
        return sideways ? TextSize{disc, beyond} : TextSize{beyond, disc};
    }
};

class Pen {
  public:
    Pen(const Writer& writer, double x, double y) : on_(writer.on), corner_(x, y) {
        cairo_new_path(on_);  // text leaves a current point behind
    }
    void colour(const Colour& c) const { set_colour(on_, c); }
    void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width) const {
        cairo_set_line_width(on_, width);
        draw_line(on_, corner_.x() + from.x(), corner_.y() + from.y(), corner_.x() + to.x(),
                  corner_.y() + to.y());
    }
    void dot(const Eigen::Vector2d& at, double radius) const {
        cairo_arc(on_, corner_.x() + at.x(), corner_.y() + at.y(), radius, 0, 2 * std::numbers::pi);
        cairo_fill(on_);
    }
    void circle(const Eigen::Vector2d& at, double radius, double width) const {
        cairo_set_line_width(on_, width);
        cairo_arc(on_, corner_.x() + at.x(), corner_.y() + at.y(), radius, 0, 2 * std::numbers::pi);
        cairo_stroke(on_);
    }
    // Fills the sector from where the hand is at phase 0 to where it is at `phase`.
    void sector(const Dial& dial, double phase, const Colour& c, double alpha) const {
        set_colour(on_, c, alpha);
        cairo_move_to(on_, corner_.x() + dial.middle().x(), corner_.y() + dial.middle().y());
        const int steps = std::max(2, static_cast<int>(std::ceil(128 * phase)));
        for (int i = 0; i <= steps; ++i) {
            const Eigen::Vector2d rim = dial.tip(phase * i / steps);
            cairo_line_to(on_, corner_.x() + rim.x(), corner_.y() + rim.y());
        }
        cairo_close_path(on_);
        cairo_fill(on_);
    }

  private:
    cairo_t* on_;
    const Eigen::Vector2d corner_;
};

void draw_still_part(const Writer& writer, const Dial& dial, const Pen& pen) {
    pen.colour(writer.palette.faint_ink);
    pen.circle(dial.middle(), dial.radius, dial.pen);
    pen.line(2 * dial.middle() - dial.tip(0), dial.tip(0), 0.6 * dial.pen);
    pen.line(dial.on_bar(-1), dial.on_bar(1), dial.pen);
    for (const double level : {-1.0, 0.0, 1.0})
        pen.line(dial.on_bar(level, -3 * dial.pen), dial.on_bar(level, 3 * dial.pen), dial.pen);
}

}  // namespace

TextSize dial_block(const Writer& writer, const Drive& drive, const State* frame, double radius, double x,
                    double y, const View* view) {
    const Dial dial(writer, drive, radius, view);
    const TextSize size = dial.size(writer.type);
    if (!writer.on) return size;
    const Pen pen(writer, x, y);
    if (!frame) {
        draw_still_part(writer, dial, pen);
        return size;
    }
    if (frame->time < 0) return size;  // the drive is off, so there is no hand
    // Close to the period's end, where the phase written beside the dial is 0.00, the disc is empty.
    const double phase = shown_cycle(*frame).phase > 0 ? frame->phase : 0;
    const DriveSchedule::Now now = drive_now(drive, frame->cycles);
    const Eigen::Vector2d tip = dial.tip(phase), floor = dial.on_bar(share_of_stroke(drive, now, *frame));
    if (phase > 0) pen.sector(dial, phase, writer.palette.accent, 0.14);
    pen.colour(writer.palette.accent);
    if (now.kind == DriveStage::Kind::vibrate) pen.line(tip, floor, 0.6 * dial.pen);
    pen.line(dial.middle(), tip, 2 * dial.pen);
    pen.dot(tip, 3 * dial.pen);
    pen.dot(floor, 3 * dial.pen);
    return size;
}

}  // namespace grainreel
