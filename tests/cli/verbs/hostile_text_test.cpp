// Tests of text in a scene or on the command line that could harm a terminal or a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using Words = std::vector<std::string>;

std::string with(const std::string& part, const std::string& instead) {
    std::string text = small_scene_text;
    return text.replace(text.find(part), part.size(), instead);
}

class HostileText : public testing::Test {
  protected:
    Ended run(const Words& words) const { return run_program(words, {.folder = here.path()}); }
    static void expect_harmless(const Ended& ended) {
        for (const std::string& text : {ended.out, ended.err})
            for (const char c : text)
                EXPECT_TRUE(c == '\n' || c == '\t' || (c != 0x7f && (c & 0xe0) != 0)) << text;
    }
    TemporaryFolder here;
};

TEST_F(HostileText, ATitleMovesNoCursor) {
    write_text(here / "a.toml",
               with("Fifty grains", R"(\u001b[2J\u001b]0;owned\u0007\u009b31m\u007f\nwarning: none)"));
    const Ended ended = run({"check", "a.toml"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    expect_harmless(ended);
    EXPECT_THAT(ended.out,
                HasSubstr(R"(scene        \u001b[2J\u001b]0;owned\u0007\u009b31m\u007f\u000awarning: none)"));
}

TEST_F(HostileText, ControlCharactersInNamesAreRefusedWithTheirPlace) {
    for (const char* control : {"\\n", "\\u001b", "\\u0000", "\\u0085", "\\t"}) {
        write_text(here / "a.toml", with("name = \"big\"", std::string("name = \"b") + control + "g\""));
        const Ended ended = run({"check", "a.toml"});
        EXPECT_EQ(ended.status, 2) << control;
        EXPECT_THAT(ended.err, tells({"a.toml:8:1", "'name'", "control character U+00"})) << control;
        expect_harmless(ended);
    }
    write_text(here / "a.toml", with("Fifty grains", "cut\\u0000off"));
    EXPECT_THAT(run({"check", "a.toml"}).err, tells({"a.toml:1:1", "'title'", "control character U+0000"}));
    write_text(here / "a\nb.toml", small_scene_text);
    EXPECT_THAT(run({"check", "a\nb.toml"}).err, tells({"file's name", "control character U+000A"}));
}

TEST_F(HostileText, WhatIsTypedIsEchoedShort) {
    write_small_scene(here.path());
    const std::string endless(100000, 'x');
    std::string words;
    for (int i = 0; i < 30000; ++i) words += "x ";
    for (const std::string& typed : {words, "\x1b[31m" + endless})
        for (const Words& line : {Words{"check", typed}, Words{"inspect", typed, "--where", typed},
                                  Words{"movie", "fifty.toml", "--out", typed}}) {
            const Ended ended = run(line);
            EXPECT_LT(ended.err.size(), 4500u) << line[0].substr(0, 20);
            expect_harmless(ended);
        }
}

}  // namespace
}  // namespace grainreel
