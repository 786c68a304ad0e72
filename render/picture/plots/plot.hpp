// A plot beside the grains, which goes with the film.
#pragma once

#include <cairo.h>
#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/text/units.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class SidePlot {
  public:
    virtual ~SidePlot() = default;

    // False when nothing changed.
    virtual bool take(const Frame& frame) = 0;
    // What the values' axis spans, SI, none before there is a value; and another span for it, of plots that
    // stand together.
    virtual std::optional<std::array<double, 2>> limits() const = 0;
    virtual void show(const std::array<double, 2>& limits) = 0;
    // Top left corner at (x, y).
    virtual void draw(cairo_t* on, int x, int y) = 0;
};

// place: only its size counts. end: s, of the axis of time. expected: SI, of which size the unit of a
// column's values is at least, beside what the scene says of it.
std::unique_ptr<SidePlot> make_side_plot(const FilmedScene& scene, const FilmPlot& plot,
                                         const Rectangle& place, double end, const TypeScale& type,
                                         const Palette& palette, double expected = 0);

// A measure against time, drawn beside the grains while the film goes on.

// What is known before the film begins.
struct PlotFrame {
    std::string column, label;
    Dimension dimension = Dimension::number;
    std::array<double, 2> time{0, 1};            // s, of the whole run
    std::optional<std::array<double, 2>> range;  // SI
    bool smooth = false;        // means over the last period of the drive in place of the rows
    bool from_zero = false;     // the values' axis begins at 0
    double expected = 0;        // SI, of which size the values' unit is at least
    int width = 0, height = 0;  // pixels
};
// The frame of a plot that the scene's film shows, without its size.
PlotFrame plot_frame(const FilmedScene& scene, const FilmPlot& plot);

class Plot final : public SidePlot {
  public:
    Plot(const PlotFrame& frame, const TypeScale& type, const Palette& palette);

    // The rows up to the frame's. Limits only grow, and depend on the rows alone. A row without a value (NaN)
    // leaves a gap. False when nothing changed.
    bool take(const Frame& frame) override;
    std::optional<std::array<double, 2>> limits() const override {
        return any_ ? std::optional(limits_) : frame_.range;
    }
    void show(const std::array<double, 2>& limits) override { shown_ = limits; }
    void draw(cairo_t* on, int x, int y) override;

    // Where a moment and a value lie, pixels from the plot's corner.
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
    struct TimeTick {
        double time;  // s
        std::string text;
    };
    std::vector<TimeTick> time_ticks() const;
    bool short_run() const { return frame_.time[1] < 0.1; }  // told in ms
    const std::array<double, 2>& span() const { return shown_ ? *shown_ : limits_; }
    void forget();
    void add(double time, double value);
    double mean_of_period(double cycles, double value);
    void widen(double value);
    void draw_axes();
    void draw_curve(cairo_t* on) const;

    const PlotFrame frame_;
    const TypeScale type_;
    const Palette palette_;
    double left_, right_, top_, bottom_;  // of the box, pixels
    CairoSurface axes_;
    std::optional<std::array<double, 2>> drawn_;  // limits of the axes as they are drawn
    std::shared_ptr<const MeasureTable> table_;
    std::size_t rows_ = 0;
    std::deque<std::array<double, 2>> period_;  // periods and values of the last rows
    bool any_ = false;
    bool gap_ = true;                             // the last row has no value
    std::array<double, 2> limits_{0, 1};          // SI, of the rows
    std::optional<std::array<double, 2>> shown_;  // in their place
    std::array<double, 2> last_{0, 0};            // time and value
    std::vector<Slice> slices_;
};

}  // namespace grainreel
