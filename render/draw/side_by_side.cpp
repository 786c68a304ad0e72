#include "render/draw/side_by_side.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/base/error.hpp"
#include "render/draw/cairo_surface.hpp"
#include "render/draw/captions.hpp"
#include "render/draw/container_drawing.hpp"
#include "render/draw/panel_words.hpp"
#include "render/draw/renderer.hpp"

namespace grainreel {
namespace {

double title_height(const Writer& measure, const Film& film) {
    if (film.title.empty()) return 0.5 * measure.type.margin;
    const double inner = film.width - 2 * measure.type.margin;
    return measure.write(0, 0, film.title, measure.title(), measure.palette.ink, inner, 2).height +
           measure.type.margin;
}

double caption_height(const Writer& measure, const std::vector<Panel>& panels, double width) {
    double height = 0;
    for (const Panel& panel : panels) {
        if (panel.caption.empty()) continue;
        height = std::max(
            height,
            measure.write(0, 0, panel.caption, measure.strong(), measure.palette.ink, width, 2).height);
    }
    return height > 0 ? height + 0.3 * measure.type.gap : 0;
}

void write_in_middle(const Writer& on, const std::string& text, const TextStyle& style, double y,
                     double width) {
    const Writer measure{nullptr, on.type, on.palette};
    const double wide = measure.write(0, 0, text, style, on.palette.ink, width, 2).width;
    on.write(std::max(0.0, 0.5 * (width - wide)), y, text, style, on.palette.ink, width, 2);
}

Scene panel_scene(const Panel& panel, const PanelLayout::Place& place, const Film& film) {
    Scene scene = panel.scene;
    scene.film.width = place.port.width;
    scene.film.height = place.port.height;
    scene.film.background = film.background;
    for (CameraKey& key : scene.film.camera.keys)
        if (key.zoom) *key.zoom *= place.zoom / scene.film.camera.zoom;
    scene.film.camera.zoom = place.zoom;
    return scene;
}

Rectangle whole_pixels(const WordBlock& block, const Rectangle& within) {
    const int x = static_cast<int>(std::floor(block.x)), y = static_cast<int>(std::floor(block.y));
    const int width = static_cast<int>(std::ceil(block.size.width)) + 3;
    const int height = static_cast<int>(std::ceil(block.size.height)) + 3;
    return {within.x + x, within.y + y, std::min(width, within.width - x),
            std::min(height, within.height - y)};
}

}  // namespace

PanelLayout layout_of(const std::vector<Panel>& panels, const Film& film) {
    const TypeScale type = type_scale(film);
    const Palette palette = make_palette(film.background);
    const Writer measure{nullptr, type, palette};
    const Common common = common_of(panels);
    WordHeights words;
    words.top = title_height(measure, film);
    words.foot = foot_height(measure, panels, common, false);
    std::vector<WordBlock> blocks = common_blocks(measure, panels, common, 1, film.width);
    words.bottom = flow(blocks, type, film.width);
    // Twice, since captions wrap at the width that panels get.
    words.caption = caption_height(measure, panels, 0);
    PanelLayout layout = plan_panels(panels, film, words);
    if (layout.places.empty()) return layout;
    words.caption = caption_height(measure, panels, layout.places[0].caption.width);
    words.note = notes_height(measure, panels, layout.places[0].caption.width);
    layout = plan_panels(panels, film, words);
    if (layout.scale > 0 || layout.places.empty()) return layout;
    words.foot = foot_height(measure, panels, common, true);
    return plan_panels(panels, film, words);
}

struct SideBySide::Impl {
    Impl(const std::vector<Panel>& panels, const Film& film, int raster_threads, gl::Provider provider);

    void write_still_words(const std::vector<Panel>& panels, const Film& film);
    void write_changing_words(const Frame& frame, const std::string& playback);
    void write_note(std::size_t panel, const Frame& frame);

    Palette palette;
    TypeScale type;
    Common common;
    PanelLayout layout;
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<WordBlock> blocks;
    std::vector<Scene> scenes;       // of the panels
    std::vector<std::string> notes;  // that are in the picture now
    Picture picture;
};

SideBySide::Impl::Impl(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                       gl::Provider provider)
    : palette(make_palette(film.background)),
      type(type_scale(film)),
      common(common_of(panels)),
      layout(layout_of(panels, film)),
      picture(film.width, film.height) {
    GRAINREEL_CHECK(layout.places.size() == panels.size());
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const Scene scene = panel_scene(panels[i], layout.places[i], film);
        scenes.push_back(scene);
        renderers.push_back(
            std::make_unique<Renderer>(scene, bare_layout(scene.film), raster_threads, provider));
    }
    const Writer measure{nullptr, type, palette};
    blocks = common_blocks(measure, panels, common, layout.scale, film.width);
    flow(blocks, type, film.width);
    write_still_words(panels, film);
}

void SideBySide::Impl::write_still_words(const std::vector<Panel>& panels, const Film& film) {
    const Rectangle whole{0, 0, film.width, film.height};
    copy_surface(blank_surface(whole, palette.background).get(), whole, picture);
    const auto on_part = [&](const Rectangle& part, const auto& write) {
        if (part.width <= 0 || part.height <= 0) return;
        const CairoSurface surface = blank_surface(part, palette.background);
        const CairoContext on(cairo_create(surface.get()));
        write(Writer{on.get(), type, palette});
        copy_surface(surface.get(), part, picture);
    };
    on_part(layout.top, [&](const Writer& on) {
        if (!film.title.empty()) write_in_middle(on, film.title, on.title(), 0.6 * type.margin, film.width);
    });
    on_part(layout.bottom, [&](const Writer& on) {
        for (const WordBlock& block : blocks)
            if (!block.changes) block.draw(on, block.x, block.y, Frame(), "");
    });
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const PanelLayout::Place& place = layout.places[i];
        on_part(place.caption, [&](const Writer& on) {
            write_in_middle(on, panels[i].caption, on.strong(), 0, place.caption.width);
        });
        const Scene scene = panel_scene(panels[i], place, film);
        const double own =
            frame_container(scene, bare_layout(scene.film)).pixels_per_metre(framed_middle(scene));
        on_part(place.foot, [&](const Writer& on) {
            draw_foot(on, panels[i], common, layout.scale > 0 ? 0 : own, place.foot.width);
        });
    }
}

void SideBySide::Impl::write_changing_words(const Frame& frame, const std::string& playback) {
    for (const WordBlock& block : blocks) {
        if (!block.changes) continue;
        const Rectangle part = whole_pixels(block, layout.bottom);
        if (part.width <= 0 || part.height <= 0) continue;
        const CairoSurface surface = blank_surface(part, palette.background);
        const CairoContext on(cairo_create(surface.get()));
        block.draw({on.get(), type, palette}, block.x - std::floor(block.x), block.y - std::floor(block.y),
                   frame, playback);
        copy_surface(surface.get(), part, picture);
    }
}

void SideBySide::Impl::write_note(std::size_t panel, const Frame& frame) {
    const Rectangle& part = layout.places[panel].note;
    notes.resize(layout.places.size());
    std::string note = note_text(scenes[panel], frame);
    if (part.height <= 0 || note == notes[panel]) return;
    const CairoSurface surface = blank_surface(part, palette.background);
    const CairoContext on(cairo_create(surface.get()));
    const Writer writer{on.get(), type, palette}, measure{nullptr, type, palette};
    // Where the longest note stands in the middle, so that words do not move with their values.
    const auto width_of = [&](const std::string& text) {
        return note_block(measure, text, 0, 0, part.width - 2).width;
    };
    const double x = 0.5 * (part.width - std::max(width_of(longest_note(scenes[panel])), width_of(note)));
    note_block(writer, note, std::max(1.0, x), 0, part.width - 2);
    copy_surface(surface.get(), part, picture);
    notes[panel] = std::move(note);
}

SideBySide::SideBySide(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                       gl::Provider provider)
    : impl_(std::make_unique<Impl>(panels, film, raster_threads, provider)) {}

SideBySide::~SideBySide() = default;

const Picture& SideBySide::draw(const std::vector<FramePtr>& frames, const std::string& playback,
                                std::size_t clock, double film_time) {
    Impl& m = *impl_;
    GRAINREEL_CHECK(frames.size() == m.renderers.size() && clock < frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Picture& panel = m.renderers[i]->draw(*frames[i], "", film_time);
        const Rectangle& port = m.layout.places[i].port;
        for (int y = 0; y < port.height; ++y)
            std::memcpy(m.picture.pixel(port.x, port.y + y), panel.pixel(0, y),
                        static_cast<std::size_t>(port.width) * 4);
        m.write_note(i, *frames[i]);
    }
    m.write_changing_words(*frames[clock], playback);
    return m.picture;
}

const PanelLayout& SideBySide::layout() const {
    return impl_->layout;
}
std::string SideBySide::gl_description() const {
    return impl_->renderers.front()->gl_description();
}
std::string SideBySide::gl_note() const {
    return impl_->renderers.front()->gl_note();
}

}  // namespace grainreel
