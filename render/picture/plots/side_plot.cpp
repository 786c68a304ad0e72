#include "render/picture/plots/side_plot.hpp"

#include <algorithm>

#include "render/picture/plots/plot.hpp"
#include "render/picture/plots/profile_plot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

std::unique_ptr<SidePlot> make_side_plot(const FilmedScene& scene, const FilmPlot& plot,
                                         const Rectangle& place, double end, const TypeScale& type,
                                         const Palette& palette, double expected) {
    if (plot.is_profile())
        return std::make_unique<ProfilePlot>(scene, plot, place.width, place.height, type, palette);
    PlotFrame frame = plot_frame(scene, plot);
    frame.time[1] = end;
    frame.expected = std::max(frame.expected, expected);
    frame.width = place.width;
    frame.height = place.height;
    return std::make_unique<Plot>(frame, type, palette);
}

}  // namespace grainreel
