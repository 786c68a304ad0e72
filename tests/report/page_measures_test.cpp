// Tests of which measures have charts, and of what run.json says about them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "render/page/facts/methods.hpp"
#include "render/page/page_measures.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(PageMeasures, PlotsOfTheFilmComeFirstAndWhatNeverChangesIsLeftOut) {
    FilmedScene scene;
    scene.film.shows.plots = {{"lost_J", "lost energy", {}, Dimension::energy}};
    MeasureTable table({"step", "time_s", "centre_z_m", "kinetic_J", "contact_number", "lost_J", "lacey"});
    table.add({0, 0, 0.1, 1, 4, 0, none});
    table.add({1, 0.1, 0.2, 2, 4, 1, none});
    const PageMeasures page = page_measures(scene, table);
    EXPECT_EQ(page.time, 1u);
    EXPECT_THAT(page.charted, ElementsAre(5u, 2u, 3u));
    EXPECT_EQ(page.columns[2].unit, "m");
    EXPECT_EQ(page.columns[3].label, "kinetic energy");
    EXPECT_THAT(page.rows, ElementsAre(0u, 1u));
}

TEST(PageMeasures, ALabelThatSaysItsUnitFixesThatOfTheChart) {
    FilmedScene scene;
    scene.film.shows.plots = {{"lost_J", "lost energy (mJ)", {}, Dimension::energy}};
    MeasureTable table({"step", "time_s", "kinetic_J", "lost_J"});
    table.add({0, 0, 0, 0});
    table.add({1, 1, 1, 2});
    const PageMeasures page = page_measures(scene, table);
    EXPECT_EQ(page.columns[3].label, "lost energy");
    EXPECT_THAT(page.columns[3].units, ElementsAre(std::pair<std::string, double>("mJ", 1e-3)));
    EXPECT_GT(page.columns[2].units.size(), 1u);
}

TEST(PageMeasures, LongTablesAreThinnedEvenly) {
    MeasureTable table({"time_s", "kinetic_J"});
    for (int row = 0; row < 9000; ++row) table.add({0.1 * row, 1.0 * row});
    const PageMeasures page = page_measures(FilmedScene(), table);
    ASSERT_EQ(page.rows.size(), kMostRowsAtOnce);
    EXPECT_EQ(page.rows.front(), 0u);
    EXPECT_EQ(page.rows.back(), 8999u);
    for (std::size_t k = 1; k < page.rows.size(); ++k)
        EXPECT_NEAR(static_cast<double>(page.rows[k] - page.rows[k - 1]), 8999 / 1999.0, 1);
}

TEST(PageMeasures, WithoutTimeNothingIsCharted) {
    MeasureTable table({"kinetic_J"});
    table.add({1});
    table.add({2});
    EXPECT_THAT(page_measures(FilmedScene(), table).charted, IsEmpty());
}

TEST(RecordOfPage, HasWhatCanBeRead) {
    const test::TemporaryFolder here;
    EXPECT_EQ(record_of_page(here.path()).status, "unknown");
    for (const char* text :
         {"", "[1, 2", "[[[[", "7", "{\"program\": 5, \"written\": {\"film_frames\": \"many\"}}"}) {
        test::write_text(here / "run.json", text);
        const ReadRunJson run = record_of_page(here.path());
        EXPECT_EQ(run.status, "unknown") << text;
        EXPECT_FALSE(run.record.film_frames) << text;
    }
    test::write_text(here / "run.json",
                     R"({"status": "complete", "program": {"version": "1.2"}, "written": {"film_frames": 12},
                         "warnings": ["w", 3]})");
    const ReadRunJson run = record_of_page(here.path());
    EXPECT_EQ(run.status, "complete");
    EXPECT_EQ(run.record.version, "1.2");
    EXPECT_EQ(run.record.film_frames, 12);
    EXPECT_THAT(run.record.warnings, ElementsAre("w"));
}

// A film that was only drawn has no seed and no step: the file says nothing about the engine.
TEST(RecordOfPage, LinesNameTheEngineOnlyWhereOneRan) {
    ReadRunJson run;
    const auto seed_line = [&] {
        for (const auto& [name, text] : origin_lines(run))
            if (name == "seed") return text;
        return std::string("none");
    };
    EXPECT_EQ(seed_line(), "none");
    run.record.step = 1e-5;
    run.record.seed = 7;
    EXPECT_EQ(seed_line(), "7");
}

}  // namespace
}  // namespace grainreel
