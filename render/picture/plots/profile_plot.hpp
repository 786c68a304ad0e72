// Plots a profile at the picture's moment, beside the grains: values against height, which is then the
// upright axis, or against width. Profiles of species have the species' colours; all other profiles show a
// mean velocity.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/fields/coarse_graining.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/plots/axes.hpp"
#include "render/picture/plots/plot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class ProfilePlot final : public SidePlot {
  public:
    // width, height: pixels.
    ProfilePlot(const FilmedScene& scene, const FilmPlot& plot, int width, int height, const TypeScale& type,
                const Palette& palette);

    // The axes stay as they are; only the curves follow the frames.
    bool take(const Shot& frame) override;
    std::optional<std::array<double, 2>> limits() const override { return range_; }
    void show(const std::array<double, 2>& limits) override { range_ = limits; }
    void draw(cairo_t* on, int x, int y) override;

    // Where a value at a place (m) lies; pixels from the plot's corner.
    std::array<double, 2> pixel_of(double value, double place) const;

  private:
    struct Axis {
        std::array<double, 2> span;  // SI
        std::string name;            // name of the quantity with its unit
        double unit = 1;             // SI
    };
    Axis place_axis() const;
    Axis value_axis() const;
    void draw_standing_axis(cairo_t* on, const Axis& axis) const;
    void draw_lying_axis(cairo_t* on, const Axis& axis) const;
    void draw_curve(cairo_t* on, const std::vector<double>& values, const Colour& colour) const;

    const FilmedScene scene_;
    const FilmPlot plot_;
    const int width_, height_;
    const TypeScale type_;
    const Palette palette_;
    std::array<double, 2> places_;        // m, of the axis of places
    std::array<double, 2> range_;         // SI, of the axis of values
    double left_, right_, top_, bottom_;  // pixels, of the box
    CoarseGraining sums_;
    std::vector<std::vector<double>> curves_;  // one value for each place
};

}  // namespace grainreel
