// Tests of text from outside: what is UTF-8, and that a scene with any text in it can be read again.
#include "engine/base/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using test::tells_only;
using testing::HasSubstr;

std::string complaint(const std::string& text, const Assignments& sets, const char* file = "test.toml") {
    try {
        read_filmed_scene_text(text, file, sets, measurable_in);
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

// RFC 3629, section 4 lists what is allowed; tested are also neighbours that are not.
TEST(Utf8, KnowsWhatItIs) {
    for (const char* good : {"", "plain", "Γ = 3", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80",
                             "\xed\x9f\xbf", "\xee\x80\x80", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
        EXPECT_EQ(first_byte_not_utf8(good), std::nullopt) << good;
    for (const char* bad : {"\x80", "\xc1\xbf", "\xc2", "\xc2 ", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xe2\x82",
                            "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff"})
        EXPECT_EQ(first_byte_not_utf8("Γ" + std::string(bad) + "x"), std::size_t{2}) << excerpt(bad);
}

TEST(Utf8, AnExcerptIsShortAndPrintable) {
    EXPECT_EQ(excerpt("Γ = 3"), "Γ = 3");
    EXPECT_EQ(excerpt("a\nb\xff\x1b"), "a\\u000ab\\xff\\u001b");
    EXPECT_EQ(excerpt("\x7f\xc2\x9b\xe2\x80\xa8"), "\\u007f\\u009b\\u2028");
    std::string greek;
    for (std::size_t i = 0; i < kExcerpt; ++i) greek += "Γ";
    EXPECT_EQ(excerpt(greek), greek);
    EXPECT_EQ(excerpt(greek + "Γ"), greek + "...");
}

TEST(Utf8, ATerminalObeysNothingOfWhatIsShown) {
    EXPECT_EQ(visible("\x1b[31mΓ\n\tend\r\xc2\x9b\xff", "\n\t"), "\\u001b[31mΓ\n\tend\\u000d\\u009b\\xff");
    EXPECT_EQ(message_text("a\nb \x1b c"), "a\\u000ab \\u001b c");
    EXPECT_EQ(first_control_character("Γ\xc2\xa0"), std::nullopt);  // a space at which lines do not break
    EXPECT_EQ(first_control_character("Γ\xc2\x85"), 0x85u);
}

// A path stays whole. Longer words lose their middle, and the message shows it.
TEST(Utf8, AMessageHasNoEndlessWords) {
    const std::string path(200, 'p'), argument(100000, 'x');
    EXPECT_EQ(message_text(path + ": is missing"), path + ": is missing");
    const std::string message = message_text("--at " + argument + ": is no time; give one");
    EXPECT_LT(message.size(), 400u);
    EXPECT_THAT(message, testing::StartsWith("--at xxx"));
    EXPECT_THAT(message, testing::HasSubstr("xxx...xxx"));
    EXPECT_THAT(message, testing::EndsWith("xxx: is no time; give one"));
    std::string words, greek;
    for (int i = 0; i < 20000; ++i) words += "x ", greek += "Γ";
    EXPECT_LT(message_text("--where " + words + "; mend it").size(), 4100u);
    EXPECT_THAT(message_text("--where " + words + "; mend it"), testing::EndsWith("; mend it"));
    EXPECT_EQ(first_byte_not_utf8(message_text(greek)), std::nullopt);
}

TEST(Utf8, TextThatIsNotIsRefusedAtTheStartAndTheByteNamed) {
    EXPECT_THAT(complaint("title = \"x\"\n# Gr\xf6\xdf"
                          "e\n" +
                              wedge_text,
                          {}),
                tells_only({"test.toml:2:5", "0xf6", "not UTF-8", "save"}));
    EXPECT_THAT(complaint(wedge_text, {{"film.title=Gr\xf6sse", "--title"}}),
                tells_only({"--title", "\"film.title=Gr\\xf6sse\"", "byte 14, 0xf6", "UTF-8 terminal"}));
    EXPECT_THAT(complaint(wedge_text, {"species.big.name=\xed\xa0\x80"}), HasSubstr("at byte 18, 0xed"));
    EXPECT_THAT(complaint(wedge_text, {}, "a/Gr\xf6sse.toml"),
                tells_only({"\"Gr\\xf6sse.toml\"", "byte 3, 0xf6", "rename"}));
    EXPECT_THAT(complaint(wedge_text + "[start]\nmethod = \"file\"\nfile = \"final.csv\"\n", {},
                          "/nowhere/Gr\xf6sse/test.toml"),
                tells({"'file'", "/nowhere/Gr\\xf6sse/final.csv", "not UTF-8"}));
}

// `render` reads the run's own scene.toml.
TEST(Utf8, AnyTextThatIsTakenCanBeReadAgain) {
    std::string all = "Γ \"'\\ ";
    for (char c = 1; c < 0x20; ++c) all += c;
    all += "\x7f\u0080\u2028\U0001F4A5";
    const std::string name = "xΓ \"'\\ \U0001F4A5";  // a name has no control characters
    FilmedScene scene =
        read_text(wedge_text, {Assignment("film.title=" + all), Assignment("species.big.name=" + name)});
    scene.film.shows.text = all;
    const FilmedScene back =
        read_filmed_scene_text(resolved_scene(scene, make_plan(scene)), "scene.toml", {}, measurable_in);
    EXPECT_EQ(back.film.title, scene.film.title);
    EXPECT_EQ(back.species[1].name, name);
    EXPECT_EQ(back.film.shows.text, all);
}

}  // namespace
}  // namespace grainreel
