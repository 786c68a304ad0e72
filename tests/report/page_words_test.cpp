// Tests of the page's words: every text of templates and scripts is in the table, in all languages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <regex>
#include <set>

#include "render/page/embed.hpp"
#include "render/page/page_measures.hpp"
#include "render/page/page_words.hpp"
#include "render/page/page_words_table.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// What a row puts in: {1}, {2} ..., however often and in which order.
std::set<std::string> parts_of_text(const std::string& text) {
    const std::regex part("\\{[1-9]\\}");
    return {std::sregex_token_iterator(text.begin(), text.end(), part), std::sregex_token_iterator()};
}

TEST(PageWords, HaveTheSamePartsInEachLanguage) {
    std::set<std::string> seen;
    for (const PageRow& row : page_rows) {
        EXPECT_TRUE(seen.insert(row.english).second) << row.english << " is there twice";
        for (const char* other : row.others) {
            EXPECT_THAT(std::string(other), Not(IsEmpty())) << row.english;
            EXPECT_EQ(parts_of_text(other), parts_of_text(row.english)) << other;
        }
    }
}

// All texts of templates ([[text]]) and scripts (tr("text")).
std::set<std::string> texts_of_page() {
    const PageFiles& files = page_files();
    std::set<std::string> texts;
    const auto take = [&](std::string_view from, const char* pattern) {
        const std::string all(from);
        const std::regex form(pattern);
        for (std::sregex_iterator match(all.begin(), all.end(), form), end; match != end; ++match)
            texts.insert((*match)[1]);
    };
    for (const std::string_view one :
         {files.page, files.body, files.variant, files.bed, files.charts, files.fields, files.live})
        take(one, "\\[\\[([^\\]]*)\\]\\]");
    const std::string script = files.script(true);
    const std::string ours = script.substr(script.find("\"use strict\";\n"));  // uPlot comes before
    take(ours, "\\btr\\(\"([^\"]*)\"");
    return texts;
}

TEST(PageWords, HaveAllTextsOfThePage) {
    std::set<std::string> known;
    for (const PageRow& row : page_rows) known.insert(row.english);
    for (int k = 0; k < static_cast<int>(Word::end_of_table); ++k)
        known.insert(english_of(static_cast<Word>(k)));
    const std::set<std::string> texts = texts_of_page();
    EXPECT_GT(texts.size(), 60u);
    for (const std::string& text : texts) EXPECT_TRUE(known.count(text)) << text;
}

TEST(PageWords, AreThoseOfTheFilmWhereItHasThem) {
    const PageWords german({Language::de, {{Word::time, "Uhrzeit <s>"}}});
    EXPECT_EQ(german("Play"), "Abspielen");
    EXPECT_EQ(german("time"), "Uhrzeit <s>");
    EXPECT_EQ(german("a text of no table"), "a text of no table");
    EXPECT_EQ(german("Moment {1} of {2}, {3} s of the run.", {"4", "{1}", "0.5"}),
              "Moment 4 von {1}, 0.5 s des Laufs.");
    EXPECT_EQ(german.in("<b>[[time]]</b>{{time}}"), "<b>Uhrzeit &lt;s&gt;</b>{{time}}");
    const auto facts = nlohmann::json::parse(german.with_words("{\"begin\":0}"));
    EXPECT_EQ(facts["words"]["time"], "Uhrzeit <s>");
    EXPECT_EQ(facts["words"]["Play"], "Abspielen");
    EXPECT_EQ(facts["begin"], 0);
    EXPECT_EQ(PageWords({}).with_words("{}"), "{}");  // English pages carry no words
}

// A note is told in English and stands on the page in its language, with all of its parts.
TEST(PageWords, OfNotesHaveTheirPartsToo) {
    const PageNote note("{1} of {2} s",
                        {PageNote("the film has {1}", {std::string("{2} MB")}), std::string("Play")});
    EXPECT_EQ(note.in_english(), "the film has {2} MB of Play s");
    EXPECT_EQ(PageWords({Language::fr, {}})(note), "le film fait {2} MB sur Lecture s");
    EXPECT_EQ(PageWords({Language::fr, {}})(PageNote()), "");
}

TEST(PageMeasures, HaveLabelsLanguageAndSmoothingOfTheFilm) {
    FilmedScene scene;
    scene.drive.present = true;
    scene.film.wording.language = Language::de;
    scene.film.shows.plots = {{"lost_J", "my own words", {}, Dimension::energy}};
    scene.film.shows.plots[0].period = true;
    MeasureTable table({"time_s", "cycles", "centre_z_m", "kinetic_J", "lost_J"});
    table.add({0, 0, 0.1, 1, 0});
    table.add({0.1, 2, 0.2, 2, 1});
    const PageMeasures page = page_measures(scene, table);
    EXPECT_EQ(page.columns[4].label, "my own words");
    EXPECT_TRUE(page.columns[4].smooth);
    EXPECT_EQ(page.cycles, 1u);
    EXPECT_EQ(page.columns[3].label, "kinetische Energie");
    EXPECT_FALSE(page.columns[3].smooth);
    EXPECT_EQ(page.columns[2].units.front().first, "m");
    EXPECT_EQ(page.columns[2].units[1], (std::pair<std::string, double>("mm", 1e-3)));
    scene.drive.present = false;
    EXPECT_FALSE(page_measures(scene, table).columns[4].smooth);
}

}  // namespace
}  // namespace grainreel
