// Which frames of a film the contact sheet keeps and shows, and the page itself.
#include "render/picture/panels/contact_sheet.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {
namespace {

constexpr int page_width = 1920, gap = 16;  // pixels
// Number of tiles kept for each tile shown. Times on the page are then evenly spaced to within an eighth of
// their distance.
constexpr std::size_t kept_for_one = 8;

using Canvas = std::shared_ptr<cairo_surface_t>;

Canvas make_surface(int width, int height) {
    return {cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height), cairo_surface_destroy};
}

// Cairo wants pixels as 0xAARRGGBB, with colours multiplied by alpha.
Canvas surface_of(const Picture& picture) {
    Canvas surface = make_surface(picture.width, picture.height);
    unsigned char* pixels = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    const auto weighed = [](unsigned value, unsigned alpha) { return (value * alpha + 127) / 255; };
    for (int y = 0; y < picture.height; ++y) {
        auto* row = reinterpret_cast<std::uint32_t*>(pixels + static_cast<std::ptrdiff_t>(y) * stride);
        for (int x = 0; x < picture.width; ++x) {
            const std::uint8_t* p = picture.pixel(x, y);
            row[x] = static_cast<std::uint32_t>(p[3]) << 24 | weighed(p[0], p[3]) << 16 |
                     weighed(p[1], p[3]) << 8 | weighed(p[2], p[3]);
        }
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

// The picture that an opaque surface has.
Picture picture_of(cairo_surface_t* surface) {
    cairo_surface_flush(surface);
    const unsigned char* pixels = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    Picture picture(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
    for (int y = 0; y < picture.height; ++y) {
        const auto* row =
            reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::ptrdiff_t>(y) * stride);
        for (int x = 0; x < picture.width; ++x) {
            std::uint8_t* p = picture.pixel(x, y);
            p[0] = static_cast<std::uint8_t>(row[x] >> 16);
            p[1] = static_cast<std::uint8_t>(row[x] >> 8);
            p[2] = static_cast<std::uint8_t>(row[x]);
            p[3] = 255;
        }
    }
    return picture;
}

}  // namespace

ContactSheet::ContactSheet(const Film& film)
    : columns_(film.sheet[0]),
      rows_(film.sheet[1]),
      width_(std::min((page_width - (columns_ + 1) * gap) / columns_, film.width)),
      height_(
          std::max(1, static_cast<int>(std::lround(static_cast<double>(width_) * film.height / film.width)))),
      letters_(std::clamp(width_ / 18.0, 11.0, 26.0)),
      label_(film.word_kinds.time ? static_cast<int>(std::lround(1.6 * letters_)) : 0),
      background_(make_palette(film.background).background),
      ink_(make_palette(film.background).ink) {}

ContactSheet::Tile ContactSheet::tile(const Picture& picture, double time) const {
    const Canvas full = surface_of(picture);
    Canvas small = make_surface(width_, height_);
    const CairoContext on(cairo_create(small.get()));
    set_colour(on.get(), background_);
    cairo_paint(on.get());
    cairo_scale(on.get(), static_cast<double>(width_) / picture.width,
                static_cast<double>(height_) / picture.height);
    cairo_set_source_surface(on.get(), full.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(on.get()), CAIRO_FILTER_GOOD);
    cairo_pattern_set_extend(cairo_get_source(on.get()), CAIRO_EXTEND_PAD);
    cairo_paint(on.get());
    return {time, small};
}

void ContactSheet::add(const Picture& picture, double time) {
    last_time_ = time;
    const bool later = kept_.empty() || time > kept_.back().time;
    if (!later || (!kept_.empty() && time < kept_.back().time + apart_)) return;
    kept_.push_back(tile(picture, time));
    const std::size_t room = kept_for_one * static_cast<std::size_t>(columns_) * rows_;
    if (kept_.size() <= room) return;
    const double all = kept_.back().time - kept_.front().time;
    apart_ = std::max(2 * apart_, 2 * all / static_cast<double>(room));
    std::vector<Tile> left;
    for (Tile& kept : kept_)
        if (left.empty() || kept.time >= left.back().time + apart_) left.push_back(std::move(kept));
    kept_ = std::move(left);
}

// Chooses the kept tiles nearest to evenly spaced times, each of them once. The first and the last frame are
// among them.
std::vector<ContactSheet::Tile> ContactSheet::chosen(const Picture& last) const {
    std::vector<Tile> tiles = kept_;
    if (tiles.empty()) return tiles;
    if (last_time_ > tiles.back().time) tiles.push_back(tile(last, last_time_));
    const std::size_t wanted = std::min(tiles.size(), static_cast<std::size_t>(columns_) * rows_);
    const double first = tiles.front().time, end = tiles.back().time;
    std::vector<Tile> result;
    std::size_t next = 0;
    for (std::size_t i = 0; i < wanted; ++i) {
        const double share = wanted == 1 ? 1 : static_cast<double>(i) / static_cast<double>(wanted - 1);
        const double time = first + share * (end - first);
        const std::size_t most = tiles.size() - (wanted - i);  // leaves one tile for each place still to fill
        while (next < most && std::abs(tiles[next + 1].time - time) <= std::abs(tiles[next].time - time))
            ++next;
        result.push_back(tiles[next++]);
    }
    return result;
}

Picture ContactSheet::draw(const Picture& last) const {
    const Canvas page = make_surface(columns_ * (width_ + gap) + gap, rows_ * (height_ + label_ + gap) + gap);
    const CairoContext on(cairo_create(page.get()));
    set_colour(on.get(), background_);
    cairo_paint(on.get());
    const std::vector<Tile> tiles = chosen(last);
    // Enough decimals to show different times on neighbouring tiles, and the mean distance of times to two
    // figures.
    double between = tiles.size() > 1
                         ? (tiles.back().time - tiles.front().time) / static_cast<double>(tiles.size() - 1)
                         : 1;
    for (std::size_t i = 1; i < tiles.size(); ++i)
        between = std::min(between, 10 * (tiles[i].time - tiles[i - 1].time));
    const int decimals =
        between > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(between))), 0, 6) : 3;
    for (std::size_t i = 0; i < tiles.size(); ++i) draw_tile(on.get(), tiles[i], i, decimals);
    return picture_of(page.get());
}

void ContactSheet::draw_tile(cairo_t* on, const Tile& tile, std::size_t place, int decimals) const {
    const int column = static_cast<int>(place) % columns_, row = static_cast<int>(place) / columns_;
    const double x = gap + column * (width_ + gap), y = gap + row * (height_ + label_ + gap);
    cairo_set_source_surface(on, tile.picture.get(), x, y);
    cairo_paint(on);
    // A thin line around the tile, for films whose background is the page's colour.
    set_colour(on, ink_, 0.25);
    cairo_set_line_width(on, 1);
    cairo_rectangle(on, x - 0.5, y - 0.5, width_ + 1, height_ + 1);
    cairo_stroke(on);
    if (label_ == 0) return;
    draw_text(on, x, y + height_ + 0.15 * letters_, fmt::format("t = {:.{}f} s", tile.time, decimals),
              {letters_, false}, ink_);
}

}  // namespace grainreel
