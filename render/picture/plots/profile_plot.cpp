// Computes a frame's profile by coarse-graining, and draws its axes and curves.
#include "render/picture/plots/profile_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/bed.hpp"
#include "engine/scene/text/units.hpp"
#include "render/picture/camera/framing.hpp"
#include "render/picture/grains/velocity_field.hpp"
#include "render/picture/plots/axes.hpp"
#include "render/scene/axis_titles.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {
namespace {

// The kernel's width and the cells are the defaults of fields.nc.
FieldOutput resolution(const FilmedScene& scene) {
    const double width = 0.5 * mean_diameter(scene);
    return picture_fields(scene, width, width);
}

// m: the span of the axis of places. It is as high as the picture shows the container, or as wide as the
// container.
std::array<double, 2> places_of(const FilmedScene& scene, bool across) {
    const Extent extent = extent_of(scene);
    if (across) return {extent.low.y(), extent.high.y()};
    if (scene.container.shape == Container::Shape::none || scene.container.shape == Container::Shape::mesh)
        return {extent.low.z(), extent.high.z()};
    const double top = std::min(scene.container.height, framed_part(scene).top);
    return {0, top > 0 ? top : scene.container.height};
}

}  // namespace

ProfilePlot::ProfilePlot(const FilmedScene& scene, const FilmPlot& plot, int width, int height,
                         const TypeScale& type, const Palette& palette)
    : scene_(scene),
      plot_(plot),
      width_(width),
      height_(height),
      type_(type),
      palette_(palette),
      places_(places_of(scene, plot.across)),
      range_(plot.range.value_or(usual_profile_range(scene, plot))),
      sums_(scene, resolution(scene), 1) {
    const double words = line_height(type.minor);
    left_ = std::ceil(measure_text("−0.00", {type.minor, false}).width + 0.6 * type.minor);
    right_ = std::floor(width - 1.2 * type.minor);
    const LabelParts label = label_parts(plot.label, plot.dimension);
    const std::string usual_unit = plot.dimension == Dimension::number ? "" : "mmm";
    const std::string title = with_unit(label.words, label.unit.empty() ? usual_unit : label.unit);
    top_ = std::ceil(measure_text(title, {type.main, false}, width, title_lines(height, type)).height +
                     0.6 * type.minor + (plot.across ? 0 : words));
    bottom_ = std::floor(height - (plot.across ? 2 : 1) * words - 0.35 * type.minor);
}

bool ProfilePlot::take(const Shot& frame) {
    sums_.clear();
    sums_.add(field_state_of(scene_, frame, plot_.period), 0);
    const CoarseFields fields = sums_.mean();
    const ProfileAxis axis = plot_.across ? ProfileAxis::across : ProfileAxis::height;
    if (plot_.profile == ProfileOf::solid_fraction)
        curves_ = solid_profiles(fields, sums_, axis);
    else if (plot_.profile == ProfileOf::share)
        curves_ = share_profiles(fields, sums_, axis);
    else
        curves_ = {
            velocity_profile(fields, sums_, axis, plot_.profile == ProfileOf::horizontal_velocity ? 1 : 2)};
    return true;
}

ProfilePlot::Axis ProfilePlot::place_axis() const {
    const std::string unit = fitting_unit(std::max(-places_[0], places_[1]), Dimension::length);
    return {
        places_,
        with_unit(scene_.film.wording(plot_.across ? Word::across : Word::height), unit, Dimension::length),
        unit_size(unit, Dimension::length)};
}

ProfilePlot::Axis ProfilePlot::value_axis() const {
    const LabelParts label = label_parts(plot_.label, plot_.dimension);
    const std::string unit =
        label.unit.empty() ? fitting_unit(std::max(-range_[0], range_[1]), plot_.dimension) : label.unit;
    return {range_, with_unit(label.words, unit), unit_size(unit, plot_.dimension)};
}

std::array<double, 2> ProfilePlot::pixel_of(double value, double place) const {
    const auto share = [](double at, const std::array<double, 2>& span) {
        return (at - span[0]) / (span[1] - span[0]);
    };
    const double of_value = share(value, range_), of_place = share(place, places_);
    return {left_ + (plot_.across ? of_place : of_value) * (right_ - left_),
            bottom_ - (plot_.across ? of_value : of_place) * (bottom_ - top_)};
}

void ProfilePlot::draw(cairo_t* on, int x, int y) {
    cairo_save(on);
    cairo_translate(on, x, y);
    const Axis values = value_axis(), places = place_axis();
    draw_title(on, values.name, width_, height_, type_, palette_.ink);
    const TextStyle minor{type_.minor, false};
    if (plot_.across)
        draw_text(on, right_ - measure_text(places.name, minor).width, height_ - line_height(type_.minor),
                  places.name, minor, palette_.faint_ink);
    else
        draw_text(on, 0, top_ - line_height(type_.minor) - 0.3 * type_.minor, places.name, minor,
                  palette_.faint_ink);
    draw_standing_axis(on, plot_.across ? values : places);
    draw_lying_axis(on, plot_.across ? places : values);
    const bool by_species = curves_.size() == scene_.species.size() && !plot_.of_velocity();
    for (std::size_t c = 0; c < curves_.size(); ++c)
        draw_curve(on, curves_[c], by_species ? scene_.colours[c] : palette_.ink);
    cairo_restore(on);
}

void ProfilePlot::draw_standing_axis(cairo_t* on, const Axis& axis) const {
    const PlotBox box{left_, right_, top_, bottom_};
    const AxisTicks ticks = upright_ticks(box, type_, axis.span[0] / axis.unit, axis.span[1] / axis.unit);
    const auto height_of = [&](double value) {
        const double share = (value * axis.unit - axis.span[0]) / (axis.span[1] - axis.span[0]);
        return bottom_ - share * (bottom_ - top_);
    };
    draw_upright_axis(on, box, ticks, height_of, type_, palette_);
}

void ProfilePlot::draw_lying_axis(cairo_t* on, const Axis& axis) const {
    const TextStyle minor{type_.minor, false};
    const double pen = std::max(1.0, type_.main / 20), tick = 0.3 * type_.minor;
    const int fit = std::clamp(static_cast<int>((right_ - left_) / (4 * type_.minor)), 2, most_axis_ticks);
    const AxisTicks ticks =
        axis_ticks(axis.span[0] / axis.unit, axis.span[1] / axis.unit, fit, most_axis_ticks + 1);
    for (const double value : ticks.at) {
        const double share = (value * axis.unit - axis.span[0]) / (axis.span[1] - axis.span[0]);
        const double x = left_ + share * (right_ - left_);
        cairo_set_line_width(on, 0.7 * pen);
        set_colour(on, palette_.ink, 0.15);
        draw_line(on, x, top_, x, bottom_);
        set_colour(on, palette_.faint_ink);
        draw_line(on, x, bottom_, x, bottom_ + tick);
        const std::string text = tick_text(value, ticks.distance);
        const double half = 0.5 * measure_text(text, minor).width;
        draw_text(on, std::min(x - half, width_ - 2 * half), bottom_ + tick, text, minor, palette_.faint_ink);
    }
    set_colour(on, palette_.faint_ink);
    cairo_set_line_width(on, pen);
    draw_line(on, left_, bottom_, right_, bottom_);
}

// The curve is broken where there is no value, and cut off at the edges of the box.
void ProfilePlot::draw_curve(cairo_t* on, const std::vector<double>& values, const Colour& colour) const {
    const GridAxis& axis = sums_.grid().axes[plot_.across ? 1 : 2];
    const double width = std::max(1.2, type_.main / 10);
    cairo_save(on);
    cairo_rectangle(on, left_ - width, top_ - width, right_ - left_ + 2 * width, bottom_ - top_ + 2 * width);
    cairo_clip(on);
    cairo_new_path(on);
    bool drawing = false;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double place = axis.middle(static_cast<std::int64_t>(k));
        const bool there = std::isfinite(values[k]) && place >= places_[0] && place <= places_[1];
        if (there) {
            const auto [x, y] = pixel_of(values[k], place);
            drawing ? cairo_line_to(on, x, y) : cairo_move_to(on, x, y);
        }
        drawing = there;
    }
    set_colour(on, colour);
    cairo_set_line_width(on, width);
    cairo_set_line_join(on, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(on);
    cairo_restore(on);
}

}  // namespace grainreel
