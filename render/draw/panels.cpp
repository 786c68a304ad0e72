#include "render/draw/panels.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "render/draw/captions.hpp"
#include "render/draw/container_drawing.hpp"

namespace grainreel {
namespace {

constexpr double most_unlike = 3;  // scales of the panels, beyond which each has its own

bool same_species(const Species& a, const Species& b) {
    return a.name == b.name && a.count == b.count && a.diameter == b.diameter && a.colour == b.colour;
}

bool close(double a, double b) {
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool same_clock(const Drive& a, const Drive& b) {
    return close(a.frequency, b.frequency) && a.phase == b.phase && a.ramp == b.ramp;
}

double g_level(const Scene& scene) {
    return scene.drive.present ? scene.drive.g_level(scene.gravity.norm()) : 0;
}

bool all_alike(const std::vector<std::string>& words) {
    return std::all_of(words.begin(), words.end(), [&](const std::string& w) { return w == words.front(); });
}

std::vector<std::string> drive_captions(const std::vector<Scene>& scenes) {
    const Scene& first = scenes.front();
    bool frequency = false, level = false, amplitude = false;
    for (const Scene& scene : scenes) {
        frequency |= !close(scene.drive.frequency, first.drive.frequency);
        level |= std::isfinite(g_level(scene)) && !close(g_level(scene), g_level(first));
        amplitude |= !close(scene.drive.amplitude, first.drive.amplitude);
    }
    std::vector<std::string> captions;
    for (const Scene& scene : scenes) {
        std::vector<std::string> parts;
        if (frequency) parts.push_back("f = " + frequency_text(scene.drive.frequency));
        if (level) parts.push_back(fmt::format("Γ = {:.3g}", g_level(scene)));
        if (amplitude && !level && !frequency) parts.push_back("a = " + length_text(scene.drive.amplitude));
        captions.push_back(scene.drive.present ? fmt::format("{}", fmt::join(parts, ", ")) : "no vibration");
    }
    return captions;
}

// What a grid of these columns gives: ports, and the scales they would have by themselves.
PanelLayout grid(const std::vector<Panel>& panels, const Film& film, const WordHeights& words, int columns) {
    const int count = static_cast<int>(panels.size()), rows = (count + columns - 1) / columns;
    const int margin = static_cast<int>(type_scale(film).margin);
    const int top = static_cast<int>(std::ceil(words.top)),
              bottom = static_cast<int>(std::ceil(words.bottom));
    const int caption = static_cast<int>(std::ceil(words.caption)),
              note = static_cast<int>(std::ceil(words.note)), foot = static_cast<int>(std::ceil(words.foot));
    PanelLayout layout;
    layout.top = {0, 0, film.width, top};
    layout.bottom = {0, film.height - bottom, film.width, bottom};
    const int width = (film.width - (columns + 1) * margin / 2) / columns;
    const int height = (film.height - top - bottom) / rows;
    const int port = height - caption - note - foot;
    if (width < least_panel || port < least_panel) return layout;
    for (int i = 0; i < count; ++i) {
        const int row = i / columns, in_row = std::min(columns, count - row * columns);
        // The last row may be shorter: it stands in the middle.
        const int x = (film.width - in_row * width - (in_row - 1) * margin / 2) / 2 +
                      (i % columns) * (width + margin / 2);
        const int y = top + row * height;
        layout.places.push_back({{x, y, width, caption},
                                 {x, y + caption, width, port},
                                 {x, y + caption + port, width, note},
                                 {x, y + caption + port + note, width, foot},
                                 panels[static_cast<std::size_t>(i)].scene.film.camera.zoom,
                                 row});
    }
    return layout;
}

double own_scale(const Panel& panel, const PanelLayout::Place& place) {
    Scene scene = panel.scene;
    scene.film.width = place.port.width;
    scene.film.height = place.port.height;
    return frame_container(scene, bare_layout(scene.film)).pixels_per_metre(framed_middle(scene));
}

// Gives all panels one scale where they can have one; returns what the grid is worth.
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

// Pixels, from the highest to the lowest point that has to be seen.
double seen_height(const Panel& panel, const PanelLayout::Place& place) {
    Scene scene = panel.scene;
    scene.film.width = place.port.width;
    scene.film.height = place.port.height;
    scene.film.camera.zoom = place.zoom;
    const View view = frame_container(scene, bare_layout(scene.film));
    double top = place.port.height, bottom = 0;
    for (const Vec3& point : framing_points(scene)) {
        const double y = view.project(point).y();
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    }
    return bottom - top;
}

// Where panels are narrow, the room above and below their containers goes out of the ports, so that captions
// and legends stand close to what they speak of.
void close_up(const std::vector<Panel>& panels, const Film& film, PanelLayout& layout) {
    double seen = least_panel;
    for (std::size_t i = 0; i < panels.size(); ++i)
        seen = std::max(seen, seen_height(panels[i], layout.places[i]));
    const int height = static_cast<int>(seen + 2 * type_scale(film).margin);
    const int spare = layout.places[0].port.height - height, rows = layout.places.back().row + 1;
    if (spare <= 0) return;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        PanelLayout::Place& place = layout.places[i];
        const int down = rows * spare / 2 - place.row * spare;
        place.caption.y += down;
        place.port.y += down;
        place.port.height = height;
        place.note.y = place.port.y + height;
        place.foot.y = place.note.y + place.note.height;
        place.zoom = panels[i].scene.film.camera.zoom;
    }
    set_scales(panels, layout);
}

}  // namespace

Common common_of(const std::vector<Panel>& panels) {
    Common common;
    const Scene& first = panels.front().scene;
    for (const Panel& panel : panels) {
        const Scene& scene = panel.scene;
        const bool driven = scene.drive.present && first.drive.present;
        common.clock = common.clock && driven && same_clock(scene.drive, first.drive);
        common.frequency = common.frequency && driven && close(scene.drive.frequency, first.drive.frequency);
        common.g_level = common.g_level && driven && std::isfinite(g_level(scene)) &&
                         close(g_level(scene), g_level(first));
        common.amplitude = common.amplitude && driven && close(scene.drive.amplitude, first.drive.amplitude);
        common.colours = common.colours && scene.film.shows.colour == first.film.shows.colour;
        common.exaggerated = common.exaggerated && scene.film.exaggerate == first.film.exaggerate;
        common.species =
            common.species && std::equal(scene.species.begin(), scene.species.end(), first.species.begin(),
                                         first.species.end(), same_species);
    }
    return common;
}

void share_colours(std::vector<Panel>& panels) {
    const auto colour = [](Panel& panel) -> GrainColouring& { return panel.scene.film.shows.colour; };
    GrainColouring common = colour(panels.front());
    for (Panel& panel : panels) {
        const GrainColouring& own = colour(panel);
        if (own.fixed || own.by != common.by || own.map != common.map || own.layers != common.layers) return;
        if (own.range[1] - own.range[0] > common.range[1] - common.range[0]) common.unit = own.unit;
        common.range = {std::min(common.range[0], own.range[0]), std::max(common.range[1], own.range[1])};
    }
    for (Panel& panel : panels) colour(panel) = common;
}

std::vector<std::string> captions_of(const std::vector<Scene>& scenes) {
    std::vector<std::string> titles, names;
    for (const Scene& scene : scenes) {
        titles.push_back(scene.film.title.empty() ? scene.title : scene.film.title);
        names.push_back(scene.name);
    }
    const auto differ = [](const std::vector<std::string>& words) {
        return std::set<std::string>(words.begin(), words.end()).size() == words.size();
    };
    const std::vector<std::string> drives = drive_captions(scenes);
    if (differ(drives)) return drives;
    std::vector<std::string> both = titles;
    for (std::size_t i = 0; i < both.size() && !all_alike(drives); ++i) both[i] += ": " + drives[i];
    if (differ(both)) return both;
    if (differ(names)) return names;
    for (std::size_t i = 0; i < both.size(); ++i) both[i] = fmt::format("{}, {}", i + 1, names[i]);
    return both;
}

PanelLayout plan_panels(const std::vector<Panel>& panels, const Film& film, const WordHeights& words) {
    PanelLayout best;
    double best_value = 0;
    for (int columns = static_cast<int>(panels.size()); columns >= 1; --columns) {
        PanelLayout layout = grid(panels, film, words, columns);
        // Gaps in the grid cost a little: four panels stand two by two unless a row makes them larger.
        const auto count = static_cast<double>(panels.size());
        const double full = count / (columns * std::ceil(count / columns));
        const double value = set_scales(panels, layout) * std::pow(full, 0.25);
        if (value <= 1.02 * best_value) continue;  // among equals the one with fewer rows
        best_value = value;
        best = std::move(layout);
    }
    if (!best.places.empty()) close_up(panels, film, best);
    return best;
}

}  // namespace grainreel
