// Tests of the reader of H5MD files.
#include <cmath>

#include "engine/files/foreign/foreign_archive.hpp"
#include "tests/foreign/h5md_file.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {

RawFormat h5md_format();

namespace {

using namespace small_files;
using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;

const RawFormat& format() {
    static const RawFormat one = h5md_format();
    return one;
}

// In frame f, grain i has x = 10 f + i, y = x + 0.25 and z = x + 0.5.
std::vector<double> places(std::size_t frames, std::size_t grains) {
    std::vector<double> all;
    for (std::size_t f = 0; f < frames; ++f)
        for (std::size_t i = 0; i < grains; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                all.push_back(static_cast<double>(10 * f + i) + 0.25 * static_cast<double>(k));
    return all;
}

// As ESPResSo writes it: all elements for each frame, which share their steps and times; packed pieces.
void write_espresso(H5mdBytes& file) {
    const std::string all = "particles/atoms/";
    file.table(all + "position/value", {2, 3, 3}, places(2, 3), H5T_IEEE_F64LE, {1, 3, 3});
    file.table(all + "position/step", {2}, {0, 500}, H5T_STD_I32LE);
    file.table(all + "position/time", {2}, {0, 2.5});
    const std::vector<double> speeds{1, 2, 3, 4, 5, 6, 7, 8, 9, -1, -2, -3, -4, -5, -6, -7, -8, -9};
    file.table(all + "velocity/value", {2, 3, 3}, speeds, H5T_IEEE_F32LE);
    file.table(all + "image/value", {2, 3, 3}, std::vector<double>(18, 0), H5T_STD_I32LE);
    file.table(all + "id/value", {2, 3}, {2, 0, 1, 0, 1, 2}, H5T_STD_I32LE);
    file.table(all + "species/value", {2, 3}, {0, 1, 1, 1, 1, 0}, H5T_STD_I32LE);
    file.table(all + "mass/value", {2, 3}, std::vector<double>(6, 0.125));
    file.table(all + "charge/value", {2, 3}, std::vector<double>(6, 1));
    for (const char* name : {"velocity", "image", "id", "species", "mass", "charge"})
        for (const char* clock : {"/step", "/time"}) file.share(all + "position" + clock, all + name + clock);
    file.table(all + "box/edges", {3}, {10, 20, 30});
    file.words(all + "box", "boundary", {"periodic", "none", "periodic"});
}

std::string espresso() {
    H5mdBytes file;
    write_espresso(file);
    return file.bytes();
}

TEST(H5md, ReadsWhatEspressoWrites) {
    const std::string bytes = espresso();
    ASSERT_TRUE(takes(format(), bytes));
    const OneFile file(bytes);
    const auto opened = format().open(file.path());
    EXPECT_EQ(opened->facts().format, "H5MD");
    EXPECT_EQ(opened->facts().program, "a test 1.2");
    ASSERT_EQ(opened->moments().size(), 2u);
    EXPECT_EQ(opened->moments()[1].step, 500);
    EXPECT_EQ(opened->moments()[1].time, 2.5);
    EXPECT_EQ(opened->moments()[1].grains, 3);
    const RawFrame frame = opened->read(1);
    EXPECT_THAT(column(frame.grains, "x"), ElementsAre(10, 11, 12));
    EXPECT_THAT(column(frame.grains, "z"), ElementsAre(10.5, 11.5, 12.5));
    EXPECT_THAT(column(frame.grains, "velocity:2"), ElementsAre(-3, -6, -9));
    EXPECT_THAT(column(frame.grains, "id"), ElementsAre(0, 1, 2));
    EXPECT_THAT(column(frame.grains, "species"), ElementsAre(1, 1, 0));
    EXPECT_THAT(column(frame.grains, "mass"), ElementsAre(0.125, 0.125, 0.125));
    EXPECT_EQ(frame.box->edges[1], Vec3(0, 20, 0));
    EXPECT_THAT(frame.box->periodic, ElementsAre(true, false, true));
    EXPECT_THAT(news_of(format(), bytes), tells({"no units", "--units"}));
}

// Without radii the message says the option that gives them; then the file is a run.
TEST(H5md, GrainsNeedARadius) {
    const OneFile file(espresso());
    try {
        const ForeignArchive archive(file.path(), {});
        ADD_FAILURE() << "no complaint";
    } catch (const UserError& error) {
        EXPECT_THAT(std::string(error.what()), tells({"no radius", "--radius"}));
    }
    ReadingOptions options;
    options.radius = 0.5;
    const ForeignArchive archive(file.path(), options);
    const State state = archive.grains(0);
    EXPECT_THAT(state.id, ElementsAre(0, 1, 2));
    EXPECT_EQ(state.position[0], Vec3(1, 1.25, 1.5));  // the ids are 2, 0, 1
    EXPECT_EQ(state.velocity[2], Vec3(1, 2, 3));
    EXPECT_THAT(state.species, ElementsAre(1, 1, 0));
}

// As pyh5md writes a bed: fixed steps and times, constant radii, an enumeration of species.
TEST(H5md, ReadsFixedStepsAndConstantElements) {
    H5mdBytes file;
    const std::string all = "particles/all/";
    file.table(all + "position/value", {3, 2, 3}, places(3, 2));
    file.table(all + "position/step", {}, {100}, H5T_STD_I64LE);
    file.number(all + "position/step", "offset", 50);
    file.table(all + "position/time", {}, {0.5});
    file.table(all + "radius", {2}, {0.25, 0.5});
    const hid_t kinds = H5Tenum_create(H5T_STD_I8LE);
    for (const auto& [word, value] : {std::pair("glass", 3), std::pair("lead", 7)}) {
        const auto byte = static_cast<signed char>(value);
        H5Tenum_insert(kinds, word, &byte);
    }
    const hsize_t two = 2;
    const hid_t space = H5Screate_simple(1, &two, nullptr);
    const hid_t data = H5Dcreate2(file.root(), (all + "species").c_str(), kinds, space, H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT);
    const std::array<signed char, 2> values{7, 3};
    H5Dwrite(data, kinds, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(data);
    H5Sclose(space);
    H5Tclose(kinds);
    const OneFile written(file.bytes());
    const auto opened = format().open(written.path());
    ASSERT_EQ(opened->moments().size(), 3u);
    EXPECT_EQ(opened->moments()[2].step, 250);
    EXPECT_EQ(opened->moments()[2].time, 1.0);
    const RawFrame frame = opened->read(2);
    EXPECT_FALSE(frame.box);
    EXPECT_THAT(column(frame.grains, "radius"), ElementsAre(0.25, 0.5));
    EXPECT_THAT(words(frame.grains, "species"), ElementsAre("lead", "glass"));
}

TEST(H5md, UnitsComeFromTheirAttribute) {
    H5mdBytes file;
    const std::string all = "particles/all/";
    file.table(all + "position/value", {1, 2, 3}, places(1, 2));
    file.table(all + "position/step", {1}, {7}, H5T_STD_I32LE);
    file.table(all + "position/time", {1}, {4});
    file.table(all + "velocity/value", {1, 2, 3}, {1, 2, 3, 4, 5, 6});
    file.share(all + "position/step", all + "velocity/step");
    file.table(all + "radius", {2}, {500, 250});
    file.free_word(all + "position/value", "unit", "mm");
    file.word(all + "position/time", "unit", "ms");
    file.word(all + "velocity/value", "unit", "cm s-1");
    file.word(all + "radius", "unit", "um");
    const OneFile written(file.bytes());
    const ForeignArchive archive(written.path(), {});
    EXPECT_EQ(archive.moments()[0].time, 0.004);
    const State state = archive.grains(0);
    EXPECT_NEAR(state.position[1].x(), 1e-3, 1e-18);
    EXPECT_NEAR(state.velocity[1].z(), 0.06, 1e-15);
    EXPECT_NEAR(state.radius[0], 5e-4, 1e-16);
    EXPECT_THAT(news_of(format(), test::text_of(written.path())), testing::Not(HasSubstr("units")));
}

// Rows whose id is negative are no grains: their number changes.
TEST(H5md, RowsWithoutAnIdAreNoGrains) {
    H5mdBytes file;
    const std::string all = "particles/all/";
    file.table(all + "position/value", {2, 3, 3}, places(2, 3));
    file.table(all + "id/value", {2, 3}, {4, 9, -1, -1, 9, 4}, H5T_STD_I32LE);
    file.table(all + "radius", {3}, {1, 2, 3});
    const std::string bytes = file.bytes();
    EXPECT_THAT(counts(format(), bytes), ElementsAre(2, 2));
    EXPECT_THAT(column(frame_of(format(), bytes, 1).grains, "x"), ElementsAre(11, 12));
    EXPECT_THAT(column(frame_of(format(), bytes, 1).grains, "radius"), ElementsAre(2, 3));
}

// An element that was sampled at other steps is found by its step, and is unknown where it has none.
TEST(H5md, ElementsOfOtherStepsAreMatched) {
    H5mdBytes file;
    const std::string all = "particles/all/";
    file.table(all + "position/value", {3, 1, 3}, places(3, 1));
    file.table(all + "position/step", {3}, {0, 10, 20}, H5T_STD_I32LE);
    file.table(all + "velocity/value", {2, 1, 3}, {1, 1, 1, 2, 2, 2});
    file.table(all + "velocity/step", {2}, {0, 20}, H5T_STD_I32LE);
    const std::string bytes = file.bytes();
    EXPECT_THAT(column(frame_of(format(), bytes, 2).grains, "velocity:0"), ElementsAre(2));
    EXPECT_TRUE(std::isnan(column(frame_of(format(), bytes, 1).grains, "velocity:0").front()));
}

TEST(H5md, WhatIsMissingIsNamed) {
    H5mdBytes none;
    none.group("particles/all/box");
    EXPECT_THAT(complaint_of(format(), none.bytes()), tells({"H5MD without places", "position"}));
    H5mdBytes flat;
    flat.table("particles/all/position/value", {4, 3}, std::vector<double>(12, 1));
    EXPECT_THAT(complaint_of(format(), flat.bytes()), tells({"particles/all/position", "places"}));
    H5mdBytes steps;
    steps.table("particles/all/position/value", {2, 1, 3}, places(2, 1));
    steps.group("particles/all/position/step");
    EXPECT_THAT(counts(format(), steps.bytes()), ElementsAre(1, 1));
    H5mdBytes other(false);
    other.table("things/position", {1, 1, 3}, places(1, 1));
    EXPECT_THAT(complaint_of(format(), other.bytes()), tells({"HDF5", "AMBER"}));
}

TEST(H5md, OtherTypesThanNumbersAreRefused) {
    H5mdBytes file;
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, 8);
    file.table("particles/all/position/value", {1, 1, 3}, {}, text);
    H5Tclose(text);
    EXPECT_THAT(complaint_of(format(), file.bytes()), tells({"position/value", "no numbers"}));
}

// No memory is asked for because of a size that stands in the file alone.
TEST(H5md, SizesThatTheFileCannotHoldAreRefused) {
    H5mdBytes huge;
    huge.table("particles/all/position/value", {1000000, 1000000, 3}, {}, H5T_IEEE_F64LE, {1, 100, 3});
    EXPECT_THAT(complaint_of(format(), huge.bytes()), tells({"position/value", "bytes", "cannot hold"}));
    H5mdBytes many;
    many.table("particles/all/position/value", {hsize_t{1} << 60, 0, 3}, {}, H5T_IEEE_F64LE, {1, 1, 3});
    EXPECT_THAT(complaint_of(format(), many.bytes()), tells({"frames"}));
    H5mdBytes chunk;
    chunk.table("particles/all/position/value", {1, 2, 3}, places(1, 2), H5T_IEEE_F64LE, {1, 800000, 3});
    EXPECT_THAT(complaint_of(format(), chunk.bytes()), tells({"position/value", "pieces", "too many"}));
}

TEST(H5md, LinksToOtherFilesAreNotFollowed) {
    H5mdBytes other(false);
    other.table("value", {1, 2, 3}, places(1, 2));
    const OneFile target(other.bytes(), "target.h5");
    H5mdBytes file;
    file.group("particles/all/position");
    H5Lcreate_external(target.path().c_str(), "value", file.root(), "particles/all/position/value",
                       H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_THAT(complaint_of(format(), file.bytes()), tells({"H5MD without places"}));
}

TEST(H5md, ACutFileIsRefused) {
    const std::string bytes = espresso();
    EXPECT_THAT(complaint_of(format(), bytes.substr(0, bytes.size() - 1)), tells({"is cut off"}));
}

// Whatever value a byte gets, the file is read or refused.
TEST(H5md, AnyByteMayBeWrong) {
    const std::string bytes = espresso();
    for (std::size_t place = 8; place < bytes.size(); place += bytes.size() / 40) {
        std::string damaged = bytes;
        damaged[place] = static_cast<char>(damaged[place] ^ 0xff);
        complaint_of(format(), damaged);
    }
}

}  // namespace
}  // namespace grainreel
