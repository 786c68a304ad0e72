// Plots beside the grains, which change in the course of the film: what all of them can do (SidePlot), and a
// measure against time (Plot). Profiles are in profile_plot.hpp. Charts that a run keeps as files are drawn
// by gnuplot.
#pragma once

#include <cairo.h>
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/text/units.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class SidePlot {
  public:
    virtual ~SidePlot() = default;

    // Takes the next frame. Returns whether anything changed.
    virtual bool take(const Shot& frame) = 0;
    // The span of the values' axis, SI; none before there is a value. show() gives it another span, which
    // plots that stand together share.
    virtual std::optional<std::array<double, 2>> limits() const = 0;
    virtual void show(const std::array<double, 2>& limits) = 0;
    // Draws the plot with its top left corner at (x, y).
    virtual void draw(cairo_t* on, int x, int y) = 0;
};

// place: only its size counts. end: s, where the axis of time ends. expected: SI, a value that the unit of
// the values must suit, in addition to the values that the scene itself makes likely.
std::unique_ptr<SidePlot> make_side_plot(const FilmedScene& scene, const FilmPlot& plot,
                                         const Rectangle& place, double end, const TypeScale& type,
                                         const Palette& palette, double expected = 0);

// What is known of a plot against time before the film begins.
struct PlotRange {
    std::string column, label;
    Dimension dimension = Dimension::number;
    std::array<double, 2> time{0, 1};  // s, of the whole run
    double window = 0;  // s: the axis shows the last so long and moves along with time; 0: the whole run
    std::optional<std::array<double, 2>> range;  // SI
    bool smooth = false;     // the line is the mean over the last period; the rows lie faint behind it
    bool from_zero = false;  // the values' axis begins at 0
    double expected = 0;     // SI: a value that the values' unit must suit
    std::string time_name = "time";
    int width = 0, height = 0;  // pixels
};
// The PlotRange of a plot of the scene's film, without its size.
PlotRange plot_frame(const FilmedScene& scene, const FilmPlot& plot);

class Plot final : public SidePlot {
  public:
    Plot(const PlotRange& frame, const TypeScale& type, const Palette& palette);

    // Takes the first measure_rows rows of the frame's measures, as far as it has not taken them yet. Limits
    // only grow, and depend on the rows alone. A row without a value (NaN) leaves a gap.
    bool take(const Shot& frame) override;
    std::optional<std::array<double, 2>> limits() const override {
        return any_ ? std::optional(limits_) : frame_.range;
    }
    void show(const std::array<double, 2>& limits) override { shown_ = limits; }
    void draw(cairo_t* on, int x, int y) override;

    // Where a time and a value lie; pixels from the plot's corner.
    double x_of(double time) const;
    double y_of(double value) const;

  private:
    // All values that fall into one column of pixels.
    struct Slice {
        int count = 0;
        bool after_gap = false;  // the curve begins here: there is no value before
        double first = 0, last = 0, low = 0, high = 0;
        void add(double value);
    };
    struct Curve {
        std::deque<Slice> slices;
        std::int64_t first = 0;  // column of the first slice; columns are counted from the run's beginning
        bool gap = true;         // the last row has no value
    };
    struct TimeTick {
        double time;  // s
        std::string text;
    };
    std::vector<TimeTick> time_ticks() const;
    bool short_run() const { return frame_.time[1] < 0.1; }  // time is shown in ms
    const std::array<double, 2>& span() const { return shown_ ? *shown_ : limits_; }
    // s: where the axis of time begins, and how long it is.
    double begin() const;
    double length() const;
    double columns_a_second() const { return (right_ - left_) / length(); }
    Slice& slice_at(Curve& curve, double time) const;
    void forget();
    // Adds a value to a curve. The curve breaks where there is no value.
    void add(Curve& curve, double time, double value);
    double mean_of_period(double cycles, double value);
    void widen(double value);
    void keep_axes();
    void draw_axes(cairo_t* on);
    void draw_curve(cairo_t* on, const Curve& curve, double width, double strength) const;
    const std::string& unit(double largest);

    const PlotRange frame_;
    const TypeScale type_;
    const Palette palette_;
    double left_, right_, top_, bottom_;  // pixels, of the box
    CairoSurface axes_;
    std::optional<std::array<double, 3>> drawn_;  // limits and beginning of the axes as drawn
    std::shared_ptr<const MeasureTable> table_;
    std::size_t rows_ = 0;
    double newest_ = 0;                         // s: time of the last row
    std::deque<std::array<double, 2>> period_;  // time (in periods) and value of the last period's rows
    bool any_ = false;
    std::optional<std::string> unit_;             // of the values, the same in all pictures
    std::array<double, 2> limits_{0, 1};          // SI, of the rows
    std::optional<std::array<double, 2>> shown_;  // limits that show() has set in place of limits_
    std::array<double, 2> last_{0, 0};            // time and value of the line's end
    Curve line_, rows_behind_;                    // rows_behind_: empty unless the line is smooth
};

}  // namespace grainreel
