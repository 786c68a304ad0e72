#include "render/picture/base/pdf_page.hpp"

#include <cairo-pdf.h>
#include <cairo.h>

#include "engine/base/error.hpp"
#include "render/picture/base/cairo_text.hpp"

namespace grainreel {

namespace {

constexpr double points_an_inch = 72;

cairo_status_t take_bytes(void* closure, const unsigned char* bytes, unsigned int count) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

// The picture as Cairo wants it: colours multiplied by alpha, 0xAARRGGBB.
CairoSurface as_surface(const Picture& picture) {
    CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, picture.width, picture.height));
    cairo_surface_flush(surface.get());
    unsigned char* pixels = cairo_image_surface_get_data(surface.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    for (int y = 0; y < picture.height; ++y) {
        auto* row = reinterpret_cast<std::uint32_t*>(pixels + static_cast<std::size_t>(y) * stride);
        for (int x = 0; x < picture.width; ++x) {
            const std::uint8_t* from = picture.pixel(x, y);
            const std::uint32_t alpha = from[3];
            const auto part = [&](int c) { return (from[c] * alpha + 127) / 255; };
            row[x] = alpha << 24 | part(0) << 16 | part(1) << 8 | part(2);
        }
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

}  // namespace

struct PdfPage::Impl {
    std::string bytes;
    CairoSurface surface;
    CairoContext context;
};

PdfPage::PdfPage(int width, int height, double dots_an_inch) : impl_(std::make_unique<Impl>()) {
    const double points = points_an_inch / dots_an_inch;
    impl_->surface.reset(
        cairo_pdf_surface_create_for_stream(take_bytes, &impl_->bytes, width * points, height * points));
    // Journals take this version, and it keeps the objects of the file apart.
    cairo_pdf_surface_restrict_to_version(impl_->surface.get(), CAIRO_PDF_VERSION_1_4);
    impl_->context.reset(cairo_create(impl_->surface.get()));
    cairo_scale(impl_->context.get(), points, points);
}

PdfPage::~PdfPage() = default;

void PdfPage::paint(const Picture& picture) {
    const CairoSurface image = as_surface(picture);
    cairo_set_source_surface(on(), image.get(), 0, 0);
    cairo_rectangle(on(), 0, 0, picture.width, picture.height);
    cairo_fill(on());
    cairo_set_source_rgb(on(), 0, 0, 0);
}

cairo_t* PdfPage::on() const {
    return impl_->context.get();
}

std::string PdfPage::finish(const std::string& title) {
    cairo_surface_t* surface = impl_->surface.get();
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title.c_str());
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "grainreel");
    // Without a date of its own the file would have that of today, so no two files would be alike.
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "1980-01-01T00:00:00Z");
    cairo_show_page(on());
    const cairo_status_t drawn = cairo_status(on());
    cairo_surface_finish(surface);
    const cairo_status_t status = drawn ? drawn : cairo_surface_status(surface);
    if (status != CAIRO_STATUS_SUCCESS)
        throw RunError("cannot make the PDF: {}", cairo_status_to_string(status));
    return std::move(impl_->bytes);
}

}  // namespace grainreel
