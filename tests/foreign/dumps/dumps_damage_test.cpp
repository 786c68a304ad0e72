// Tests of text dumps that are damaged or cut.
#include <gmock/gmock.h>

#include "engine/files/foreign/dumps/text_index.hpp"
#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* names = "id type x";

TEST(DamagedTextDump, RowsAreRefusedWithTheirLine) {
    const test::TemporaryFolder folder;
    const auto complaint = [&](const std::string& count, const std::string& rows) {
        return text_complaint(folder, frame_text("7", count, names, rows));
    };
    EXPECT_THAT(complaint("2", "1 1 0\n2 1\n"), tells({":11: ", "2 fields", "3 columns"}));
    EXPECT_THAT(complaint("2", "1 1 0 5\n2 1 0\n"), tells({":10: ", "4 fields", "3 columns"}));
    EXPECT_THAT(complaint("2", "1 1 0\n\n2 x 0\n"), tells({":12: ", "\"x\"", "no number", "column type"}));
    EXPECT_THAT(complaint("2", "1 1 0\n2 1 0.5x\n"), HasSubstr(":11: \"0.5x\" is no number"));
    EXPECT_THAT(complaint("2", "1 1 0\n2 1 -nan\n"), tells({":11: ", "x is \"-nan\"", "no finite number"}));
    EXPECT_THAT(complaint("2", "1 1 1e999\n2 1 0\n"), tells({":10: ", "x is \"1e999\"", "no finite number"}));
    EXPECT_THAT(complaint("3", "5 1 0\n6 1 0\n5 1 1\n"), tells({":12: ", "id 5", "second time"}));
    EXPECT_THAT(complaint("3", "5 1 0\n600000000000 1 0\n5 1 1\n"), tells({":12: ", "id 5 stands"}));
    EXPECT_THAT(complaint("1", "5.5 1 0\n"), tells({":10: ", "id 5.5", "no whole number"}));
}

TEST(DamagedTextDump, WrongCounts) {
    const test::TemporaryFolder folder;
    const std::string good = frame_text("8", "1", names, "1 1 0\n");
    EXPECT_THAT(text_complaint(folder, frame_text("7", "2", names, "1 1 0\n") + good),
                tells({":11: ", "step 7", "after 1 rows", "line 1 says 2"}));
    EXPECT_THAT(text_complaint(folder, frame_text("7", "1", names, "1 1 0\n2 1 0\n") + good),
                tells({":11: ", "one row more", "1", "step 7"}));
    EXPECT_THAT(text_complaint(folder, frame_text("7", "-1", names, "")),
                tells({":4: ", "\"-1\"", "number of grains"}));
    EXPECT_THAT(text_complaint(folder, frame_text("7", "1000000000", names, "1 1 0\n")),
                tells({":1: ", "no frame", "whole"}));
    EXPECT_THAT(text_complaint(folder, frame_text("7", "1000000000", names, "1 1 0\n") + good),
                tells({":11: ", "step 7", "after 1 rows", "line 1 says 1000000000"}));
}

TEST(DamagedTextDump, Heads) {
    const test::TemporaryFolder folder;
    const std::string good = frame_text("7", "1", names, "1 1 0\n");
    EXPECT_THAT(text_complaint(folder, "DUMMY\n" + good.substr(15)),
                tells({":1: ", "\"DUMMY\"", "\"ITEM: TIMESTEP\""}));
    EXPECT_THAT(text_complaint(folder, "ITEM: TIMESTEP\n7.5\n" + good),
                tells({":2: ", "\"7.5\"", "no number", "step"}));
    EXPECT_THAT(text_complaint(folder, "ITEM: TIMESTEP\n7\n" + good),
                tells({":3: ", "new frame", "step 7", "no rows"}));
    EXPECT_THAT(text_complaint(folder, "ITEM: TIMESTEP\n7\nITEM: ATOMS id x\n1 0\n"),
                HasSubstr(":3: rows without their number"));
    EXPECT_THAT(text_complaint(folder, "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x\n1 0\n"),
                HasSubstr(":3: rows without a step"));
    std::string no_item = good;
    no_item.replace(no_item.find("ITEM: ATOMS"), 11, "DUMMY");
    EXPECT_THAT(text_complaint(folder, no_item), tells({":9: ", "\"DUMMY id type x\"", "\"ITEM: ATOMS\""}));
    EXPECT_THAT(text_complaint(folder, good + "ITEM: UNITS\nlj\nITEM: TIME\n250\n"),
                tells({":11: ", "behind the rows"}));
    EXPECT_THAT(text_complaint(folder, good + frame_text("8", "1", "id type y", "1 1 0\n")),
                tells({":19: ", "columns change", "\"id type y\"", "\"id type x\""}));
    EXPECT_THAT(text_complaint(folder, "ITEM: UNITS\nsi\n" + good + "ITEM: UNITS\nlj\n" + good),
                tells({":13: ", "units change", "si to lj"}));
    EXPECT_THAT(text_complaint(folder, "---\ncreator: LAMMPS\ntimestep: 0\n"),
                tells({": a dump in YAML", "not read"}));
    EXPECT_THAT(text_complaint(folder, "ITEM: TIMESTEP\n0\nITEM: GRID SIZE nx ny nz\n1 1 1\n"),
                tells({":3: ", "grid"}));
}

// A line that does not end within the largest buffer is refused and not kept.
TEST(DamagedTextDump, EndlessLine) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(text_complaint(folder, frame_text("7", "1", names, std::string(66 << 20, '1'))),
                tells({":10: ", "longer than 16 MB"}));
}

TEST(CutTextDump, WholeFramesAreReadAndTheLastIsLeftOut) {
    const test::TemporaryFolder folder;
    const std::string whole = frame_text("0", "2", names, "1 1 0.5\n2 1 0.25\n") +
                              frame_text("1", "2", names, "1 1 0.5\n2 1 0.125\n");
    const std::string last = frame_text("2", "2", names, "1 1 0.5\n2 1 0.375\n");
    for (std::size_t kept = 1; kept < last.size(); ++kept) {
        // Nobody knows whether "0.375" without its line feed is cut. The same is true for each number before
        // it.
        const auto dump = open_text(folder.write("a", whole + last.substr(0, kept)));
        const bool only_feeds = last.substr(0, kept).find_first_not_of("\n") == std::string::npos;
        ASSERT_EQ(dump->moments().size(), 2u) << last.substr(0, kept);
        EXPECT_THAT(column_of(dump->read(1).grains, "x"), ElementsAre(0.5, 0.125));
        ASSERT_EQ(dump->news().size(), only_feeds ? 0u : 1u) << last.substr(0, kept);
        EXPECT_THAT(dump->news()[0], AllOf(HasSubstr("last frame"), HasSubstr("left out"), HasSubstr("cut"),
                                           HasSubstr("2 before it are whole")));
    }
    EXPECT_EQ(open_text(folder.write("a", whole + last))->moments().size(), 3u);
    const auto packed =
        open_text(folder.write("b", gzip_of(whole + last).substr(0, gzip_of(whole + last).size() - 12)));
    EXPECT_EQ(packed->moments().size(), 2u);
    EXPECT_THAT(packed->news()[0], HasSubstr("the packed content is cut"));
}

TEST(CutTextDump, AHeadOfTimeAloneIsCutWhereFramesHaveTimes) {
    const test::TemporaryFolder folder;
    const std::string whole = "ITEM: TIME\n0.5\n" + frame_text("0", "1", names, "1 1 0\n");
    const auto dump = open_text(folder.write("a", whole + "ITEM: TIME\n0.75\n"));
    EXPECT_EQ(dump->moments().size(), 1u);
    EXPECT_THAT(dump->news()[0], HasSubstr("cut within its head"));
}

TEST(CutTextDump, NoWholeFrameIsAnError) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(text_complaint(folder, frame_text("2", "2", names, "1 1 0.5\n")),
                tells({":1: ", "no frame", "begins here", "after 1", "2 rows"}));
    EXPECT_THAT(text_complaint(folder, "ITEM: TIMESTEP\n0\n"), HasSubstr("cut within its head"));
}

TEST(CutTextDump, TheOnlyFrameMayEndWithoutALineFeed) {
    const test::TemporaryFolder folder;
    const auto dump = open_text(folder.write("a", frame_text("0", "2", names, "1 1 0.424637\n2 1 0.38212")));
    EXPECT_THAT(column_of(dump->read(0).grains, "x"), ElementsAre(0.424637, 0.38212));
    EXPECT_THAT(dump->news()[0], tells({"no line ends", "last row", "as whole"}));
    // The row is not taken as whole if its radius is one that no other grain has.
    EXPECT_THAT(text_complaint(folder, frame_text("0", "5", "id radius",
                                                  "1 0.0015\n2 0.0019\n3 0.0015\n4 0.0019\n5 0.0")),
                tells({"no frame", "whole"}));
}

TEST(CutTextDump, LastWords) {
    using Words = std::vector<std::string>;
    const Words radii{"0.0015", "0.0019", "0.0015", "0.0019"};
    EXPECT_EQ(judge_last_word("0.0019", radii), LastWord::whole);
    EXPECT_EQ(judge_last_word("0.0", radii), LastWord::cut);
    EXPECT_EQ(judge_last_word("0.001", radii), LastWord::cut);
    EXPECT_EQ(judge_last_word("1", {"1", "12", "1", "12", "1"}), LastWord::open);  // perhaps it was 12
    EXPECT_EQ(judge_last_word("2", {"1", "2", "1", "2"}), LastWord::whole);
    for (const char* word : {"-", "1.5e", "1.5e-", "0.", ""})
        EXPECT_EQ(judge_last_word(word, {}), LastWord::cut) << word;
    const Words six{"0.123456", "-0.0765432", "0.5", "12.3456"};
    EXPECT_EQ(judge_last_word("0.654321", six), LastWord::whole);
    EXPECT_EQ(judge_last_word("0.65432", six), LastWord::open);
    EXPECT_EQ(judge_last_word("1.23456", {"1.23456e-05", "0.123456", "2.5"}), LastWord::open);
    Words fixed, exponents;
    for (int k = 0; k < 20; ++k) {
        fixed.push_back(std::to_string(k) + ".125000");
        exponents.push_back(std::to_string(k % 10) + ".25000" + std::to_string(k) + "e-0" +
                            std::to_string(k % 7 + 1));
    }
    EXPECT_EQ(judge_last_word("33.250000", fixed), LastWord::whole);
    EXPECT_EQ(judge_last_word("33.25000", fixed), LastWord::cut);
}

TEST(CutTextDump, AGrowingFile) {
    const test::TemporaryFolder folder;
    const auto frame = [](int step) {
        return frame_text(std::to_string(step), "2", names,
                          "1 1 0.5\n2 1 0." + std::to_string(step + 1) + "5\n");
    };
    const auto file = folder.write("a", frame(0) + frame(1).substr(0, frame(1).size() - 2));
    const auto dump = open_text(file);
    EXPECT_EQ(dump->moments().size(), 1u);
    EXPECT_FALSE(dump->grow());
    folder.append("a", "5");
    EXPECT_FALSE(dump->grow());  // the number may be whole, but nobody knows
    folder.append("a", "\n");
    EXPECT_TRUE(dump->grow());
    ASSERT_EQ(dump->moments().size(), 2u);
    EXPECT_THAT(column_of(dump->read(1).grains, "x"), ElementsAre(0.5, 0.25));
    EXPECT_THAT(dump->news(), IsEmpty());
    folder.append("a", frame(2) + frame(3) + "ITEM: TI");
    EXPECT_TRUE(dump->grow());
    ASSERT_EQ(dump->moments().size(), 4u);
    EXPECT_THAT(column_of(dump->read(3).grains, "x"), ElementsAre(0.5, 0.45));
    EXPECT_THAT(dump->news()[0], HasSubstr("left out"));

    folder.write("a", frame(0));
    EXPECT_THAT(complaint_about(file, [&] { dump->grow(); }), HasSubstr("became shorter"));
    folder.write("a", frame(5) + frame(6) + frame(7) + frame(8) + frame(9));
    EXPECT_THAT(complaint_about(file, [&] { dump->grow(); }), HasSubstr("was written anew"));
    folder.write("b", frame(0));
    std::filesystem::rename(folder.path() / "b", file);
    EXPECT_THAT(complaint_about(file, [&] { dump->grow(); }), tells({"another file", "this name"}));
    std::filesystem::remove(file);
    EXPECT_THAT(complaint_about(file, [&] { dump->grow(); }), HasSubstr("cannot be opened"));
}

// The only frame is read without its last line feed. When the file goes on, it is another frame.
TEST(CutTextDump, ANumberThatGrows) {
    const test::TemporaryFolder folder;
    const auto dump = open_text(folder.write("a", frame_text("0", "1", names, "1 1 0.2")));
    EXPECT_THAT(column_of(dump->read(0).grains, "x"), ElementsAre(0.2));
    folder.append("a", "5\n");
    dump->grow();
    ASSERT_EQ(dump->moments().size(), 1u);
    EXPECT_THAT(column_of(dump->read(0).grains, "x"), ElementsAre(0.25));
}

}  // namespace
}  // namespace grainreel
