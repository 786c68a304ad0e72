// Tests of the fixed words: their languages, and own words in their place.
#include "render/scene/wording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

// Every text has the same parts as the English one, and a name of its own.
TEST(Wording, EachWordSaysTheSameInEachLanguage) {
    std::set<std::string> names;
    for (int k = 0; k < static_cast<int>(Word::end_of_table); ++k) {
        const auto word = static_cast<Word>(k);
        EXPECT_TRUE(names.insert(name_of(word)).second) << name_of(word);
        for (const auto& [name, language] : language_words()) {
            Wording say{language, {}};
            const std::string text = say(word, {"<one>", "<two>"});
            const int parts = parts_in(english_of(word));
            EXPECT_EQ(text.find("<one>") != std::string::npos, parts >= 1) << name << ": " << text;
            EXPECT_EQ(text.find("<two>") != std::string::npos, parts >= 2) << name << ": " << text;
        }
    }
}

TEST(Wording, PutsPartsWhereALanguageHasThem) {
    EXPECT_EQ(Wording()(Word::in_the_tray, {"3", "10"}), "3 of 10 in the tray");
    EXPECT_EQ((Wording{Language::de, {}})(Word::in_the_tray, {"3", "10"}), "3 von 10 in der Schale");
    const Wording own{Language::de, {{Word::in_the_tray, "{2} Körner, {1} unten"}}};
    EXPECT_EQ(own(Word::in_the_tray, {"3", "10"}), "10 Körner, 3 unten");
    EXPECT_EQ(own(Word::gravity), "Schwerkraft");
}

TEST(Wording, CountsParts) {
    EXPECT_EQ(parts_in("no parts"), 0);
    EXPECT_EQ(parts_in("{1} of {2}"), 2);
    EXPECT_EQ(parts_in("{"), -1);
    EXPECT_EQ(parts_in("{0}"), -1);
    EXPECT_EQ(parts_in("a } b"), -1);
}

// A column whose label is not in the table would stand in English among German words.
TEST(Wording, EachColumnHasALabelInEachLanguage) {
    const FilmedScene scene = read_text(wedge_text);
    for (const MeasureColumn& column : measure_columns(scene)) {
        if (column.name == "step" || column.label.find("error of the r") == 0) continue;
        for (const Language language : {Language::de, Language::fr, Language::es})
            EXPECT_NE(phrase(language, column.label), column.label) << column.name;
    }
    EXPECT_EQ(phrase(Language::de, "mean height of big"), "mittlere Höhe: big");
    EXPECT_EQ(phrase(Language::fr, "a label of nobody"), "a label of nobody");
    EXPECT_EQ(phrase(Language::en, "mean height of big"), "mean height of big");
}

void expect_complaint(const std::string& toml, const testing::Matcher<std::string>& words) {
    try {
        read_text(wedge_text + toml);
        FAIL() << "accepted: " << toml;
    } catch (const UserError& error) {
        EXPECT_THAT(std::string(error.what()), words);
    }
}

TEST(Wording, IsReadAndWrittenBack) {
    const FilmedScene scene = read_text(wedge_text +
                                        "[film]\nlang = \"fr\"\n[film.wording]\n"
                                        "gravity = \"poids\"\ncycle = \"tour {1}\"\n");
    EXPECT_EQ(scene.film.wording(Word::gravity), "poids");
    EXPECT_EQ(scene.film.wording(Word::cycle, {"7"}), "tour 7");
    EXPECT_EQ(scene.film.wording(Word::vibration), "vibration");
    EXPECT_EQ(scene.film.wording(Word::time), "temps");
    const FilmedScene again = read_text(wedge_text + scene.film_text);
    EXPECT_EQ(again.film.wording, scene.film.wording);
}

TEST(Wording, LabelsOfColumnsFollowTheLanguage) {
    const std::string plot = "[[film.plot]]\ny = \"height_difference\"\n";
    const auto label = [&](const std::string& before, const std::string& after = "") {
        return read_text(wedge_text + before + plot + after).film.shows.plots.at(0).label;
    };
    EXPECT_EQ(label(""), "height of big − small, in bed heights");
    EXPECT_EQ(label("[film]\nlang = \"de\"\n"), "Höhe groß − klein, in Betthöhen");
    EXPECT_EQ(label("[film]\nlang = \"de\"\n", "label = \"mine\"\n"), "mine");
}

TEST(Wording, UnknownWordsAndBracesAreRefused) {
    expect_complaint("[film.wording]\nquux = \"x\"\n", tells({"test.toml:", "quux", "gravity", "vibration"}));
    expect_complaint("[film.wording]\ngravty = \"x\"\n", tells({"gravty", "'gravity'"}));
    expect_complaint("[film.wording]\ncycle = \"tour\"\n", tells({"test.toml:", "cycle", "{1}"}));
    expect_complaint("[film.wording]\ngravity = \"{1}\"\n", tells({"test.toml:", "gravity", "brace"}));
    expect_complaint("[film]\nlang = \"it\"\n", tells({"test.toml:", "lang", "\"de\""}));
}

}  // namespace
}  // namespace grainreel
