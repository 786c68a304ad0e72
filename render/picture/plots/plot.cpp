// A plot of a measure against time: it takes rows of measures, widens its limits, and draws axes and curve.
#include "render/picture/plots/plot.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/measure/columns.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/text/units.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/plots/axes.hpp"
#include "render/picture/plots/profile_plot.hpp"
#include "render/scene/axis_titles.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

std::unique_ptr<SidePlot> make_side_plot(const FilmedScene& scene, const FilmPlot& plot,
                                         const Rectangle& place, double end, const TypeScale& type,
                                         const Palette& palette, double expected) {
    if (plot.is_profile())
        return std::make_unique<ProfilePlot>(scene, plot, place.width, place.height, type, palette);
    PlotRange frame = plot_frame(scene, plot);
    frame.time[1] = end;
    frame.expected = std::max(frame.expected, expected);
    frame.width = place.width;
    frame.height = place.height;
    return std::make_unique<Plot>(frame, type, palette);
}

namespace {

constexpr double least_room = 1e-12;  // room above and below values that are all alike

}  // namespace

void Plot::Slice::add(double value) {
    if (count++ == 0) first = low = high = value;
    last = value;
    low = std::min(low, value);
    high = std::max(high, value);
}

namespace {

// The largest Gamma of the drive and its stages; 0 without gravity.
double highest_g_level(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    if (!(gravity > 0) || !scene.drive.present) return 0;
    double highest = scene.drive.g_level(gravity);
    if (!scene.drive.changes()) return highest;
    const DriveSchedule schedule(scene.drive);
    for (const PeriodStretch& stretch : schedule.times().stretches()) {
        const DriveSchedule::Now now = schedule.now(stretch.cycles);
        const double omega = 2 * std::numbers::pi * now.frequency;
        if (now.kind != DriveStage::Kind::rest)
            highest = std::max(highest, now.amplitude * omega * omega / gravity);
    }
    return highest;
}

// The whole axis of a column that has a known bound, which it reaches in the end. Such an axis is the same
// from the first picture on.
std::optional<std::array<double, 2>> known_range(const Scene& scene, const std::string& column) {
    double most = 0;
    if (column == "outflow_kg") most = total_mass(scene);
    if (column == "drive_g_level") most = highest_g_level(scene);
    if (!(most > 0)) return std::nullopt;
    return round_limits(0, most, most_axis_ticks + 1);
}

}  // namespace

PlotRange plot_frame(const FilmedScene& scene, const FilmPlot& plot) {
    PlotRange frame;
    frame.column = plot.column;
    const LabelParts label = label_parts(plot.label, plot.dimension);
    frame.label = label.words;
    frame.unit = label.unit;
    frame.dimension = plot.dimension;
    frame.time = {0, scene.run.duration};
    frame.range = plot.range;
    frame.window = plot.window;
    frame.smooth = plot.period;
    const ColumnAxis axis = axis_of_column(scene, plot.column);
    frame.from_zero = axis.from_zero;
    frame.expected = axis.expected;
    if (!frame.range) frame.range = known_range(scene, plot.column);
    frame.time_name = scene.film.wording(Word::time);
    return frame;
}

Plot::Plot(const PlotRange& frame, const TypeScale& type, const Palette& palette)
    : frame_(frame),
      type_(type),
      palette_(palette),
      axes_(blank_surface({0, 0, frame.width, frame.height}, palette.background, 0)) {
    const double words = line_height(type.minor);
    double end = 0;
    newest_ = frame.time[1];  // where the numbers of a moving axis are longest
    for (const TimeTick& tick : time_ticks()) end = measure_text(tick.text, {type.minor, false}).width;
    left_ = std::ceil(measure_text("−0.00", {type.minor, false}).width + 0.6 * type.minor);
    right_ = std::floor(frame.width - std::max(0.5 * end, 0.4 * type.main));
    const std::string usual_unit = frame.dimension == Dimension::number ? "" : "mmm";
    const std::string longest = with_unit(frame.label, frame.unit.empty() ? usual_unit : frame.unit);
    top_ = std::ceil(
        measure_text(longest, {type.main, false}, frame.width, title_lines(frame.height, type)).height +
        0.6 * type.minor);
    bottom_ = std::floor(frame.height - 2 * words - 0.35 * type.minor);
    forget();
}

std::vector<Plot::TimeTick> Plot::time_ticks() const {
    const double unit = short_run() ? 1e-3 : 1;
    const std::vector<double> times =
        round_ticks(begin() / unit, (begin() + length()) / unit, most_axis_ticks);
    std::vector<TimeTick> ticks;
    for (const double time : times)
        ticks.push_back({time * unit, tick_text(time, times.size() > 1 ? times[1] - times[0] : 1)});
    return ticks;
}

void Plot::forget() {
    rows_ = 0;
    period_.clear();
    any_ = false;
    unit_.reset();
    limits_ = frame_.range.value_or(std::array<double, 2>{0, 1});
    newest_ = frame_.time[0];
    const std::deque<Slice> none(static_cast<std::size_t>(std::max(1.0, right_ - left_)) + 1);
    line_ = rows_behind_ = {none, 0, true};
}

double Plot::length() const {
    const double all = frame_.time[1] - frame_.time[0];
    return frame_.window > 0 ? std::min(frame_.window, all) : all;
}

double Plot::begin() const {
    return std::max(frame_.time[0], newest_ - length());
}

double Plot::x_of(double time) const {
    return left_ + (time - begin()) / length() * (right_ - left_);
}

double Plot::y_of(double value) const {
    const auto& [low, high] = span();
    const double share = (value - low) / (high - low);
    return bottom_ - std::clamp(share, 0.0, 1.0) * (bottom_ - top_);
}

bool Plot::take(const Shot& frame) {
    if (!frame.measures || (frame.measures == table_ && frame.measure_rows == rows_)) return false;
    if (frame.measures != table_ || frame.measure_rows < rows_) forget();
    table_ = frame.measures;
    const std::vector<std::string>& columns = frame.measures->columns();
    const auto column = [&](const std::string& name) {
        const auto found = std::find(columns.begin(), columns.end(), name);
        GRAINREEL_CHECK(found != columns.end());
        return frame.measures->values(static_cast<std::size_t>(found - columns.begin()), rows_,
                                      frame.measure_rows);
    };
    const std::vector<double> times = column("time_s");
    std::vector<double> values = column(frame_.column);
    if (frame_.smooth) {
        const std::vector<double> cycles = column("cycles");
        for (std::size_t i = 0; i < times.size(); ++i) {
            add(rows_behind_, times[i], values[i]);
            values[i] = mean_of_period(cycles[i], values[i]);
        }
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
        add(line_, times[i], values[i]);
        if (!line_.gap) last_ = {times[i], values[i]};
    }
    rows_ = frame.measure_rows;
    if (frame_.window > 0 && !times.empty()) newest_ = times.back();
    return true;
}

// The mean of this row and of those less than a period old. NaN before a period has passed.
double Plot::mean_of_period(double cycles, double value) {
    constexpr double hair = 1e-3;  // tolerance, as a share of a period: rows are at whole time steps
    period_.push_back({cycles, value});
    while (period_.front()[0] <= cycles - 1 + hair) period_.pop_front();
    double sum = 0, count = 0;
    for (const auto& [at, one] : period_)
        if (std::isfinite(one)) sum += one, ++count;
    return cycles >= 1 - hair && count > 0 ? sum / count : kUnknown;
}

void Plot::add(Curve& curve, double time, double value) {
    const bool after_gap = curve.gap;
    curve.gap = !std::isfinite(value);
    if (curve.gap) return;
    if (!frame_.range) widen(value);
    any_ = true;
    Slice& slice = slice_at(curve, time);
    if (slice.count == 0) slice.after_gap = after_gap;
    slice.add(value);
}

// The slice of a time. A moving axis forgets the slices that have left it.
Plot::Slice& Plot::slice_at(Curve& curve, double time) const {
    const auto size = static_cast<std::int64_t>(curve.slices.size());
    const double column = std::max(0.0, std::floor((time - frame_.time[0]) * columns_a_second()));
    if (!(frame_.window > 0))
        return curve.slices[static_cast<std::size_t>(std::min(column, static_cast<double>(size - 1)))];
    const auto at = static_cast<std::int64_t>(std::min(column, 9e15));
    if (at - curve.first >= 2 * size) {  // nothing of what was seen is on the axis
        std::fill(curve.slices.begin(), curve.slices.end(), Slice());
        curve.first = at - size + 1;
    }
    for (; at - curve.first >= size; ++curve.first) {
        curve.slices.pop_front();
        curve.slices.emplace_back();
    }
    return curve.slices[static_cast<std::size_t>(std::max<std::int64_t>(0, at - curve.first))];
}

void Plot::widen(double value) {
    if (any_ && value >= limits_[0] && value <= limits_[1]) return;
    const double low = any_ ? std::min(limits_[0], value) : value;
    const double high = any_ ? std::max(limits_[1], value) : value;
    // Around the first value there is room for a change by a tenth of it.
    const double room = any_ ? 0 : std::max(0.1 * std::abs(value), least_room);
    const std::array<double, 2> wide =
        round_limits(frame_.from_zero ? 0 : low - room, high + room, most_axis_ticks + 1);
    limits_ = {any_ ? std::min(limits_[0], wide[0]) : wide[0],
               any_ ? std::max(limits_[1], wide[1]) : wide[1]};
}

// The unit is chosen when the first values are there, by those that the scene makes likely, and stays. Only
// numbers that would be too long for the axis, or all zeros, change it.
const std::string& Plot::unit(double largest) {
    constexpr double longest = 1e4, shortest = 0.02;
    if (!frame_.unit.empty()) return frame_.unit;
    const bool stays = unit_ && (largest == 0 || (largest < longest * unit_size(*unit_, frame_.dimension) &&
                                                  largest > shortest * unit_size(*unit_, frame_.dimension)));
    if (!stays) unit_ = fitting_unit(largest, frame_.dimension);
    return *unit_;
}

// Axes are drawn anew only when their limits have changed.
void Plot::keep_axes() {
    const CairoContext on(cairo_create(axes_.get()));
    fill_surface(on.get(), palette_.background, 0);
    draw_axes(on.get());
    drawn_ = {span()[0], span()[1], begin()};
}

void Plot::draw_axes(cairo_t* on) {
    const TextStyle minor{type_.minor, false};
    const double tick = 0.3 * type_.minor;
    const auto& [low, high] = span();
    const double largest = std::max({std::abs(low), std::abs(high), frame_.expected});
    const std::string& shown_unit = unit(largest);
    const double size = unit_size(shown_unit, frame_.dimension);
    draw_title(on, with_unit(frame_.label, shown_unit), frame_.width, frame_.height, type_, palette_.ink);

    // If all values are 0, no unit fits them, and the only tick is at 0.
    const bool zeros = high - low < 10 * least_room && low <= 0 && high >= 0;
    const PlotBox box{left_, right_, top_, bottom_};
    const AxisTicks ticks = zeros ? AxisTicks{{0}, 1} : upright_ticks(box, type_, low / size, high / size);
    draw_upright_axis(
        on, box, ticks, [&](double value) { return y_of(value * size); }, type_, palette_);
    draw_line(on, left_, bottom_, right_, bottom_);
    double below = 0;
    for (const TimeTick& at : time_ticks()) {
        const double x = x_of(at.time);
        set_colour(on, palette_.faint_ink);
        draw_line(on, x, bottom_, x, bottom_ + tick);
        const TextSize words = measure_text(at.text, minor);
        draw_text(on, x - 0.5 * words.width, bottom_ + tick, at.text, minor, palette_.faint_ink);
        below = words.height;
    }
    const std::string name = with_unit(frame_.time_name, short_run() ? "ms" : "s", Dimension::time);
    draw_text(on, right_ - measure_text(name, minor).width, bottom_ + tick + below, name, minor,
              palette_.faint_ink);
}

void Plot::draw_curve(cairo_t* on, const Curve& curve, double width, double strength) const {
    cairo_save(on);
    if (frame_.window > 0) {  // a part of the oldest column has left the box
        cairo_rectangle(on, left_, 0, frame_.width - left_, frame_.height);
        cairo_clip(on);
    }
    cairo_new_path(on);
    const double gone = (begin() - frame_.time[0]) * columns_a_second() - static_cast<double>(curve.first);
    for (std::size_t i = 0; i < curve.slices.size(); ++i) {
        const Slice& slice = curve.slices[i];
        if (slice.count == 0) continue;
        const double x = left_ + static_cast<double>(i) + 0.5 - gone;
        if (slice.after_gap) cairo_move_to(on, x, y_of(slice.first));
        for (const double value : {slice.first, slice.low, slice.high, slice.last})
            cairo_line_to(on, x, y_of(value));
    }
    set_colour(on, palette_.ink, strength);
    cairo_set_line_width(on, width);
    cairo_set_line_join(on, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(on);
    cairo_restore(on);
}

void Plot::draw(cairo_t* on, int x, int y) {
    cairo_save(on);
    cairo_translate(on, x, y);
    if (keeps_text(on)) {
        draw_axes(on);
    } else {
        if (drawn_ != std::array{span()[0], span()[1], begin()}) keep_axes();
        cairo_set_source_surface(on, axes_.get(), 0, 0);
        cairo_paint(on);
    }
    const double pen = std::max(1.0, type_.main / 14);
    if (frame_.smooth) draw_curve(on, rows_behind_, std::max(1.0, 0.5 * pen), 0.25);
    draw_curve(on, line_, frame_.smooth ? 1.6 * pen : pen, 1);
    if (!line_.gap) {
        set_colour(on, palette_.accent);
        cairo_new_path(on);
        cairo_arc(on, x_of(last_[0]), y_of(last_[1]), std::max(2.5, 0.18 * type_.main), 0,
                  2 * std::numbers::pi);
        cairo_fill(on);
    }
    cairo_restore(on);
}

}  // namespace grainreel
