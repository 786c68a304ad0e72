// Tests of imports of files that another program is still writing: each frame is taken once it is whole, and
// in the end the run is that of an import of the whole files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/run/import/import_run.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;

// A text that is added to a file.
struct Added {
    std::string file, text;
};

// Writes the files of frames 0, 1, ... Frame k has k more grains than the first.
struct Writer {
    const char* name;
    std::string from;                        // what is imported
    std::function<Added(int)> frame;         // what a frame adds, and to which file
    bool waits = false;                      // whether a frame counts only when the next one begins
    std::function<std::string(int)> list{};  // the list of the files of these frames, which is written anew
};

template <class Row>
std::string rows(int frame, Row row) {
    std::string text;
    for (int i = 0; i < 3 + frame; ++i)
        text +=
            row(i + 1, fmt::format("{} {} {}", 0.01 * i, 0.03 + 0.001 * frame, 0.05 + 0.0001 * frame * i));
    return text;
}

std::string with_commas(std::string text) {
    for (char& c : text)
        if (c == ' ') c = ',';
    return text;
}

std::string dump_frame(int k, int step, const std::string& type = "1") {
    return fmt::format(
               "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
               "ITEM: ATOMS id type radius x y z\n",
               step, 3 + k) +
           rows(k, [&](int id, const std::string& place) {
               return fmt::format("{} {} 0.004 {}\n", id, type, place);
           });
}

std::string vtk_frame(int k) {
    std::string text =
        fmt::format("# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS {} double\n", 3 + k);
    text += rows(k, [](int, const std::string& place) { return place + "\n"; });
    text += fmt::format("POINT_DATA {}\nSCALARS radius double 1\nLOOKUP_TABLE default\n", 3 + k);
    for (int i = 0; i < 3 + k; ++i) text += "0.004\n";
    return text;
}

std::string collection(int frames) {
    std::string text = "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n";
    for (int k = 0; k < frames; ++k)
        text += fmt::format("<DataSet timestep=\"{}\" file=\"bed_{}.vtk\"/>\n", 0.01 * k, k);
    return text + "</Collection></VTKFile>\n";
}

std::vector<Writer> writers() {
    return {
        {"dump", "bed.dump",
         [](int k) {
             return Added{"bed.dump", dump_frame(k, 100 * k)};
         }},
        // The mean interval and the shortest one change with each frame.
        {"uneven", "bed.dump",
         [](int k) {
             return Added{"bed.dump", dump_frame(k, 1000 * k - 90 * k * k)};
         }},
        {"dumps", "bed.*.dump",
         [](int k) {
             return Added{fmt::format("bed.{}.dump", 100 * k), dump_frame(k, 100 * k)};
         }},
        {"folder", ".",
         [](int k) {
             return Added{fmt::format("bed_{}.vtk", k), vtk_frame(k)};
         }},
        {"series", "bed_0.vtk",
         [](int k) {
             return Added{fmt::format("bed_{}.vtk", k), vtk_frame(k)};
         }},
        {"collection", "bed.pvd",
         [](int k) {
             return Added{fmt::format("bed_{}.vtk", k), vtk_frame(k)};
         },
         false, collection},
        {"xyz", "bed.xyz",
         [](int k) {
             return Added{"bed.xyz",
                          fmt::format("{}\nProperties=id:I:1:pos:R:3:radius:R:1 Time={}\n", 3 + k, 0.01 * k) +
                              rows(k, [](int id, const std::string& place) {
                                  return fmt::format("{} {} 0.004\n", id, place);
                              })};
         }},
        {"table", "bed.csv",
         [](int k) {
             return Added{
                 "bed.csv",
                 (k == 0 ? "time,id,x,y,z,radius\n" : "") + rows(k, [&](int id, const std::string& place) {
                     return fmt::format("{},{},{},0.004\n", 0.01 * k, id, with_commas(place));
                 })};
         },
         true},
    };
}

class GrowingImport : public testing::TestWithParam<Writer> {
  protected:
    void add(const std::string& file, const std::string& text) {
        std::ofstream(here / file, std::ios::app | std::ios::binary) << text;
    }
    void add_frame(int k) {
        const Added added = GetParam().frame(k);
        add(added.file, added.text);
        if (GetParam().list) std::ofstream(here / "bed.pvd") << GetParam().list(k + 1);
    }
    ImportRequest request(const std::string& folder) {
        ImportRequest request;
        request.from = here / GetParam().from;
        request.folder = made / folder;
        request.program_version = "test";
        return request;
    }

    TemporaryFolder here, made;
};

// A grow() that finds a half-written file throws UserError or finds nothing.
bool takes_after_growth(Import& import) {
    try {
        import.grow();
    } catch (const UserError&) {
        return false;
    }
    return import.take_next();
}

TEST_P(GrowingImport, BecomesThatOfTheWholeFiles) {
    constexpr int frames = 6;
    add_frame(0);
    if (GetParam().waits) add_frame(1);
    fs::create_directory(made / "growing");
    Import import(request("growing"), false);
    EXPECT_EQ(import.run().frames, 1);
    for (int k = 1; k < frames; ++k) {
        const int next = k + (GetParam().waits ? 1 : 0);
        const Added added = GetParam().frame(next);
        if (next < frames) {
            add(added.file, added.text.substr(0, added.text.size() / 2));
            if (!GetParam().waits) {
                EXPECT_FALSE(takes_after_growth(import)) << k;
            }
            add(added.file, added.text.substr(added.text.size() / 2));
            if (GetParam().list) std::ofstream(here / "bed.pvd") << GetParam().list(next + 1);
        } else {
            EXPECT_FALSE(takes_after_growth(import)) << k;
            import.end();
        }
        EXPECT_TRUE(takes_after_growth(import)) << k;
        EXPECT_FALSE(takes_after_growth(import)) << k;
        EXPECT_EQ(import.frames(), k + 1);
    }
    const Imported whole = import_run(request("whole"));
    ASSERT_EQ(whole.frames, frames);
    const TrajectoryReader grown(made / "growing/trajectory.nc"), all(made / "whole/trajectory.nc");
    ASSERT_EQ(grown.frames(), all.frames());
    for (std::size_t k = 0; k < all.frames(); ++k) {
        const State now = grown.read(k), then = all.read(k);
        EXPECT_EQ(now.step, then.step) << k;
        EXPECT_EQ(now.time, then.time) << k;
        EXPECT_EQ(now.id, then.id) << k;
        EXPECT_EQ(now.position, then.position) << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, GrowingImport, testing::ValuesIn(writers()),
                         [](const auto& one) { return std::string(one.param.name); });

class GrowingDump : public testing::Test {
  protected:
    void SetUp() override {
        write(dump_frame(0, 0) + dump_frame(1, 100));
        request.from = here / "bed.dump";
        request.folder = here / "run";
        fs::create_directory(request.folder);
    }
    void write(const std::string& text) { std::ofstream(here / "bed.dump", std::ios::binary) << text; }

    TemporaryFolder here;
    ImportRequest request;
};

TEST_F(GrowingDump, ANewTypeIsRefused) {
    Import import(request, false);
    EXPECT_EQ(import.run().frames, 2);
    write(dump_frame(0, 0) + dump_frame(1, 100) + dump_frame(2, 200, "7"));
    import.grow();
    EXPECT_THAT([&] { import.take_next(); },
                testing::ThrowsMessage<RunError>(tells({"bed.dump", "has a type", "--species"})));
}

TEST_F(GrowingDump, ALongerCopyUnderItsNameGoesOn) {
    Import import(request, false);
    EXPECT_EQ(import.run().frames, 2);
    std::ofstream(here / "copy") << dump_frame(0, 0) + dump_frame(1, 100) + dump_frame(2, 200);
    fs::rename(here / "copy", here / "bed.dump");
    import.grow();
    EXPECT_TRUE(import.take_next());
}

TEST_F(GrowingDump, OtherFramesUnderItsNameAreAnError) {
    for (const std::string& other :
         {dump_frame(0, 0), dump_frame(0, 0) + dump_frame(1, 50) + dump_frame(2, 60)}) {
        fs::remove_all(request.folder);
        SetUp();
        Import import(request, false);
        EXPECT_EQ(import.run().frames, 2);
        write(other);
        EXPECT_THAT([&] { import.grow(); },
                    testing::ThrowsMessage<RunError>(tells({"bed.dump", "truncated or replaced"})));
    }
}

// LIGGGHTS may write a dump before the first grain is there.
TEST_F(GrowingDump, ThatHasNoGrainYetIsWaitedFor) {
    std::string empty = dump_frame(0, 0);
    empty.erase(empty.find("radius x y z\n") + 13);
    empty.replace(empty.find("ATOMS\n3") + 6, 1, "0");
    write(empty);
    EXPECT_THAT([&] { Import(request, false); },
                testing::ThrowsMessage<UserError>(tells({"bed.dump", "no grain"})));
    write(empty + dump_frame(1, 100));
    Import import(request, false);
    EXPECT_EQ(import.run().frames, 2);
}

}  // namespace
}  // namespace grainreel
