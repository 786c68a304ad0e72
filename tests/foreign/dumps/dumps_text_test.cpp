// Tests of text dumps with all that programs write into them, one peculiarity after the other.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(TextDump, RowsInAnyOrderAndFramesThatComeAndGo) {
    const test::TemporaryFolder folder;
    const std::string names = "id type x y z radius";
    const auto file =
        folder.write("a", frame_text("0", "0", names, "") +
                              frame_text("100", "2", names, "9 2 .4 0 5e-2 0.0025\n7 1 0 -0 +0.04 2E-3\n") +
                              frame_text("5000000000", "1", names, "9 2 0.004 0 0.04 0.0025\n") +
                              frame_text("100", "0", names, ""));
    const auto dump = open_text(file);
    ASSERT_EQ(dump->moments().size(), 4u);
    std::vector<std::int64_t> steps, grains;
    for (const RawMoment& moment : dump->moments()) {
        steps.push_back(moment.step.value_or(-1));
        grains.push_back(moment.grains);
        EXPECT_FALSE(moment.time || moment.has_contacts);
    }
    EXPECT_THAT(steps, ElementsAre(0, 100, 5000000000,
                                   100));  // a step that comes twice stays, because the series decides
    EXPECT_THAT(grains, ElementsAre(0, 2, 1, 0));
    EXPECT_THAT(dump->news(), IsEmpty());
    // The frames are read from the last to the first.
    EXPECT_EQ(dump->read(3).grains.rows, 0u);
    EXPECT_THAT(column_of(dump->read(2).grains, "x"), ElementsAre(0.004));
    const RawFrame frame = dump->read(1);
    EXPECT_EQ(frame.step, 100);
    EXPECT_THAT(column_of(frame.grains, "id"), ElementsAre(9, 7));
    EXPECT_THAT(column_of(frame.grains, "x"), ElementsAre(0.4, 0));
    EXPECT_THAT(column_of(frame.grains, "z"), ElementsAre(0.05, 0.04));
    EXPECT_THAT(column_of(frame.grains, "radius"), ElementsAre(0.0025, 0.002));
    EXPECT_EQ(dump->read(0).grains.columns.size(), 6u);
    EXPECT_EQ(dump->facts().format, "LAMMPS text dump");
}

TEST(TextDump, UnitsTimeLabelsAndUnknownItems) {
    const test::TemporaryFolder folder;
    const std::string names = "id x";
    const auto file = folder.write(
        "a", "ITEM: UNITS\ncgs\nITEM: TIME\n0.5\n" + frame_text("1", "1", names, "1 2\n") +
                 "ITEM: LABEL\nmy grains\nITEM: SOMETHING NEW\n1 2 3\nany words\n\nITEM: TIME\n0.75\n" +
                 frame_text("2", "1", names, "1 3\n"));
    const auto dump = open_text(file);
    EXPECT_EQ(dump->facts().units, "cgs");
    ASSERT_EQ(dump->moments().size(), 2u);
    EXPECT_EQ(dump->moments()[0].time, 0.5);
    EXPECT_EQ(dump->moments()[1].time, 0.75);
    EXPECT_EQ(dump->read(1).time, 0.75);
    EXPECT_THAT(column_of(dump->read(1).grains, "x"), ElementsAre(3));
}

TEST(TextDump, LineEndsBlanksTabsAndNoLastLineFeed) {
    const test::TemporaryFolder folder;
    const std::string plain = frame_text("0", "2", "id type x", "1 1 0.5\n2 1 0.25\n");
    std::string windows;
    for (const char c : plain) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const std::string blank = "\n" + frame_text("0", "2", "id type x ", "1 1 0.5 \n\n \n2\t1  0.25 \n\n  \n");
    for (const std::string& text : {plain, windows, blank, plain.substr(0, plain.size() - 1)}) {
        const auto dump = open_text(folder.write("a", text));
        ASSERT_EQ(dump->moments().size(), 1u) << text;
        EXPECT_THAT(column_of(dump->read(0).grains, "x"), ElementsAre(0.5, 0.25)) << text;
        EXPECT_EQ(dump->read(0).grains.columns.back().name, "x");
    }
}

// An editor on Windows may put a byte order mark before the first item.
TEST(TextDump, AByteOrderMarkIsPassedOver) {
    const test::TemporaryFolder folder;
    const auto file =
        folder.write("marked", "\xef\xbb\xbf" + frame_text("0", "1", "id x y z radius", "9 1 2 3 4\n") +
                                   frame_text("7", "1", "id x y z radius", "9 5 2 3 4\n"));
    const auto dump = open_text(file);
    ASSERT_EQ(dump->moments().size(), 2u);
    EXPECT_THAT(column_of(dump->read(1).grains, "x"), ElementsAre(5));
    EXPECT_THAT(column_of(dump->read(0).grains, "x"), ElementsAre(1));
}

TEST(TextDump, DoubledNamesAndWords) {
    const test::TemporaryFolder folder;
    const auto dump =
        open_text(folder.write("a", frame_text("0", "3", "id type type element c_1[2]",
                                               "1 1 5 Si nan\n2 1 6 O -inf\n3 2 7 Si 1e-400\n")));
    const RawTable grains = dump->read(0).grains;
    EXPECT_THAT(column_of(grains, "type"), ElementsAre(1, 1, 2));  // find() takes the first
    EXPECT_EQ(grains.columns[2].name, "type");
    EXPECT_THAT(grains.columns[2].values, ElementsAre(5, 6, 7));
    EXPECT_THAT(grains.find("element")->words, ElementsAre("Si", "O"));
    EXPECT_THAT(column_of(grains, "element"), ElementsAre(0, 1, 0));
    const std::vector<double> computed = column_of(grains, "c_1[2]");
    EXPECT_TRUE(std::isnan(computed[0]));
    EXPECT_EQ(computed[1], -std::numeric_limits<double>::infinity());
    EXPECT_EQ(computed[2], 0);
}

TEST(TextDump, PairsAreContacts) {
    const test::TemporaryFolder folder;
    const std::string box = "ITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\n";
    const auto dump = open_text(folder.write(
        "a", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n0\n" + box +
                 "ITEM: ENTRIES index c_p[1] c_p[2] \n" + "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ENTRIES\n2\n" +
                 box + "ITEM: ENTRIES index c_p[1] c_p[2] \n1 4 5 \n1 4 6 \n"));
    ASSERT_EQ(dump->moments().size(), 2u);
    EXPECT_TRUE(dump->moments()[1].has_contacts);
    EXPECT_EQ(dump->moments()[1].grains, 0);
    const RawFrame frame = dump->read(1);
    EXPECT_EQ(frame.grains.rows, 0u);
    EXPECT_THAT(column_of(frame.contacts, "c_p[2]"), ElementsAre(5, 6));
}

std::string old_frame(const std::string& bounds, const std::string& rows, int count) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(count) + "\nITEM: BOX BOUNDS\n" +
           bounds + bounds + bounds + "ITEM: ATOMS\n" + rows;
}

std::vector<std::string> names_in(const RawFile& dump) {
    std::vector<std::string> names;
    for (const RawColumn& column : dump.read(0).grains.columns) names.push_back(column.name);
    return names;
}

TEST(TextDump, OldFilesWithoutNames) {
    const test::TemporaryFolder folder;
    const auto scaled = open_text(
        folder.write("a", old_frame("-9 12\n", "1 1 0.1 0.2 0.3 0 0 -1\n2 1 1.01 0.5 0 0 0 0\n", 2)));
    EXPECT_THAT(names_in(*scaled), ElementsAre("id", "type", "xs", "ys", "zs", "ix", "iy", "iz"));
    ASSERT_EQ(scaled->news().size(), 1u);
    EXPECT_THAT(scaled->news()[0], tells({"not name its columns", "id type xs ys zs ix iy iz"}));
    EXPECT_FALSE(scaled->read(0).box->periodic[0]);
    const auto in_metres = open_text(folder.write("b", old_frame("-9 12\n", "1 1 3 0.2 0.3\n", 1)));
    EXPECT_THAT(names_in(*in_metres), ElementsAre("id", "type", "x", "y", "z"));
    // In a box of 2 m, places up to 0.75 fill more of the box if they are fractions of it.
    const auto few =
        open_text(folder.write("d", old_frame("0 2\n", "1 1 0.5 0.5 0.25\n2 1 0.75 0.5 0.25\n", 2)));
    EXPECT_THAT(names_in(*few), ElementsAre("id", "type", "xs", "ys", "zs"));
    // The places are between 0 and 1 because the box is small.
    const auto small = open_text(
        folder.write("c", old_frame("0 0.02\n", "1 1 0.01 0.015 0.002\n2 1 0.019 0.001 0.01\n", 2)));
    EXPECT_THAT(names_in(*small), ElementsAre("id", "type", "x", "y", "z"));
    const auto other = open_text(folder.write("d", old_frame("0 1\n", "1 2 3\n", 1)));
    EXPECT_THAT(names_in(*other), ElementsAre("c1", "c2", "c3"));
}

TEST(TextDump, PackedFramesInAnyOrder) {
    const test::TemporaryFolder folder;
    std::string first, second;
    for (int k = 0; k < 3; ++k)
        first += frame_text(std::to_string(k), "1", "id x", "1 " + std::to_string(10 + k) + "\n");
    for (int k = 3; k < 5; ++k)
        second += frame_text(std::to_string(k), "1", "id x", "1 " + std::to_string(10 + k) + "\n");
    for (const std::string& packed : {gzip_of(first) + gzip_of(second), zstd_of(first + second)}) {
        const auto dump = open_text(folder.write("a", packed));
        ASSERT_EQ(dump->moments().size(), 5u);
        for (const std::size_t k : {0u, 1u, 4u, 2u, 3u, 0u})
            EXPECT_THAT(column_of(dump->read(k).grains, "x"), ElementsAre(10.0 + static_cast<double>(k)));
    }
}

// The reader's buffer holds more than two of these frames, so reading each frame anew takes over twice the
// file.
TEST(TextDump, FramesInOrderAreReadOnce) {
    const test::TemporaryFolder folder;
    std::string rows;
    for (int i = 1; i <= 6000; ++i) rows += std::to_string(i) + " 1 0.0012345 0.0023456 0.0034567\n";
    std::string text;
    for (int k = 0; k < 30; ++k) text += frame_text(std::to_string(10 * k), "6000", "id type x y z", rows);
    const std::unique_ptr<RawFile> dump = open_text(folder.write("a.dump", text));
    const std::int64_t before = bytes_read();
    for (std::size_t k = 0; k < 30; ++k) ASSERT_EQ(column_of(dump->read(k).grains, "id").size(), 6000u);
    EXPECT_LT(static_cast<double>(bytes_read() - before), 1.1 * static_cast<double>(text.size()));
}

// The file is larger than a reader's buffer of lines, and each row has its own formula.
TEST(TextDump, ManyRows) {
    constexpr int count = 60000;
    const test::TemporaryFolder folder;
    std::string rows;
    for (int k = 0; k < count; ++k)
        rows += std::to_string(k + 1) + " " + std::to_string(k * 0.125) + " 1e-3 \n";
    const auto dump = open_text(folder.write("a", frame_text("0", std::to_string(count), "id x y ", rows)));
    const RawTable grains = dump->read(0).grains;
    ASSERT_EQ(grains.rows, std::size_t{count});
    for (std::size_t k = 0; k < grains.rows; ++k) {
        ASSERT_EQ(grains.columns[0].values[k], static_cast<double>(k + 1));
        ASSERT_EQ(grains.columns[1].values[k], static_cast<double>(k) * 0.125);
        ASSERT_EQ(grains.columns[2].values[k], 1e-3);
    }
}

TEST(TextDump, WhatIsTaken) {
    const auto takes = [](std::string text) {
        FileStart head;
        head.bytes = std::move(text);
        return lammps_text_format().takes(head);
    };
    EXPECT_TRUE(takes("ITEM: TIMESTEP\n0\n"));
    EXPECT_TRUE(takes("ITEM: UNITS\nlj\n"));
    EXPECT_TRUE(takes("DUMMY\n0\nITEM: NUMBER OF ATOMS\n"));
    EXPECT_FALSE(takes("id,x,y,z\n1,2,3,4\n"));
    EXPECT_FALSE(takes(std::string("\0\0\nITEM: TIMESTEP", 17)));
    EXPECT_FALSE(takes("LAMMPS data file, see ITEM: TIMESTEP"));
    EXPECT_FALSE(takes(""));
}

}  // namespace
}  // namespace grainreel
