// Texts by Pango, surfaces of Cairo, and the halos and plates that words stand on. A change of fonts or sizes
// here changes every picture with words.
#include "render/picture/base/cairo_text.hpp"

#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>
#include <pango/pangofc-fontmap.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

#include "engine/base/system/own_files.hpp"
#include "render/picture/gl/addresses.hpp"

namespace grainreel {

namespace {

struct Unref {
    void operator()(gpointer object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

struct FreeOptions {
    void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};

struct DestroyConfig {
    void operator()(FcConfig* config) const { FcConfigDestroy(config); }
};
using Config = std::unique_ptr<FcConfig, DestroyConfig>;

// Where the two font files may be: in the archive that the program was unpacked from, or where distributions
// keep them.
std::vector<std::string> font_folders() {
    std::vector<std::string> folders{"/usr/share/fonts/truetype/dejavu/",
                                     "/usr/share/fonts/dejavu-sans-fonts/", "/usr/share/fonts/TTF/",
                                     "/usr/share/fonts/dejavu/"};
    if (!own_files().empty()) folders.insert(folders.begin(), own_files().string() + "/fonts/");
    return folders;
}

// The two font files that all words are written with. Null when they are not there.
Config own_fonts() {
    for (const std::string& folder : font_folders()) {
        Config config(FcConfigCreate());
        const auto add = [&](const char* name) {
            const std::string file = folder + name;
            return FcConfigAppFontAddFile(config.get(), reinterpret_cast<const FcChar8*>(file.c_str())) ==
                   FcTrue;
        };
        if (add("DejaVuSans.ttf") && add("DejaVuSans-Bold.ttf")) return config;
    }
    return nullptr;
}

// Pango reads all fonts of the system whenever it makes a map, unless the process has a configuration of its
// own. That takes time, and it complains where no folder for caches can be written.
void use_as_configuration_of_the_process(FcConfig* config) {
    static std::once_flag once;
    std::call_once(once, [config] { FcConfigSetCurrent(config); });
}

// Each thread has one context, since threads cannot share font maps, and making one costs more than writing a
// word. own: the context has only the two font files, so that words do not depend on what else is installed;
// otherwise it has all fonts of the system.
PangoContext* make_context(bool own) {
    need_addresses(kAddressesOfFonts);
    Config config = own_fonts();
    if (config) use_as_configuration_of_the_process(config.get());
    if (!own || !config) config.reset(FcInitLoadConfigAndFonts());
    const std::unique_ptr<PangoFontMap, Unref> map(
        pango_cairo_font_map_new_for_font_type(CAIRO_FONT_TYPE_FT));
    if (config) pango_fc_font_map_set_config(PANGO_FC_FONT_MAP(map.get()), config.get());
    PangoContext* made = pango_font_map_create_context(map.get());
    const std::unique_ptr<cairo_font_options_t, FreeOptions> options(cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(made, options.get());
    pango_context_set_round_glyph_positions(made, FALSE);
    return made;
}
using TextContext = std::unique_ptr<PangoContext, Unref>;
PangoContext* own_context() {
    thread_local const TextContext context(make_context(true));
    return context.get();
}
PangoContext* system_context() {
    thread_local const TextContext context(make_context(false));
    return context.get();
}

Layout layout_in(PangoContext* context, const std::string& text, const TextStyle& style, double wrap,
                 int lines) {
    Layout layout(pango_layout_new(context));
    PangoFontDescription* font = pango_font_description_new();
    pango_font_description_set_family(font, "DejaVu Sans");
    pango_font_description_set_weight(font, style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(font, style.size * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font);
    pango_font_description_free(font);
    pango_layout_set_text(layout.get(), text.c_str(), static_cast<int>(text.size()));
    if (style.centred) pango_layout_set_alignment(layout.get(), PANGO_ALIGN_CENTER);
    if (wrap > 0) {
        pango_layout_set_width(layout.get(), static_cast<int>(wrap * PANGO_SCALE));
        pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
        pango_layout_set_height(layout.get(), -lines);
        pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_END);
    }
    return layout;
}

constexpr double least_shrink = 0.7;  // letters shrink to this share of their size before a word breaks

// The size of letters at which the longest word fits the lines, if that is not much smaller than the style's.
double size_for_words(const std::string& text, const TextStyle& style, double wrap) {
    const double longest = longest_word(text, style);
    if (wrap <= 0 || longest <= wrap || longest * least_shrink > wrap) return style.size;
    return 0.999 * style.size * wrap / longest;
}

// Texts with letters that the two font files lack, such as a title in Chinese, are written with the system's
// fonts.
Layout make_layout(const std::string& text, const TextStyle& style, double wrap, int lines) {
    Layout layout = layout_in(own_context(), text, style, wrap, lines);
    if (pango_layout_get_unknown_glyphs_count(layout.get()) == 0) return layout;
    return layout_in(system_context(), text, style, wrap, lines);
}

Layout make_wrapped(const std::string& text, const TextStyle& style, double wrap, int lines) {
    if (wrap <= 0) return make_layout(text, style, 0, 1);
    TextStyle fitting = style;
    fitting.size = size_for_words(text, style, wrap);
    return make_layout(text, fitting, wrap, lines);
}

// Letters are filled outlines, because Cairo before 1.18 moves letters to whole pixels and later ones do not:
// so a picture has the same words with each of them. Fonts of the system may have letters that are pictures,
// without an outline.
bool has_outlines(PangoLayout* layout) {
    static const bool fonts_are_there = own_fonts() != nullptr;
    return fonts_are_there && pango_layout_get_context(layout) == own_context();
}

TextSize size_of(PangoLayout* layout) {
    PangoRectangle logical;
    pango_layout_get_extents(layout, nullptr, &logical);
    return {static_cast<double>(logical.width) / PANGO_SCALE,
            static_cast<double>(logical.height) / PANGO_SCALE};
}

}  // namespace

bool has_fonts_for(const std::string& text) {
    const TextStyle style;
    return pango_layout_get_unknown_glyphs_count(make_layout(text, style, 0, 1).get()) == 0;
}

double longest_word(const std::string& text, const TextStyle& style) {
    double longest = 0;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        longest = std::max(longest, measure_text(text.substr(from, to - from), style).width);
        from = to + 1;
    }
    return longest;
}

// A layout of words is chosen among many, which measure the same texts.
TextSize measure_text(const std::string& text, const TextStyle& style, double wrap, int lines) {
    constexpr std::size_t kMost = 4096;
    using Measured = std::tuple<std::string, double, bool, bool, double, int>;
    thread_local std::map<Measured, TextSize> measured;
    Measured key{text, style.size, style.bold, style.centred, wrap, lines};
    if (const auto known = measured.find(key); known != measured.end()) return known->second;
    if (measured.size() >= kMost) measured.clear();
    return measured.emplace(std::move(key), size_of(make_wrapped(text, style, wrap, lines).get()))
        .first->second;
}

bool keeps_text(cairo_t* on) {
    return cairo_surface_get_type(cairo_get_target(on)) == CAIRO_SURFACE_TYPE_PDF;
}

TextSize draw_text(cairo_t* on, double x, double y, const std::string& text, const TextStyle& style,
                   const Colour& colour, double wrap, int lines) {
    const Layout layout = make_wrapped(text, style, wrap, lines);
    set_colour(on, colour);
    cairo_new_path(on);
    cairo_move_to(on, x, y);
    if (has_outlines(layout.get()) && !keeps_text(on)) {
        pango_cairo_layout_path(on, layout.get());
        cairo_fill(on);
    } else {
        pango_cairo_show_layout(on, layout.get());
    }
    return size_of(layout.get());
}

namespace {

// A row of pixels: 0xAARRGGBB, multiplied by alpha.
const std::uint32_t* surface_row(cairo_surface_t* surface, int y) {
    const unsigned char* pixels = cairo_image_surface_get_data(surface);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
    return reinterpret_cast<const std::uint32_t*>(pixels + static_cast<std::size_t>(y) * stride);
}

}  // namespace

void set_colour(cairo_t* on, const Colour& colour, double alpha) {
    cairo_set_source_rgba(on, colour.red, colour.green, colour.blue, alpha);
}

void draw_line(cairo_t* on, double x0, double y0, double x1, double y1) {
    cairo_move_to(on, x0, y0);
    cairo_line_to(on, x1, y1);
    cairo_stroke(on);
}

CairoSurface blank_surface(const Rectangle& part, const Colour& colour, double alpha) {
    CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, part.width, part.height));
    const CairoContext on(cairo_create(surface.get()));
    fill_surface(on.get(), colour, alpha);
    return surface;
}

void fill_surface(cairo_t* on, const Colour& colour, double alpha) {
    cairo_set_operator(on, CAIRO_OPERATOR_SOURCE);
    set_colour(on, colour, alpha);
    cairo_paint(on);
    cairo_set_operator(on, CAIRO_OPERATOR_OVER);
}

void copy_surface(cairo_surface_t* from, const Rectangle& to, Picture& picture) {
    copy_part(from, {0, 0, to.width, to.height}, to.x, to.y, picture);
}

void copy_part(cairo_surface_t* from, const Rectangle& part, int x, int y, Picture& picture) {
    cairo_surface_flush(from);
    for (int j = part.y; j < part.y + part.height; ++j) {
        const std::uint32_t* row = surface_row(from, j);
        std::uint8_t* out = picture.pixel(x + part.x, y + j);
        for (int i = part.x; i < part.x + part.width; ++i, out += 4) {
            out[0] = static_cast<std::uint8_t>(row[i] >> 16);
            out[1] = static_cast<std::uint8_t>(row[i] >> 8);
            out[2] = static_cast<std::uint8_t>(row[i]);
            out[3] = static_cast<std::uint8_t>(row[i] >> 24);
        }
    }
    divide_by_alpha(picture, {x + part.x, y + part.y, part.width, part.height});
}

namespace {

// How strong the halo of one pixel is at each pixel around it, 0 to 1.
struct Stamp {
    int reach = 0;
    std::vector<float> strength;  // rows of 2 reach + 1 numbers
};

Stamp make_stamp(double reach) {
    constexpr double kFade = 1.2;  // pixels over which the halo fades out
    Stamp stamp;
    stamp.reach = static_cast<int>(std::ceil(reach + 0.5 * kFade));
    for (int y = -stamp.reach; y <= stamp.reach; ++y)
        for (int x = -stamp.reach; x <= stamp.reach; ++x) {
            const double inside = reach + 0.5 * kFade - std::hypot(x, y);
            stamp.strength.push_back(static_cast<float>(std::clamp(inside / kFade, 0.0, 1.0)));
        }
    return stamp;
}

// The halo's alpha divided by the alpha of the letter's pixel. It is above 1 because strokes of small letters
// are thinner than a pixel and never opaque.
constexpr float kGain = 2.2f;

// The halo's alpha in the part, 0 to 255. Clear pixels, which are most of a surface, are skipped.
std::vector<float> halo_in(cairo_surface_t* from, const Rectangle& part, const Stamp& stamp) {
    std::vector<float> halo(static_cast<std::size_t>(part.width) * part.height, 0);
    const int r = stamp.reach, wide = cairo_image_surface_get_width(from),
              high = cairo_image_surface_get_height(from);
    for (int y = std::max(0, part.y - r); y < std::min(high, part.y + part.height + r); ++y) {
        const std::uint32_t* row = surface_row(from, y);
        for (int x = std::max(0, part.x - r); x < std::min(wide, part.x + part.width + r); ++x) {
            const float alpha = std::min(255.0f, kGain * static_cast<float>(row[x] >> 24));
            if (alpha == 0) continue;
            for (int j = std::max(y - r, part.y); j <= std::min(y + r, part.y + part.height - 1); ++j)
                for (int i = std::max(x - r, part.x); i <= std::min(x + r, part.x + part.width - 1); ++i) {
                    const float strength = stamp.strength[(j - y + r) * (2 * r + 1) + (i - x + r)];
                    float& at = halo[static_cast<std::size_t>(j - part.y) * part.width + (i - part.x)];
                    at = std::max(at, alpha * strength);
                }
        }
    }
    return halo;
}

}  // namespace

WordHalo halo_of(const TypeScale& type, const Palette& palette) {
    return {palette.background, std::max(2.0, 0.18 * type.minor)};
}

void copy_part_on_halo(cairo_surface_t* from, const Rectangle& part, int x, int y, const WordHalo& halo,
                       Picture& picture) {
    cairo_surface_flush(from);
    const std::vector<float> strength = halo_in(from, part, make_stamp(halo.reach));
    const float colour[3] = {static_cast<float>(halo.colour.red), static_cast<float>(halo.colour.green),
                             static_cast<float>(halo.colour.blue)};
    std::size_t next = 0;
    for (int j = 0; j < part.height; ++j) {
        const std::uint32_t* row = surface_row(from, part.y + j) + part.x;
        std::uint8_t* out = picture.pixel(x + part.x, y + part.y + j);
        for (int i = 0; i < part.width; ++i, out += 4) {
            const float left = strength[next++] * (1 - static_cast<float>(row[i] >> 24) / 255);
            for (int c = 0; c < 3; ++c)
                out[c] = static_cast<std::uint8_t>(static_cast<float>((row[i] >> (16 - 8 * c)) & 255) +
                                                   left * colour[c] + 0.5f);
            out[3] = static_cast<std::uint8_t>(static_cast<float>(row[i] >> 24) + left + 0.5f);
        }
    }
    divide_by_alpha(picture, {x + part.x, y + part.y, part.width, part.height});
}

namespace {

void rounded(cairo_t* on, const Rectangle& box, double radius) {
    constexpr double quarter = 0.5 * std::numbers::pi;
    cairo_new_sub_path(on);
    cairo_arc(on, box.x + box.width - radius, box.y + radius, radius, -quarter, 0);
    cairo_arc(on, box.x + box.width - radius, box.y + box.height - radius, radius, 0, quarter);
    cairo_arc(on, box.x + radius, box.y + box.height - radius, radius, quarter, 2 * quarter);
    cairo_arc(on, box.x + radius, box.y + radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(on);
}

// Lays a pixel over another. The upper pixel is multiplied by its alpha, and the lower pixel is not.
void lay_pixel(std::uint32_t upper, std::uint8_t* out) {
    const unsigned alpha = upper >> 24;
    if (alpha == 0) return;
    const double left = out[3] * (255.0 - alpha) / 255, all = alpha + left;
    for (int c = 0; c < 3; ++c) {
        const unsigned own = (upper >> (16 - 8 * c)) & 255;
        out[c] = static_cast<std::uint8_t>(std::min(255.0, (255 * own + out[c] * left) / all + 0.5));
    }
    out[3] = static_cast<std::uint8_t>(all + 0.5);
}

void lay_part(cairo_surface_t* from, const Rectangle& part, const Rectangle& gutter, Picture& picture) {
    cairo_surface_flush(from);
    for (int y = part.y; y < part.y + part.height; ++y) {
        const std::uint32_t* row = surface_row(from, y);
        for (int x = part.x; x < part.x + part.width; ++x)
            lay_pixel(row[x], picture.pixel(gutter.x + x, gutter.y + y));
    }
}

}  // namespace

std::vector<Rectangle> plates_around(const std::vector<WordBox>& boxes, const TypeScale& type,
                                     const Rectangle& gutter) {
    const double room = 0.45 * type.margin;
    std::vector<Rectangle> plates;
    for (const WordBox& box : boxes) {
        if (box.width <= 0 || box.height <= 0) continue;
        const int left = std::max(0, static_cast<int>(box.x - room)),
                  top = std::max(0, static_cast<int>(box.y - room)),
                  right = std::min(gutter.width, static_cast<int>(std::ceil(box.x + box.width + room))),
                  bottom = std::min(gutter.height, static_cast<int>(std::ceil(box.y + box.height + room)));
        plates.push_back({left, top, right - left, bottom - top});
    }
    return plates;
}

void paint_plates(cairo_t* on, const std::vector<Rectangle>& plates, const TypeScale& type,
                  const Palette& palette) {
    set_colour(on, palette.background, plate_strength(palette));
    for (const Rectangle& plate : plates) rounded(on, plate, 0.3 * type.main);
    cairo_fill(on);
}

void lay_plates(cairo_surface_t* from, const std::vector<Rectangle>& plates, const Rectangle& gutter,
                Picture& picture) {
    for (const Rectangle& plate : plates) lay_part(from, plate, gutter, picture);
}

}  // namespace grainreel
