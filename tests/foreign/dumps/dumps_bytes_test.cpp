// Tests of the bytes that readers get from packed files.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <random>

#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using test::tells_only;
using testing::HasSubstr;

// Bytes that do not pack to almost nothing, so that packed pieces have ends.
std::string numbers(std::size_t count) {
    std::mt19937 random(7);
    std::string text;
    while (text.size() < count) text += std::to_string(random() % 100000) + "\n";
    return text.substr(0, count);
}

void expect_all_and_any_place(const std::filesystem::path& file, const std::string& content) {
    EXPECT_EQ(all_bytes(file), content);
    const std::unique_ptr<ByteSource> source = open_bytes(file);
    const std::size_t size = content.size();
    for (const std::size_t place : {size / 2, std::size_t{3}, size - 5, std::size_t{0}, size / 3, size}) {
        source->seek(place);
        std::string read(100, '\0');
        read.resize(source->read(read.data(), read.size()));
        EXPECT_EQ(read, content.substr(place, 100)) << place;
    }
    EXPECT_FALSE(source->cut_off());
}

TEST(PackedBytes, AllPackingsGiveTheSame) {
    const test::TemporaryFolder folder;
    const std::string one = numbers(700000), two = numbers(1000);
    expect_all_and_any_place(folder.write("a", one), one);
    // The suffix is not used.
    expect_all_and_any_place(folder.write("b.txt", gzip_of(one)), one);
    expect_all_and_any_place(folder.write("c", gzip_of(one) + gzip_of(two)), one + two);
    expect_all_and_any_place(
        folder.write("d", gzip_of(two) + gzip_of("") + gzip_of(one) + std::string(512, '\0')), two + one);
    expect_all_and_any_place(folder.write("e.gz", zstd_of(one)), one);
    expect_all_and_any_place(folder.write("f", zstd_of(two) + zstd_of(one)), two + one);
    const std::string skipped("\x50\x2A\x4D\x18\3\0\0\0abc", 11);
    expect_all_and_any_place(folder.write("g", skipped + zstd_of(one)), one);
    EXPECT_EQ(packing_of(folder.path() / "c"), Packing::gzip);
    EXPECT_EQ(packing_of(folder.path() / "g"), Packing::zstd);
    EXPECT_EQ(packing_of(folder.path() / "a"), Packing::none);
    EXPECT_EQ(all_bytes(folder.write("h", "")), "");
}

TEST(PackedBytes, AHeadIsUnpacked) {
    const test::TemporaryFolder folder;
    const std::string all = numbers(200000);
    const FileStart head = unpacked_head(folder.write("a", gzip_of(all)));
    EXPECT_EQ(head.bytes, all.substr(0, kHeadBytes));
    EXPECT_EQ(head.size, std::filesystem::file_size(folder.path() / "a"));
    EXPECT_FALSE(head.folder);
}

TEST(PackedBytes, WhatIsCutGivesWhatThereIs) {
    const test::TemporaryFolder folder;
    const std::string all = numbers(300000);
    for (const std::string& packed : {gzip_of(all), zstd_of(all), gzip_of(numbers(10)) + gzip_of(all)}) {
        const auto file = folder.write("a", packed.substr(0, packed.size() - 1000));
        const std::unique_ptr<ByteSource> source = open_bytes(file);
        std::string read(all.size() + 100, '\0');
        read.resize(source->read(read.data(), read.size()));
        EXPECT_TRUE(source->cut_off());
        const std::string expected = packed == gzip_of(numbers(10)) + gzip_of(all) ? numbers(10) + all : all;
        EXPECT_EQ(read, expected.substr(0, read.size()));
        EXPECT_GT(read.size(), expected.size() / 2);
        EXPECT_LT(read.size(), expected.size());
    }
    // The file ends within the head of a member.
    const auto file = folder.write("b", gzip_of("abc") + std::string("\x1f"));
    const std::unique_ptr<ByteSource> source = open_bytes(file);
    char read[10];
    EXPECT_EQ(source->read(read, sizeof read), 3u);
    EXPECT_TRUE(source->cut_off());
}

TEST(PackedBytes, DamageIsSaidWithItsPlace) {
    const test::TemporaryFolder folder;
    std::string packed = gzip_of(numbers(300000));
    for (std::size_t k = 0; k < 100; ++k) packed[packed.size() / 2 + k] = static_cast<char>(k);
    const auto damaged = folder.write("a", packed);
    EXPECT_THAT(complaint_about(damaged, [&] { all_bytes(damaged); }),
                HasSubstr("the packed content is damaged"));
    const auto garbage = folder.write("b", gzip_of("abc") + "xyz");
    EXPECT_THAT(complaint_about(garbage, [&] { all_bytes(garbage); }), HasSubstr("bytes that are no gzip"));
    std::string flipped = zstd_of(numbers(300000));
    for (std::size_t k = 20; k < 60; ++k) flipped[k] = static_cast<char>(~flipped[k]);
    const auto zstd = folder.write("c", flipped);
    EXPECT_THAT(complaint_about(zstd, [&] { all_bytes(zstd); }), HasSubstr("the packed content is damaged"));
}

TEST(PackedBytes, OtherPackingsAreRefusedByName) {
    const test::TemporaryFolder folder;
    const auto complaint = [&](std::string_view bytes) {
        const auto file = folder.write("a.x", bytes);
        return complaint_about(file, [&] { unpacked_head(file); });
    };
    EXPECT_THAT(complaint(std::string_view("\xFD"
                                           "7zXZ\0abc",
                                           9)),
                tells_only({": packed with xz", "not read", "xz -d a.x"}));
    EXPECT_THAT(complaint("BZh91AY&SYabcdef"), tells({"bzip2", "not read", "unpack"}));
    EXPECT_THAT(complaint(std::string_view("]\0\0\x80\0\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\0abc", 17)),
                HasSubstr("packed with lzma"));
    EXPECT_THAT(complaint(std::string_view("PK\x03\x04\0\0\0\0", 8)), HasSubstr("packed with zip"));
    EXPECT_EQ(complaint("BZh is no packing but three letters"), "no complaint");
}

TEST(PackedBytes, OnlyOrdinaryFiles) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(complaint_about(folder.path(), [&] { open_bytes(folder.path()); }), HasSubstr("is a folder"));
    const auto pipe = folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(complaint_about(pipe, [&] { open_bytes(pipe); }), HasSubstr("is a pipe"));
    const auto none = folder.path() / "none";
    EXPECT_THAT(complaint_about(none, [&] { unpacked_head(none); }),
                tells({"cannot be opened", "No such file"}));
}

// A small file unpacks to many bytes.
TEST(PackedBytes, NoMoreThanIsAllowed) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("a", gzip_of(std::string(5 << 20, 'a')));
    EXPECT_THAT(complaint_about(file, [&] { all_bytes(file, 4 << 20); }), HasSubstr("holds more than 4 MB"));
    EXPECT_EQ(all_bytes(file, 5 << 20).size(), std::size_t{5} << 20);
}

}  // namespace
}  // namespace grainreel
