// Tests that an import makes the same files, bit by bit, whether its frames are read once or twice. The
// hashes were made by a program that read all frames for types, all for sizes, and then all once more. Later
// the headers of trajectories told which of velocities and spins no file says, the first id and whether the
// steps are the file's, and the tilt of a box; the news told of unwrapped places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/import/import_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::text_of;
using test::write_old_text;

// A grain of a row in a dump.
struct Row {
    int id, type;
    double x, y, z, radius;
};

std::string dump_frame(std::int64_t step, const std::vector<Row>& rows, bool velocities = true) {
    std::string text = fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp ff ff\n0 1\n0 1\n0 1\nITEM: "
        "ATOMS id "
        "type x y z radius{}\n",
        step, rows.size(), velocities ? " vx vy vz" : "");
    for (const Row& row : rows)
        text += fmt::format("{} {} {} {} {} {}{}\n", row.id, row.type, row.x, row.y, row.z, row.radius,
                            velocities ? fmt::format(" 0 0.5 {}", 0.25 * row.id) : "");
    return text;
}

// Twenty grains of two types that rise from frame to frame.
std::vector<Row> bed(int frame) {
    std::vector<Row> rows;
    for (int i = 0; i < 20; ++i)
        rows.push_back({i + 1, i % 2 == 0 ? 2 : 5, 0.1 + 0.2 * (i % 4), 0.1 + 0.15 * (i / 4),
                        0.1 + 0.01 * frame, i % 2 == 0 ? 0.03 : 0.04});
    return rows;
}

std::string bed_dump(const std::function<void(int, std::vector<Row>&)>& change, bool velocities = true) {
    std::string text;
    for (int k = 0; k < 6; ++k) {
        std::vector<Row> rows = bed(k);
        change(k, rows);
        text += dump_frame(100 * k, rows, velocities);
    }
    return text;
}

void no_change(int, std::vector<Row>&) {}

// A surface that moves, and grains that rise, in one file of VTK for each moment.
std::string vtk_frame(int k) {
    const double way = 0.02 * k;
    return fmt::format(
        "# vtk DataFile Version 3.0\nbed\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n0 0 {0} 1 0 {0} "
        "1 1 "
        "{0}\n0.2 0.2 {1} 0.5 0.5 {1} 0.8 0.2 {1}\nCELLS 4 10\n3 0 1 2\n1 3\n1 4\n1 5\nCELL_TYPES "
        "4\n5\n1\n1\n1\n"
        "POINT_DATA 6\nSCALARS radius double 1\nLOOKUP_TABLE default\n0 0 0 0.05 0.06 0.07\n",
        way, 0.3 + 2 * way);
}

// Writes the files of a case into a folder, and says which of them is opened.
using Files = std::function<fs::path(const fs::path& folder)>;

Files one_dump(const std::string& text) {
    return [text](const fs::path& folder) {
        write_old_text(folder / "bed.dump", text);
        return folder / "bed.dump";
    };
}

Files of_project(const std::string& name) {
    return [name](const fs::path& folder) {
        write_old_text(folder / name, text_of(fs::path(GRAINREEL_SOURCE) / "tests/data/foreign" / name));
        return folder / name;
    };
}

ReadingOptions timed() {
    ReadingOptions options;
    options.time_step = 1e-4;
    return options;
}

// For a file that says its times.
ReadingOptions with_radius() {
    ReadingOptions options;
    options.radius = 0.02;
    return options;
}

ReadingOptions timed_with_radius() {
    ReadingOptions options = timed();
    options.radius = 0.02;
    return options;
}

ReadingOptions with_a_type_that_never_comes() {
    ReadingOptions options = timed();
    options.species = {{"3", "middle"}, {"5", "big"}};
    return options;
}

struct Case {
    const char* name;
    Files files;
    ReadingOptions options;
    std::uint64_t hash;
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"ConstantBed", one_dump(bed_dump(no_change)), timed(), 0xc3da105b9c2602c3},
        {"WithoutTimes", one_dump(bed_dump(no_change)), {}, 0x8cf23c1388a93543},
        {"OneFrame", one_dump(dump_frame(700, bed(0))), {}, 0xfa83899fdbd3ccb3},
        {"LateTypeBetweenTwoOthers", one_dump(bed_dump([](int k, auto& rows) {
             if (k >= 3) rows[4].type = 3;
         })),
         timed(), 0x16a505cda80843c2},
        {"LateTypeWithoutVelocities",
         one_dump(bed_dump(
             [](int k, auto& rows) {
                 if (k >= 3) rows[4].type = 3;
             },
             false)),
         timed(), 0x7dfdc00401064063},
        {"LateGrainWithAMiddleId", one_dump(bed_dump([](int k, auto& rows) {
             if (k < 3) rows.erase(rows.begin() + 7);
         })),
         timed(), 0x91a24db110e2bba8},
        {"GrainsComeAndGo", one_dump(bed_dump([](int k, auto& rows) {
             rows.erase(rows.begin() + 2 * k, rows.begin() + 2 * k + 2);
         })),
         timed(), 0x2847f4e4724d819d},
        {"SizesWiden", one_dump(bed_dump([](int k, auto& rows) {
             rows[3].radius -= 0.001 * k;
             rows[6].radius += 0.001 * k;
         })),
         timed(), 0xd9b92e4bc6057031},
        {"FirstFrameEmpty", one_dump(bed_dump([](int k, auto& rows) {
             if (k == 0) rows.clear();
         })),
         timed(), 0xdd432e183ff96392},
        {"NoGrains", one_dump(bed_dump([](int, auto& rows) { rows.clear(); })), timed(), 0x55ad6101dd5bcc7d},
        {"NoVelocities", one_dump(bed_dump(no_change, false)), timed(), 0x551795bf3c27b368},
        {"TypeThatNeverComes", one_dump(bed_dump(no_change)), with_a_type_that_never_comes(),
         0x74f1e5db89e27a08},
        {"SecondFrameOfAStep", one_dump(bed_dump(no_change) + dump_frame(500, bed(9))), timed(),
         0xf9354819be187824},
        {"WallsInFrames",
         [](const fs::path& folder) {
             for (int k = 0; k < 4; ++k)
                 write_old_text(folder / fmt::format("bed_{}.vtk", 1000 * k), vtk_frame(k));
             return folder / "bed_0.vtk";
         },
         timed(), 0x88de7932b6d70479},
        {"NoBox",
         [](const fs::path& folder) {
             std::string text = "time,id,x,y,z,radius\n";
             for (int k = 0; k < 5; ++k)
                 for (int i = 0; i < 4; ++i)
                     text +=
                         fmt::format("{},{},{},{},{},0.1\n", 0.1 * k, i, 0.3 * i, 0.01 * k * i, -0.02 * k);
             write_old_text(folder / "bed.csv", text);
             return folder / "bed.csv";
         },
         {},
         0xdff4934300ee7f65},
        {"Bucket", of_project("bucket.liggghts"), timed(), 0x8be04056e0968ea4},
        {"Shaken", of_project("shaken_unwrapped.dump"), with_radius(), 0xe4139ec4b25bb042},
        {"Triclinic", of_project("triclinic_cgs.dump"), with_radius(), 0xd59799cf575698a1},
        {"TriclinicBinary", of_project("triclinic.dump.bin"), timed_with_radius(), 0x1653f2292a0e3581},
        {"ContactsAlone", of_project("shaken_contacts.dump"), timed(), 0x7e21427356726c73},
        {"ContactsBeside",
         [](const fs::path& folder) {
             of_project("shaken_contacts.dump")(folder);
             return of_project("shaken_unwrapped.dump")(folder);
         },
         [] {
             ReadingOptions options = with_radius();
             options.contacts = {"@/shaken_contacts.dump"};
             options.columns = {{"id1", "c_pl[1]"}, {"id2", "c_pl[2]"}};
             return options;
         }(),
         0xc2e2fc1abdd973c5},
    };
    return all;
}

// FNV-1a over names and bytes of all files and over the news. The test's own folder counts as "@".
class Hash {
  public:
    explicit Hash(std::string folder) : folder_(std::move(folder)) {}
    void add(std::string text) {
        for (std::size_t at; (at = text.find(folder_)) != std::string::npos;)
            text.replace(at, folder_.size(), "@");
        for (const char c : text + '\0') {
            hash_ ^= static_cast<unsigned char>(c);
            hash_ *= 0x100000001b3;
        }
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::string folder_;
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

class ImportedFolder : public testing::TestWithParam<Case> {};

TEST_P(ImportedFolder, HasTheseBits) {
    const TemporaryFolder folder;
    ImportRequest request;
    request.from = GetParam().files(folder.path());
    request.reading = GetParam().options;
    for (std::string& file : request.reading.contacts) file.replace(0, 1, folder.path().string());
    request.folder = folder / "run";
    request.program_version = "test";
    const Imported run = import_run(request);
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& one : fs::directory_iterator(request.folder))
        if (one.path().filename() != kImportNews) files[one.path().filename().string()] = text_of(one.path());
    Hash hash(folder.path().string());
    for (const auto& [name, text] : files) {
        hash.add(name);
        hash.add(text);
    }
    for (const std::string& line : run.news) hash.add(line);
    hash.add(fmt::format("{} {}", run.frames, run.most_grains));
    std::string about;
    for (const auto& [name, text] : files) about += fmt::format("{} {}\n", name, text.size());
    EXPECT_EQ(fmt::format("{:#018x}", hash.value()), fmt::format("{:#018x}", GetParam().hash))
        << about << files["scene.toml"] << fmt::format("{}", fmt::join(run.news, "\n"));
}

INSTANTIATE_TEST_SUITE_P(Of, ImportedFolder, testing::ValuesIn(cases()),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace grainreel
