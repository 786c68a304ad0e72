// What verbs say of files of other programs that they do not take, or take otherwise than was meant: nothing
// that is false, and no path that the user does not know.
#include <gmock/gmock.h>

#include "tests/cli/foreign/foreign_bed.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

using ForeignWords = ForeignBed;

// An option for files of other programs is refused with what is wrong: no file, no format, or a run of ours.
TEST_F(ForeignWords, AnOptionForFilesTellsWhatIsThere) {
    write_old_text(here / "prose.txt", "once upon a time\nthere was a heap\n");
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"inspect"},
                                                 {"render", "--at", "0"},
                                                 {"report"},
                                                 {"export", "--to", "xyz"}}) {
        const auto said = [&](const std::string& path, const std::string& option) {
            std::vector<std::string> words = verb;
            words.insert(words.begin() + 1, path);
            words.push_back(option);
            if (option == "--density") words.emplace_back("1000");
            const Ended ended = program(words);
            EXPECT_EQ(ended.status, 2) << verb.front();
            return ended.err;
        };
        EXPECT_THAT(said("gone.dump", "--one"), tells_only({"gone.dump", "no such file"})) << verb.front();
        EXPECT_THAT(said("prose.txt", "--density"), tells_only({"prose.txt", "no format"})) << verb.front();
    }
}

TEST_F(ForeignWords, AFolderAroundTheFilesNamesThem) {
    std::filesystem::create_directories(here / "case/post");
    std::filesystem::create_directories(here / "case/mesh");
    std::filesystem::copy_file(here / "bed.dump", here / "case/post/bed.dump");
    for (const std::vector<std::string>& words : {std::vector<std::string>{"render", "case", "--at", "0"},
                                                  {"report", "case"},
                                                  {"inspect", "case"},
                                                  {"export", "case", "--to", "xyz"}})
        EXPECT_THAT(program(words).err, tells_only({"case", "another program", "case/post"}))
            << words.front();
}

TEST_F(ForeignWords, ATableOfContactsIsNoneOfGrains) {
    for (const char* table : {"geoA,geoB,f_x,f_y,f_z,X,Y,Z\n0,1,0,0,1,0,0,2\n",
                              "id1,id2,x,y,z,normal_force\n1,2,0,0,1,0.5\n", "i,j,overlap\n0,1,0\n"}) {
        write_old_text(here / "pairs.csv", table);
        EXPECT_THAT(program({"inspect", "pairs.csv"}).err, tells({"pairs.csv", "contacts", "--contacts"}))
            << table;
    }
    write_old_text(here / "grains.csv", "id,x,y,z,fx,fy,fz\n1,0,0,0,0,0,1\n");
    EXPECT_THAT(program({"inspect", "grains.csv"}).err, tells({"grains.csv", "no radius"}));
}

// A length of a step with which the times or speeds cannot be is told with its option, before files are made.
TEST_F(ForeignWords, AnAbsurdStepIsTold) {
    for (const char* step : {"1e-300", "1e-30", "1e300", "1e10"})
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"inspect", "bed.dump"}, {"render", "bed.dump", "--at", "0"}}) {
            std::vector<std::string> all = words;
            all.insert(all.end(), {"--time-step", step});
            const Ended ended = program(all);
            EXPECT_EQ(ended.status, 2);
            EXPECT_THAT(ended.err, tells_only({"--time-step", "at most"})) << words.front();
        }
}

// Where the speeds come from the places, a short step makes them absurd.
TEST_F(ForeignWords, AStepWithAbsurdSpeedsIsTold) {
    const std::string head =
        "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z radius\n";
    write_old_text(
        here / "still.dump",
        "ITEM: TIMESTEP\n0\n" + head + "1 0 0 0.1 0.01\nITEM: TIMESTEP\n1000\n" + head + "1 0 0 0.11 0.01\n");
    for (const char* verb : {"inspect", "report"})
        EXPECT_THAT(program({verb, "still.dump", "--time-step", "1e-15"}).err,
                    tells_only({"--time-step 1e-15", "grain 1", "1e+10 m/s"}));
    EXPECT_EQ(program({"inspect", "still.dump", "--time-step", "1e-6"}).status, 0);
}

TEST_F(ForeignWords, MessagesNameNoFolderOfTheCache) {
    write_old_text(here / "far.stl",
                   "solid far\nfacet normal 0 0 0\nouter loop\nvertex 900 0 0\nvertex 901 0 0\n"
                   "vertex 900 1 0\nendloop\nendfacet\nendsolid far\n");
    const Ended far = imported({"--walls", "far.stl"});
    EXPECT_THAT(far.err, Not(HasSubstr("cache"))) << far.err;
    const Ended page = timed({"report", "bed.dump"});
    EXPECT_EQ(page.status, 0) << page.err;
    EXPECT_THAT(page.err, Not(HasSubstr("cache")));
    EXPECT_THAT(page.err, Not(HasSubstr("run.json")));
    EXPECT_EQ(imported({"--set", "film.camera.zoom=-1"}).status, 2);
    EXPECT_THAT(imported({"--set", "film.plot=[{y = \"gone\"}]"}).err, Not(HasSubstr("cache")));
}

// Other formats in HDF5 are not called NetCDF.
TEST_F(ForeignWords, AFileOfHdf5IsCalledSo) {
    std::string superblock = "\x89HDF\r\n\x1a\n";
    superblock += std::string(504, '\0');
    write_old_text(here / "other.h5", superblock);
    EXPECT_THAT(program({"inspect", "other.h5"}).err, tells_only({"other.h5", "HDF5"}));
}

}  // namespace
}  // namespace grainreel
