// Tests of binary dumps, which are written here number by number.
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Rows = std::vector<std::vector<double>>;

// Writes numbers in either byte order.
class Writer {
  public:
    explicit Writer(bool swapped) : swapped_(swapped) {}

    template <class Number>
    Writer& add(Number number) {
        std::string bytes(sizeof number, '\0');
        std::memcpy(bytes.data(), &number, sizeof number);
        if (swapped_) std::reverse(bytes.begin(), bytes.end());
        bytes_ += bytes;
        return *this;
    }
    Writer& text(std::string_view text) {
        bytes_ += text;
        return *this;
    }
    Writer& counted(std::string_view words) {
        return add(static_cast<std::int32_t>(words.size())).text(words);
    }
    Writer& doubles(const std::vector<double>& values) {
        for (const double value : values) add(value);
        return *this;
    }
    // Writes one part for each process.
    Writer& parts(const std::vector<Rows>& parts) {
        add(static_cast<std::int32_t>(parts.size()));
        for (const Rows& rows : parts) {
            add(static_cast<std::int32_t>(rows.empty() ? 0 : rows.size() * rows[0].size()));
            for (const std::vector<double>& row : rows) doubles(row);
        }
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    bool swapped_;
    std::string bytes_;
};

constexpr const char* four = "id x y z";
const std::vector<double> straight{-1, 1, 0, 2, 0, 3};

struct State {
    std::int64_t step = 0, claimed = 2;
    std::vector<Rows> parts{{{1, 0.1, 0.2, 0.3}}, {{2, 0.4, 0.5, 0.6}}};
    std::int32_t tilted = 0;
    std::vector<double> box = straight;
    std::string units{}, names = four;
    std::optional<double> time{};
};

// A frame in the form that LAMMPS has written since 2021.
std::string new_frame(const State& f, bool swapped = false) {
    Writer out(swapped);
    out.add(std::int64_t{-10})
        .text("DUMPCUSTOM")
        .add(std::int32_t{1})
        .add(std::int32_t{2})
        .add(f.step)
        .add(f.claimed);
    out.add(f.tilted);
    for (const std::int32_t flag : {0, 0, 1, 1, 2, 3}) out.add(flag);
    out.doubles(f.box).add(std::int32_t{4}).counted(f.units).add(static_cast<char>(f.time ? 1 : 0));
    if (f.time) out.add(*f.time);
    return out.counted(f.names).parts(f.parts).bytes();
}

struct OldForm {
    bool swapped = false, narrow = false, flags = true, tilted = false;
};

std::string old_frame(const OldForm& form, std::int64_t step, const std::vector<Rows>& parts,
                      std::int64_t count) {
    Writer out(form.swapped);
    for (const std::int64_t number : {step, count}) {
        if (form.narrow)
            out.add(static_cast<std::int32_t>(number));
        else
            out.add(number);
    }
    if (form.flags) {
        out.add(std::int32_t{form.tilted ? 1 : 0});
        for (const std::int32_t flag : {0, 0, 1, 1, 2, 3}) out.add(flag);
    }
    out.doubles(straight);
    if (form.tilted) out.doubles({0.5, 0, 0});
    return out.add(std::int32_t{4}).parts(parts).bytes();
}

std::unique_ptr<RawFile> open_binary(const std::filesystem::path& file) {
    EXPECT_TRUE(lammps_binary_format().takes(unpacked_head(file))) << file;
    return lammps_binary_format().open(file);
}

std::string binary_complaint(const test::TemporaryFolder& folder, std::string_view bytes) {
    const auto file = folder.write("a.bin", bytes);
    return complaint_about(file, [&] {
        const auto dump = lammps_binary_format().open(file);
        for (std::size_t k = 0; k < dump->moments().size(); ++k) dump->read(k);
    });
}

TEST(BinaryDump, WithNamesInBothByteOrders) {
    const test::TemporaryFolder folder;
    for (const bool swapped : {false, true}) {
        State second{5000000000, 0, {{}, {}}};
        second.time = 0.75;
        State first;
        first.units = "si";
        first.time = 0.5;
        const std::string bytes =
            new_frame(first, swapped) + new_frame(second, swapped) + new_frame(first, swapped);
        for (const std::string& packed : {bytes, gzip_of(bytes), zstd_of(bytes)}) {
            const auto dump = open_binary(folder.write("a", packed));
            ASSERT_EQ(dump->moments().size(), 3u);
            EXPECT_EQ(dump->facts().units, "si");
            EXPECT_EQ(dump->facts().format, "LAMMPS binary dump");
            EXPECT_EQ(dump->moments()[1].step, 5000000000);
            EXPECT_EQ(dump->moments()[1].time, 0.75);
            EXPECT_EQ(dump->moments()[0].grains, 2);
            EXPECT_THAT(dump->news(), IsEmpty());
            for (const std::size_t k : {2u, 0u}) {
                const RawFrame frame = dump->read(k);
                EXPECT_EQ(frame.step, 0);
                EXPECT_EQ(frame.time, 0.5);
                EXPECT_THAT(column_of(frame.grains, "id"), ElementsAre(1, 2));
                EXPECT_THAT(column_of(frame.grains, "z"), ElementsAre(0.3, 0.6));
                EXPECT_EQ(frame.box->periodic, (std::array{true, false, false}));
                EXPECT_EQ(frame.box->edges[1], Vec3(0, 2, 0));
            }
            EXPECT_EQ(dump->read(1).grains.rows, 0u);
        }
    }
}

TEST(BinaryDump, TiltedBoxes) {
    const test::TemporaryFolder folder;
    State tilted;
    tilted.tilted = 1;
    tilted.box = {-1.5, 1,    -0.25, 2,    0,
                  3,    -0.5, 0.25,  -0.25};  // bounds of the box around it, then xy, xz, yz
    tilted.box[1] += 0.25;
    State general;
    general.tilted = 2;
    general.box = {1, 0, 0, 0.25, 1, 0, 0, 0, 2, -1, -2, -3};
    const auto dump = open_binary(folder.write("a", new_frame(tilted) + new_frame(general)));
    const WorldCell first = *dump->read(0).box, second = *dump->read(1).box;
    EXPECT_EQ(first.origin, Vec3(-1, 0, 0));
    EXPECT_EQ(first.edges[0], Vec3(2, 0, 0));
    EXPECT_EQ(first.edges[1], Vec3(-0.5, 2, 0));
    EXPECT_EQ(first.edges[2], Vec3(0.25, -0.25, 3));
    EXPECT_EQ(second.origin, Vec3(-1, -2, -3));
    EXPECT_EQ(second.edges[1], Vec3(0.25, 1, 0));
}

TEST(BinaryDump, OldFilesWithoutNames) {
    const test::TemporaryFolder folder;
    const Rows rows{{1, 0.1, 0.2, 0.3}, {2, 0.4, 0.5, 0.6}};
    for (const bool swapped : {false, true})
        for (const bool narrow : {false, true})
            for (const bool flags : {false, true})
                for (const bool tilted : {false, true})
                    for (const bool empty : {false, true}) {
                        const OldForm form{swapped, narrow, flags, tilted};
                        const std::string first =
                            empty ? old_frame(form, 1000, {{}}, 0) : old_frame(form, 1000, {rows}, 2);
                        const auto dump =
                            open_binary(folder.write("a", first + old_frame(form, 2000, {rows, rows}, 4)));
                        ASSERT_EQ(dump->moments().size(), 2u)
                            << swapped << narrow << flags << tilted << empty;
                        EXPECT_EQ(dump->moments()[0].step, 1000);
                        EXPECT_EQ(dump->moments()[0].grains, empty ? 0 : 2);
                        EXPECT_EQ(dump->facts().format, "LAMMPS binary dump without names of columns");
                        EXPECT_THAT(dump->news()[0], tells({"not name", "4 columns"}));
                        const RawFrame frame = dump->read(1);
                        EXPECT_THAT(column_of(frame.grains, "c1"), ElementsAre(1, 2, 1, 2));
                        EXPECT_THAT(column_of(frame.grains, "c4"), ElementsAre(0.3, 0.6, 0.3, 0.6));
                        EXPECT_EQ(frame.box->edges[0].x(), tilted ? 1.5 : 2.0);
                        EXPECT_EQ(frame.box->periodic[0], flags);
                    }
}

TEST(BinaryDump, OtherFilesAreNotTaken) {
    const auto takes = [](const std::string& bytes) {
        FileStart head;
        head.bytes = bytes;
        return lammps_binary_format().takes(head);
    };
    EXPECT_FALSE(takes(""));
    EXPECT_FALSE(takes(std::string(1000, '\0')));
    EXPECT_FALSE(takes("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\n" + std::string(1000, 'a')));
    // This is a binary STL with an empty head and 12 facets.
    EXPECT_FALSE(takes(std::string(80, '\0') + std::string("\x0C\0\0\0", 4) + std::string(600, '\x3F')));
}

TEST(CutBinaryDump, WholeFramesAreRead) {
    const test::TemporaryFolder folder;
    const std::string whole = new_frame({}), last = new_frame({.step = 1});
    for (std::size_t kept = 1; kept < last.size(); ++kept) {
        const auto dump = open_binary(folder.write("a", whole + last.substr(0, kept)));
        ASSERT_EQ(dump->moments().size(), 1u) << kept;
        EXPECT_THAT(dump->news()[0], HasSubstr("left out"));
    }
    const auto dump = open_binary(folder.path() / "a");
    folder.append("a", last.substr(last.size() - 1));
    EXPECT_TRUE(dump->grow());
    EXPECT_EQ(dump->read(1).step, 1);
    EXPECT_THAT(dump->news(), IsEmpty());
    EXPECT_THAT(binary_complaint(folder, whole.substr(0, whole.size() - 1)), tells({": no frame", "whole"}));
}

TEST(DamagedBinaryDump, IsRefusedWithItsByte) {
    const test::TemporaryFolder folder;
    const std::string whole = new_frame({});
    State f;
    f.claimed = 1000000000;
    EXPECT_THAT(binary_complaint(folder, new_frame(f)), tells({"after 2 rows", "1000000000"}));
    f.claimed = 1;
    EXPECT_THAT(binary_complaint(folder, new_frame(f)), tells({"more rows", "the 1 that"}));
    f = {};
    f.parts[1][0] = {2, 0.4, std::nan(""), 0.6};
    EXPECT_THAT(binary_complaint(folder, whole + new_frame(f)),
                HasSubstr("byte " + std::to_string(whole.size()) +
                          ": in the frame of step 0 that begins here, y of the row 2 is nan"));
    f = {};
    f.parts[1][0][0] = 1;
    EXPECT_THAT(binary_complaint(folder, new_frame(f)), tells({"row 2", "id 1", "second time"}));
    f = {};
    f.names = "id x y vx";
    EXPECT_THAT(binary_complaint(folder, whole + new_frame(f)), HasSubstr("the columns change"));
    f.names = "id x y";
    EXPECT_THAT(binary_complaint(folder, new_frame(f)), HasSubstr("4 columns have 3 names"));
    EXPECT_THAT(binary_complaint(folder, whole + std::string(100, 'x')), HasSubstr("byte 2"));
    std::string other = whole;
    other.replace(8, 10, "DUMPLOCALS");
    EXPECT_THAT(binary_complaint(folder, other), HasSubstr("of the style \"DUMPLOCALS\""));
    // A part claims 10^9 numbers in a file of a few bytes.
    Writer huge(false);
    huge.text(whole.substr(0, whole.size() - 2 * 36)).add(std::int32_t{1000000000});
    std::string claims = huge.bytes();
    const std::int64_t rows = 250000000;
    std::memcpy(claims.data() + 34, &rows, sizeof rows);
    EXPECT_THAT(binary_complaint(folder, claims), tells({"first one", "250000000 grains"}));
}

}  // namespace
}  // namespace grainreel
