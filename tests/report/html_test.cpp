// Tests of text and data inside HTML.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "render/page/embed.hpp"

namespace grainreel {
namespace {

TEST(HtmlText, NoSignMeansAnything) {
    EXPECT_EQ(html_text("<script>\"&'"), "&lt;script&gt;&quot;&amp;&#39;");
    EXPECT_EQ(html_text("a\tb\nc\x01\x1b"
                        "d"),
              "a\tb\nc\xef\xbf\xbd\xef\xbf\xbd"
              "d");
    EXPECT_EQ(html_text("Γ = 4 µm"), "Γ = 4 µm");
}

TEST(JsonInHtml, CannotEndItsElement) {
    EXPECT_EQ(json_in_html(R"({"a":"</script><!--"})"), R"({"a":"\u003c/script>\u003c!--"})");
}

TEST(FileLink, IsNeverASchemeOrAnotherFolder) {
    EXPECT_EQ(file_link("movie.mp4"), "./movie.mp4");
    EXPECT_EQ(file_link("javascript:alert(1)"), "./javascript%3Aalert%281%29");
    EXPECT_EQ(file_link("a b\"<&/ö"), "./a%20b%22%3C%26%2F%C3%B6");
}

TEST(Filled, PutsTextsInPlaceAndLooksAtThemNoMore) {
    EXPECT_EQ(filled("<h1>{{title}}</h1>{{body}}!", {{"body", "{{title}}"}, {"title", "x"}}),
              "<h1>x</h1>{{title}}!");
}

// The vectors are those of RFC 4648, section 10.
TEST(Base64, GivesTheVectorsOfTheStandard) {
    const auto of = [](const std::string& text) {
        return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    };
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("f"), "Zg==");
    EXPECT_EQ(of("fo"), "Zm8=");
    EXPECT_EQ(of("foo"), "Zm9v");
    EXPECT_EQ(of("foob"), "Zm9vYg==");
    EXPECT_EQ(of("fooba"), "Zm9vYmE=");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(of("\xff\xfe\xfb"), "//77");
}

}  // namespace
}  // namespace grainreel
