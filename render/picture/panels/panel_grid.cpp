// Where the panels lie, and how large a metre is (panels.hpp).
#include <algorithm>
#include <cmath>

#include "render/picture/camera/camera_path.hpp"
#include "render/picture/camera/framing.hpp"
#include "render/picture/panels/panels.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double most_unlike = 3;  // if the panels' scales differ by a larger factor, each keeps its own

// The plots of one panel: in rows under its port, or in a column beside it where panels are wide.
enum class PlotsAt { none, below, beside };
struct PlotGrid {
    PlotsAt at = PlotsAt::none;
    int columns = 1, rows = 1, width = 0, height = 0;  // pixels that they take from the port
    int taller = 0;  // pixels by which a plot may be higher than most_upright allows
};

constexpr double most_upright = 0.75;  // greatest height of a plot divided by its width
// The height of the words above and below the curves of a plot, in sizes of minor letters.
constexpr double words_high = 5;
// Pixels: the least height and width of a plot. Its curves need 48 pixels even if the letters are small.
double least_high(double minor) {
    constexpr double usual = 7.5, curves = 48;
    return std::max(usual * minor, words_high * minor + curves);
}
double least_wide(double minor) {
    constexpr double usual = 12;
    return std::max(usual * minor, least_high(minor) / most_upright);
}

// There are no plots where they would be too small or leave too little room for the grains.
PlotGrid plot_grid(const std::vector<Panel>& panels, const Film& film, int width, int height, PlotsAt at) {
    // Shares of a panel: of one plot, and of all plots together.
    constexpr double usual_height = 0.2, usual_width = 0.3, most = 0.45;
    std::size_t most_plots = 0;
    for (const Panel& panel : panels) most_plots = std::max(most_plots, panel.scene.film.shows.plots.size());
    const auto count = static_cast<int>(most_plots);
    const double minor = panel_type(film).minor;
    if (count == 0 || at == PlotsAt::none || width < least_wide(minor)) return {};
    PlotGrid grid{at, 1, count, 0, 0};
    if (at == PlotsAt::beside) {
        grid.width = static_cast<int>(std::max(least_wide(minor), usual_width * width));
        // Beside the port there is height to spare. So the height of words does not count against
        // most_upright there.
        grid.taller = static_cast<int>(words_high * minor);
        return grid.width <= most * width ? grid : PlotGrid();
    }
    grid.columns = std::clamp(static_cast<int>(width / (least_wide(minor))), 1, count);
    grid.rows = (count + grid.columns - 1) / grid.columns;
    grid.height = grid.rows * static_cast<int>(std::max(least_high(minor), usual_height * height));
    return grid.height <= most * height ? grid : PlotGrid();
}

std::vector<Rectangle> places_of(std::size_t count, const PlotGrid& grid, const Rectangle& zone, int gap) {
    std::vector<Rectangle> places;
    if (grid.at == PlotsAt::none) return places;
    const int width = zone.width / grid.columns - gap,
              height = std::min(zone.height / grid.rows - gap,
                                static_cast<int>(most_upright * width) + grid.taller);
    const int y = grid.at == PlotsAt::below ? 0 : (zone.height - grid.rows * (height + gap)) / 2;
    for (int k = 0; k < static_cast<int>(count); ++k)
        places.push_back({zone.x + (k % grid.columns) * (width + gap),
                          zone.y + y + (k / grid.columns) * (height + gap), width, height});
    return places;
}

struct PanelSize {
    int x = 0, width = 0, port = 0;  // pixels; port: the height of the port
};

// Puts the parts of a panel below each other, from y down.
void stack(PanelLayout::Place& place, int y, const PanelSize& size, const WordHeights& words,
           const PlotGrid& grid, std::size_t plots, int gap) {
    const auto next = [&](double height) {
        const Rectangle part{size.x, y, size.width, static_cast<int>(std::ceil(height))};
        y += part.height;
        return part;
    };
    place.caption = next(words.caption);
    place.pace = next(words.pace);
    place.port = next(size.port);
    place.note = next(words.note);
    for (Rectangle* part : {&place.caption, &place.pace, &place.port, &place.note}) part->width -= grid.width;
    const Rectangle below = next(grid.height);
    const Rectangle beside{place.port.x + place.port.width, place.port.y, grid.width, place.port.height};
    place.plots = places_of(plots, grid, grid.at == PlotsAt::below ? below : beside, gap);
    place.foot = next(words.foot);
}

int around_port(const WordHeights& words, const PlotGrid& grid) {
    double height = grid.height;
    for (const double part : {words.caption, words.pace, words.note, words.foot}) height += std::ceil(part);
    return static_cast<int>(height);
}

// A layout that has been tried.
struct Planned {
    PanelLayout layout;
    PlotGrid plots;
};
Planned grid(const std::vector<Panel>& panels, const Film& film, const WordHeights& words, int columns,
             PlotsAt at) {
    const int count = static_cast<int>(panels.size()), rows = (count + columns - 1) / columns;
    const TypeScale type = panel_type(film);
    const int margin = static_cast<int>(type.margin), top = static_cast<int>(std::ceil(words.top)),
              bottom = static_cast<int>(std::ceil(words.bottom));
    const int width = (film.width - (columns + 1) * margin / 2) / columns;
    const int height = (film.height - top - bottom) / rows;
    Planned planned{{}, plot_grid(panels, film, width, height, at)};
    PanelLayout& layout = planned.layout;
    layout.top = {0, 0, film.width, top};
    layout.bottom = {0, film.height - bottom, film.width, bottom};
    const int port = height - around_port(words, planned.plots);
    layout.plots_fit = planned.plots.at == at &&
                       (at != PlotsAt::beside || port >= planned.plots.rows * least_high(type.minor));
    if (width - planned.plots.width < least_panel || port < least_panel || !layout.plots_fit) return planned;
    for (int i = 0; i < count; ++i) {
        const FilmedScene& scene = panels[i].scene;
        const int row = i / columns, in_row = std::min(columns, count - row * columns);
        PanelLayout::Place place;
        // The last row may be shorter; then it stands in the middle.
        const int x = (film.width - in_row * width - (in_row - 1) * margin / 2) / 2 +
                      (i % columns) * (width + margin / 2);
        place.zoom = scene.film.camera.zoom;
        place.row = row;
        stack(place, top + row * height, {x, width, port}, words, planned.plots,
              scene.film.shows.plots.size(), static_cast<int>(type.gap));
        layout.places.push_back(std::move(place));
    }
    return planned;
}

double own_scale(const Panel& panel, const PanelLayout::Place& place) {
    FilmedScene scene = panel.scene;
    scene.film.width = place.port.width;
    scene.film.height = place.port.height;
    return framed_scale(scene, bare_layout(scene.film));
}

// Gives all panels one scale where they can have one. Returns the scale, since grids are compared by it.
double set_scales(const std::vector<Panel>& panels, PanelLayout& layout) {
    if (layout.places.empty()) return 0;
    layout.scale = 0;
    std::vector<double> scales;
    double product = 1;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        scales.push_back(own_scale(panels[i], layout.places[i]));
        product *= scales.back();
    }
    const auto [least, most] = std::minmax_element(scales.begin(), scales.end());
    if (*most > most_unlike * *least) return std::pow(product, 1 / static_cast<double>(scales.size()));
    layout.scale = *least;
    for (std::size_t i = 0; i < scales.size(); ++i) layout.places[i].zoom *= layout.scale / scales[i];
    return layout.scale;
}

// Pixels from the highest to the lowest point that has to be seen in a panel.
double seen_height(const Panel& panel, const PanelLayout::Place& place) {
    FilmedScene scene = panel.scene;
    scene.film.width = place.port.width;
    scene.film.height = place.port.height;
    scene.film.camera.zoom = place.zoom;
    return framed_height(scene, bare_layout(scene.film));
}

// Pixels: the width that a panel's container needs in the middle of its port.
double seen_width(const Panel& panel, const PanelLayout::Place& place) {
    FilmedScene scene = panel.scene;
    scene.film.width = place.port.width;
    scene.film.height = place.port.height;
    scene.film.camera.zoom = place.zoom;
    const View view = frame_container(scene, bare_layout(scene.film));
    double half = 0;
    for (const Vec3& point : framing_points(scene))
        half = std::max(half, std::abs(view.project(point).x() - 0.5 * place.port.width));
    return 2 * half;
}

// Plots beside the ports take the width that the containers do not need.
void widen_plots(const std::vector<Panel>& panels, const Film& film, const PanelLayout& layout,
                 PlotGrid& plots) {
    constexpr double most = 0.45;  // share of a panel
    if (plots.at != PlotsAt::beside) return;
    double needed = least_panel;
    for (std::size_t i = 0; i < panels.size(); ++i)
        needed = std::max(needed, seen_width(panels[i], layout.places[i]));
    const int port = layout.places[0].port.width, panel = port + plots.width;
    const int spare = port - static_cast<int>(needed + 2 * panel_type(film).margin);
    plots.width += std::max(0, std::min(spare, static_cast<int>(most * panel) - plots.width));
}

// Where panels are narrow, takes the room above and below their containers out of the ports. It goes to the
// plots below and to the space around the panels, so that captions and legends stand close to their
// containers.
void close_up(const std::vector<Panel>& panels, const Film& film, const WordHeights& words,
              Planned& planned) {
    constexpr double most_plots = 0.4;  // share of a panel's height
    PanelLayout& layout = planned.layout;
    PlotGrid plots = planned.plots;
    const int gap = static_cast<int>(panel_type(film).gap), rows = layout.places.back().row + 1;
    const int panel = (film.height - layout.top.height - layout.bottom.height) / rows;
    double seen = plots.at == PlotsAt::beside ? plots.rows * least_high(panel_type(film).minor) : 0;
    seen = std::max<double>(seen, least_panel);
    for (std::size_t i = 0; i < panels.size(); ++i)
        seen = std::max(seen, seen_height(panels[i], layout.places[i]));
    const int before = plots.width, all = layout.places[0].port.height;
    widen_plots(panels, film, layout, plots);
    const int port = std::min(all, static_cast<int>(seen + 2 * panel_type(film).margin));
    int spare = all - port;
    if (spare <= 0 && plots.width == before) return;
    if (plots.at == PlotsAt::below) {
        const double widest = static_cast<double>(layout.places[0].port.width) / plots.columns;
        const int most = static_cast<int>(std::min(most_plots * panel, plots.rows * most_upright * widest));
        const int more = std::clamp(most - plots.height, 0, spare);
        plots.height += more;
        spare -= more;
    }
    for (std::size_t i = 0; i < panels.size(); ++i) {
        PanelLayout::Place& place = layout.places[i];
        const int down = rows * spare / 2 - place.row * spare;
        const PanelSize size{place.foot.x, place.foot.width, port};
        stack(place, place.caption.y + down, size, words, plots, panels[i].scene.film.shows.plots.size(),
              gap);
        place.zoom = panels[i].scene.film.camera.zoom;
    }
    set_scales(panels, layout);
}

// The columns, rows and place of plots that make the grains as large as possible.
Planned best_grid(const std::vector<Panel>& panels, const Film& film, const WordHeights& words,
                  const std::vector<PlotsAt>& plots) {
    Planned best;
    double best_value = 0;
    for (int columns = static_cast<int>(panels.size()); columns >= 1; --columns)
        for (const PlotsAt at : plots) {
            Planned planned = grid(panels, film, words, columns, at);
            // Gaps in the grid lower its value a little: four panels stand two by two unless a row makes them
            // larger.
            const auto count = static_cast<double>(panels.size());
            const double full = count / (columns * std::ceil(count / columns));
            const double value = set_scales(panels, planned.layout) * std::pow(full, 0.25);
            if (value <= 1.02 * best_value) continue;  // among equal grids the one with fewer rows is kept
            best_value = value;
            best = std::move(planned);
        }
    return best;
}

}  // namespace

TypeScale panel_type(const Film& film) {
    constexpr double tallest = 1.25;  // height divided by width
    Film less = film;
    less.height = std::min(film.height, static_cast<int>(tallest * film.width));
    return type_scale(less);
}

PanelLayout plan_panels(const std::vector<Panel>& panels, const Film& film, const WordHeights& words) {
    const bool plots = std::any_of(panels.begin(), panels.end(),
                                   [](const Panel& panel) { return !panel.scene.film.shows.plots.empty(); });
    Planned best;
    if (plots) best = best_grid(panels, film, words, {PlotsAt::below, PlotsAt::beside});
    const bool fit = !plots || !best.layout.places.empty();
    if (best.layout.places.empty()) best = best_grid(panels, film, words, {PlotsAt::none});
    if (!best.layout.places.empty()) close_up(panels, film, words, best);
    best.layout.plots_fit = fit;
    return std::move(best.layout);
}

}  // namespace grainreel
