// Tests of the index of a dump that is kept between two calls.
#include <gmock/gmock.h>

#include <cstdlib>

#include "engine/files/foreign/dumps/index_file.hpp"
#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::ElementsAre;

TextIndex index_of(const std::filesystem::path& file) {
    TextIndex index;
    LineReader lines(file);
    index.go_on(lines, file);
    return index;
}

std::string frames(int count) {
    std::string text = "ITEM: UNITS\nsi\n";
    for (int k = 0; k < count; ++k)
        text += "ITEM: TIME\n" + std::to_string(0.25 * k) + "\n" +
                frame_text(std::to_string(10 * k), "1", "id x", "1 " + std::to_string(k) + "\n");
    return text;
}

void expect_same(const TextIndex& a, const TextIndex& b) {
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (std::size_t k = 0; k < a.frames.size(); ++k) {
        EXPECT_EQ(a.frames[k].place, b.frames[k].place);
        EXPECT_EQ(a.frames[k].end, b.frames[k].end);
        EXPECT_EQ(a.frames[k].line, b.frames[k].line);
        EXPECT_EQ(a.frames[k].step, b.frames[k].step);
        EXPECT_EQ(a.frames[k].time, b.frames[k].time);
        EXPECT_EQ(a.frames[k].rows, b.frames[k].rows);
    }
    EXPECT_EQ(a.names, b.names);
    EXPECT_EQ(a.units, b.units);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.end_line, b.end_line);
    EXPECT_EQ(a.cut.has_value(), b.cut.has_value());
}

TEST(DumpIndex, ThroughBytesAndBack) {
    const test::TemporaryFolder folder;
    const TextIndex index = index_of(folder.write("a", frames(5) + "ITEM: TIME\n"));
    ASSERT_EQ(index.frames.size(), 5u);
    const std::string bytes = index_bytes(index);
    const std::optional<TextIndex> back = index_of_bytes(bytes);
    ASSERT_TRUE(back);
    expect_same(*back, index);
    EXPECT_TRUE(back->cut->in_head);
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        std::string damaged = bytes;
        damaged[k] = static_cast<char>(damaged[k] ^ 0x10);
        EXPECT_FALSE(index_of_bytes(damaged)) << k;
        EXPECT_FALSE(index_of_bytes(bytes.substr(0, k))) << k;
    }
}

TEST(DumpIndex, BelongsToOneStateOfTheFile) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("a", frames(5));
    const auto state = [&] { return FileBytes(file).state(); };
    EXPECT_FALSE(kept_index(file, state()));
    keep_index(file, state(), index_of(file));
    const auto beside = folder.path() / ".a.grainreel-index";
    EXPECT_TRUE(std::filesystem::exists(beside));
    std::optional<KeptIndex> kept = kept_index(file, state());
    ASSERT_TRUE(kept && kept->of_now);
    expect_same(kept->index, index_of(file));

    folder.append("a",
                  frames(1).substr(15));  // longer: the index is used, and the pass continues from its end
    kept = kept_index(file, state());
    ASSERT_TRUE(kept);
    EXPECT_FALSE(kept->of_now);
    LineReader lines(file);
    kept->index.go_on(lines, file);
    expect_same(kept->index, index_of(file));

    std::string other = frames(6);
    other[2] = 'X';
    folder.write("a", other);  // the inode is the same and the file longer, but its head is another one
    EXPECT_FALSE(kept_index(file, state()));
    folder.write("a", frames(3));
    EXPECT_FALSE(kept_index(file, state()));
    folder.write("b", frames(5));
    std::filesystem::rename(folder.path() / "b", file);  // the same bytes in another file
    EXPECT_FALSE(kept_index(file, state()));
    keep_index(file, state(), index_of(file));
    EXPECT_TRUE(kept_index(file, state()));
    folder.write(".a.grainreel-index", "nonsense");
    EXPECT_FALSE(kept_index(file, state()));
}

// If no index can be written beside the file, it goes to the user's cache.
TEST(DumpIndex, GoesToTheCacheWhereItMust) {
    const test::TemporaryFolder folder, cache;
    const char* const before = std::getenv("XDG_CACHE_HOME");
    const std::string kept_before = before == nullptr ? "" : before;
    ::setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
    const auto file = folder.write("a", frames(2));
    std::filesystem::create_directories(folder.path() / ".a.grainreel-index" / "in the way");
    keep_index(file, FileBytes(file).state(), index_of(file));
    const auto places = index_places(file);
    ASSERT_EQ(places.size(), 2u);
    EXPECT_TRUE(places[1].string().starts_with(cache.path().string() + "/grainreel/indices/"));
    EXPECT_TRUE(std::filesystem::is_regular_file(places[1]));
    EXPECT_TRUE(kept_index(file, FileBytes(file).state()));
    if (before == nullptr)
        ::unsetenv("XDG_CACHE_HOME");
    else
        ::setenv("XDG_CACHE_HOME", kept_before.c_str(), 1);
}

// Everybody may make files beside a dump in /tmp. So an index counts only if the user, or the owner of the
// dump, has made it, and if it is no link.
TEST(DumpIndex, OfSomebodyElseIsNotBelieved) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("a", frames(2));
    const auto index = folder.path() / ".a.grainreel-index";
    keep_index(file, FileBytes(file).state(), index_of(file));
    EXPECT_TRUE(kept_index(file, FileBytes(file).state()));
    std::filesystem::rename(index, folder.path() / "elsewhere");
    std::filesystem::create_symlink(folder.path() / "elsewhere", index);
    EXPECT_FALSE(kept_index(file, FileBytes(file).state()));
    std::filesystem::rename(folder.path() / "elsewhere", index);
    ::chmod(index.c_str(), 0666);
    EXPECT_FALSE(kept_index(file, FileBytes(file).state())) << "everybody may write it";
    ::chmod(index.c_str(), 0644);
    EXPECT_TRUE(kept_index(file, FileBytes(file).state()));
    constexpr uid_t kOther = 54321;
    if (::chown(index.c_str(), kOther, kOther) != 0) return;  // only root may give a file away
    EXPECT_FALSE(kept_index(file, FileBytes(file).state()));
    if (::chown(file.c_str(), kOther, kOther) != 0) return;
    keep_index(file, FileBytes(file).state(), index_of(file));  // the owner is a part of the dump's state
    if (::chown(index.c_str(), kOther, kOther) != 0) return;
    EXPECT_TRUE(kept_index(file, FileBytes(file).state())) << "it belongs to the owner of the dump";
}

// The second time, a large dump is opened by its index: a wrong step in the index is found in the result.
TEST(DumpIndex, OfALargeDumpIsUsed) {
    const test::TemporaryFolder folder;
    std::string rows;
    for (int k = 1; k <= 1000; ++k)
        rows += std::to_string(k) + " 0.12345678901234567 0.12345678901234567 0.12345678901234567\n";
    std::string text;
    int count = 0;
    for (; text.size() < long_pass; ++count)
        text += frame_text(std::to_string(count), "1000", "id x y z", rows);
    const auto file = folder.write("a", text);
    const auto index_path = folder.path() / ".a.grainreel-index";
    ASSERT_EQ(open_text(file)->moments().size(), static_cast<std::size_t>(count));
    ASSERT_TRUE(std::filesystem::exists(index_path));

    TextIndex index = index_of(file);
    index.frames[1].step = 77;
    keep_index(file, FileBytes(file).state(), index);
    const auto dump = open_text(file);
    EXPECT_EQ(dump->moments()[1].step, 77);
    EXPECT_EQ(dump->read(2).grains.rows, 1000u);
    EXPECT_THAT(complaint_about(file, [&] { dump->read(1); }), tells({"step 77", "no longer here"}));
}

}  // namespace
}  // namespace grainreel
