// Tests of pictures as a page of PDF: words are text with its font, the picture is pixels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/picture/base/pdf_page.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Shot some_balls() {
    return frame_of({{{0, 0, 0.08}, 0.01, 1}, {{0, 0.02, 0.05}, 0.005, 0}});
}

std::string page_of(const FilmedScene& scene, double dots_an_inch) {
    PdfPage page(scene.film.width, scene.film.height, dots_an_inch);
    Renderer renderer(scene, 1);
    renderer.draw_page(page, some_balls(), "", 0);
    return page.finish(scene.title);
}

TEST(PdfPage, HasWordsAsTextAndThePictureAsPixels) {
    const std::string pdf = page_of(wedge(), 160);
    EXPECT_THAT(pdf, StartsWith("%PDF-1.4"));
    EXPECT_THAT(pdf, HasSubstr("/FontFile"));   // embedded, at least as far as its letters are used
    EXPECT_THAT(pdf, HasSubstr("/ToUnicode"));  // by which letters are searched and copied
    EXPECT_THAT(pdf, HasSubstr("/Width 640"));
    EXPECT_THAT(pdf,
                HasSubstr("288 162 ]"));  // the size of the page in points: 640 and 360 pixels at 160 dpi
    EXPECT_THAT(pdf, HasSubstr("A wedge"));
}

TEST(PdfPage, NeedsNoFontWithoutWords) {
    FilmedScene scene = wedge();
    PdfPage page(scene.film.width, scene.film.height, 160);
    Renderer renderer(scene, bare_layout(scene.film), 1, gl::Provider::automatic);
    renderer.draw_page(page, some_balls(), "", 0);
    EXPECT_THAT(page.finish(""), Not(HasSubstr("/FontFile")));
}

TEST(PdfPage, IsTheSameTwiceAndLeavesTheNextPictureAsItIs) {
    EXPECT_EQ(page_of(wedge(), 300), page_of(wedge(), 300));
    Renderer plain(wedge(), 1), used(wedge(), 1);
    PdfPage page(640, 360, 300);
    const Picture before = used.draw(some_balls(), "");
    used.draw_page(page, some_balls(), "", 0);
    EXPECT_EQ(before.rgba, plain.draw(some_balls(), "").rgba);
    EXPECT_EQ(before.rgba, used.draw(some_balls(), "").rgba);
}

TEST(PdfPage, HoldsPanelsEachWithItsPicture) {
    const FilmedScene scene = wedge(960, 540);
    const std::vector<Panel> panels{{scene, "left", {}}, {scene, "right", {}}};
    const auto shot = std::make_shared<const Shot>(some_balls());
    SideBySide both(panels, scene.film, 1, gl::Provider::automatic);
    PdfPage page(960, 540, 300);
    both.draw_page(page, {shot, shot}, 0, 0, 0);
    const std::string pdf = page.finish("two");
    std::size_t images = 0;
    for (std::size_t k = pdf.find("/Subtype /Image"); k != std::string::npos;
         k = pdf.find("/Subtype /Image", k + 1))
        ++images;
    EXPECT_GE(images, 2u);
    EXPECT_THAT(pdf, HasSubstr("/FontFile"));
}

}  // namespace
}  // namespace grainreel::test
