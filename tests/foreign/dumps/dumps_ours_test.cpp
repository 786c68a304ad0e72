// Tests of frames that LAMMPS and LIGGGHTS wrote, in tests/data/foreign, against a plain reading of their
// words.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "tests/foreign/dumps/dump_files.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;

std::filesystem::path data(const char* name) {
    return std::filesystem::path(GRAINREEL_SOURCE) / "tests/data/foreign" / name;
}

// The numbers below the line that begins with `item`, read by strtod.
std::vector<std::vector<double>> rows_below(const std::filesystem::path& file, const std::string& item,
                                            std::size_t frame) {
    std::ifstream in(file);
    std::vector<std::vector<double>> rows;
    std::string line;
    for (std::size_t found = 0; found <= frame && std::getline(in, line);)
        found += line.starts_with(item) ? 1 : 0;
    while (std::getline(in, line) && !line.starts_with("ITEM:")) {
        std::istringstream words(line);
        std::vector<double> row;
        for (std::string word; words >> word;) row.push_back(std::strtod(word.c_str(), nullptr));
        rows.push_back(row);
    }
    return rows;
}

void expect_numbers(const RawTable& table, const std::vector<std::vector<double>>& rows) {
    ASSERT_EQ(table.rows, rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
        ASSERT_EQ(table.columns.size(), rows[row].size());
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            ASSERT_EQ(table.columns[c].values[row], rows[row][c]) << row << " " << c;
    }
}

TEST(DumpsOfPrograms, LiggghtsBucket) {
    const auto file = data("bucket.liggghts");
    const auto dump = open_text(file);
    ASSERT_EQ(dump->moments().size(), 1u);
    EXPECT_EQ(dump->moments()[0].step, 2000);
    const RawFrame frame = dump->read(0);
    EXPECT_EQ(frame.grains.rows, 240u);
    EXPECT_EQ(frame.grains.columns.size(), 19u);
    expect_numbers(frame.grains, rows_below(file, "ITEM: ATOMS", 0));
    EXPECT_EQ(frame.box->origin, Vec3(-0.05, -0.03, -0.02));
}

TEST(DumpsOfPrograms, LammpsWithUnitsAndTimes) {
    const auto file = data("shaken_unwrapped.dump");
    const auto dump = open_text(file);
    EXPECT_EQ(dump->facts().units, "si");
    EXPECT_EQ(dump->moments()[0].time, 0.0);
    expect_numbers(dump->read(0).grains, rows_below(file, "ITEM: ATOMS", 0));
    EXPECT_EQ(dump->read(0).grains.rows, 324u);
}

TEST(DumpsOfPrograms, LammpsPairs) {
    const auto file = data("shaken_contacts.dump");
    const auto dump = open_text(file);
    ASSERT_EQ(dump->moments().size(), 2u);
    EXPECT_EQ(dump->read(0).contacts.rows, 0u);
    const RawFrame frame = dump->read(1);
    EXPECT_EQ(frame.contacts.rows, 20u);
    expect_numbers(frame.contacts, rows_below(file, "ITEM: ENTRIES", 1));
}

// The text file and the binary file are of one run at one step: they have the same box, and places agree to
// six digits.
TEST(DumpsOfPrograms, TextAndBinaryOfOneRun) {
    const auto file = data("triclinic_cgs.dump");
    const auto text = open_text(file);
    ASSERT_TRUE(lammps_binary_format().takes(unpacked_head(data("triclinic.dump.bin"))));
    const auto binary = lammps_binary_format().open(data("triclinic.dump.bin"));
    ASSERT_EQ(text->moments().size(), 1u);
    ASSERT_EQ(binary->moments().size(), 1u);
    EXPECT_EQ(text->moments()[0].step, 3000000000);
    EXPECT_EQ(binary->moments()[0].step, 3000000000);
    const RawFrame one = text->read(0), other = binary->read(0);
    expect_numbers(one.grains, rows_below(file, "ITEM: ATOMS", 0));
    EXPECT_LT((one.box->edges[2] - other.box->edges[2]).norm(), 1e-15);
    EXPECT_EQ(one.box->origin, other.box->origin);
    EXPECT_EQ(one.box->periodic, (std::array{true, true, true}));
    ASSERT_EQ(one.grains.rows, 200u);
    ASSERT_EQ(other.grains.rows, 200u);
    for (std::size_t k = 0; k < 200; ++k) {
        const double id = one.grains.find("id")->values[k];
        const auto& ids = other.grains.find("id")->values;
        const auto at = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
        ASSERT_LT(at, ids.size());
        for (const char* name : {"x", "y", "z", "radius", "ix", "iy", "iz"}) {
            const double six = one.grains.find(name)->values[k];
            EXPECT_NEAR(six, other.grains.find(name)->values[at], 5e-6 * std::max(1.0, std::abs(six)))
                << name;
        }
    }
}

}  // namespace
}  // namespace grainreel
