// Tests of the names of measures: the documentation and the observers agree.
#include "engine/measure/columns.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/scene/scene_text.hpp"

namespace grainreel {
namespace {

TEST(MeasureColumns, DocsTellWhatTheObserversSay) {
    const std::string page = GRAINREEL_SOURCE "/docs/reference/measures.md";
    const std::string begin_mark =
        "<!-- table of columns: generated from engine/measure/observer_list.hpp, begin -->\n";
    std::ostringstream whole;
    whole << std::ifstream(page).rdbuf();
    std::string text = whole.str();
    const auto begin = text.find(begin_mark), end = text.find("<!-- table of columns: end -->\n");
    ASSERT_NE(begin, std::string::npos);
    ASSERT_NE(end, std::string::npos);
    const auto start = begin + begin_mark.size();
    if (std::getenv("GRAINREEL_WRITE_DOCS") != nullptr) {
        text.replace(start, end - start, column_table_markdown());
        std::ofstream(page) << text;
        return;
    }
    EXPECT_EQ(text.substr(start, end - start), column_table_markdown())
        << "docs/reference/measures.md is not what the observers say; write it anew with\n"
           "  GRAINREEL_WRITE_DOCS=1 test_scene --gtest_filter=MeasureColumns.DocsTellWhatTheObserversSay";
}

// What the documentation says is what films, charts and answers show.
TEST(MeasureColumns, UnitsAreThoseOfTheDocumentation) {
    const std::map<std::string, std::string> written{{"N m", "N.m"}, {"degrees", "degree"}, {"periods", "1"}};
    Scene scene = read_text(wedge_text);
    scene.meshes.resize(1);
    scene.meshes[0].name = "screw";
    scene.meshes[0].turn.emplace();
    for (const ObserverColumns& entry : observer_columns())
        for (const ColumnGroup& group : entry.groups(scene)) {
            const std::string unit = group.unit;
            if (unit.find(',') != std::string::npos) continue;  // two units, or turns with their range
            for (const MeasureColumn& column : group.columns) {
                const auto other = written.find(unit);
                EXPECT_EQ(text_of(column.dimension).unit, other != written.end() ? other->second : unit)
                    << column.name;
            }
        }
}

// The name of a column with a unit ends in the unit, and live words and plots find it with and without.
TEST(MeasureColumns, UnitsEndTheNames) {
    std::set<std::string> names;
    for (const MeasureColumn& column : measure_columns(read_text(wedge_text))) {
        EXPECT_TRUE(names.insert(column.name).second) << column.name;
        EXPECT_FALSE(column.label.empty()) << column.name;
        if (column.dimension == Dimension::number || column.name == "outflow_rate") continue;
        const std::string unit = std::string("_") + text_of(column.dimension).unit;
        ASSERT_GT(column.name.size(), unit.size());
        EXPECT_EQ(column.name.substr(column.name.size() - unit.size()), unit);
    }
}

}  // namespace
}  // namespace grainreel
