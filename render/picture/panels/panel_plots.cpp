#include "render/picture/panels/panel_plots.hpp"

#include <algorithm>

#include "engine/measure/columns.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// Alike for plots whose values can be compared.
std::string quantity_of(const FilmPlot& plot) {
    return plot.is_profile() ? std::to_string(static_cast<int>(plot.profile)) + (plot.period ? "p" : "")
                             : plot.column;
}

// SI: of all panels, so that they tell the quantity in one unit.
double expected_of(const std::vector<Panel>& panels, const std::string& quantity) {
    double largest = 0;
    for (const Panel& panel : panels)
        for (const FilmPlot& plot : panel.scene.film.shows.plots)
            if (!plot.is_profile() && quantity_of(plot) == quantity)
                largest = std::max(largest, axis_of_column(panel.scene, plot.column).expected);
    return largest;
}

}  // namespace

PanelPlots::PanelPlots(const std::vector<Panel>& panels, const PanelLayout& layout, const TypeScale& type,
                       const Palette& palette) {
    TypeScale small = type;
    small.main = type.minor;
    double end = 0;
    for (const Panel& panel : panels) end = std::max(end, panel.scene.run.duration);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const std::vector<Rectangle>& places = layout.places[i].plots;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const FilmedScene& scene = panels[i].scene;
            const FilmPlot& plot = scene.film.shows.plots[k];
            plots_.push_back({make_side_plot(scene, plot, places[k], end, small, palette,
                                             expected_of(panels, quantity_of(plot))),
                              quantity_of(plot), places[k], i});
        }
    }
}

bool PanelPlots::take(const std::vector<FramePtr>& frames) {
    bool changed = false;
    for (Placed& placed : plots_) changed |= placed.plot->take(*frames[placed.panel]);
    if (changed) share_limits();
    return changed;
}

void PanelPlots::share_limits() {
    for (Placed& placed : plots_) {
        std::optional<std::array<double, 2>> all;
        for (const Placed& other : plots_) {
            const auto own = other.plot->limits();
            if (other.quantity != placed.quantity || !own) continue;
            all = all ? std::array{std::min((*all)[0], (*own)[0]), std::max((*all)[1], (*own)[1])} : *own;
        }
        if (all) placed.plot->show(*all);
    }
}

}  // namespace grainreel
