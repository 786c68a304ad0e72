// Tests of keeping a run as it was and putting it back, and of files in folders from other places.
#include "engine/files/former_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_names.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "tests/cli/made_frame.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;

// The end or the beginning of files that grow is copied; other files get a second name.
TEST(FormerFiles, IsPutBackAsItWas) {
    const TemporaryFolder here;
    const fs::path run = here / "run";
    fs::create_directories(run / "checkpoints");
    const std::string rows = "step\n0\n10\n20\n30\n";
    write_text(run / "measures.csv", rows);
    write_text(run / "outflow.csv", rows);
    write_text(run / "trajectory.nc", rows);
    write_text(run / "run.json", "complete");
    write_text(run / "scene.toml", "old");
    write_text(run / "checkpoints/000000000010.grs", "a");
    write_text(run / "mine.txt", "mine");
    {
        const FormerFiles none(run);
        EXPECT_FALSE(FormerFiles::is_kept(run));
    }
    EXPECT_FALSE(fs::exists(run / kFormerRunPart));
    FormerFiles former(run);
    former.cut("measures.csv", rows.size() - 3);
    former.cut("outflow.csv", 5);
    write_text(former.new_file("trajectory.nc"), "more places");
    former.begin();
    EXPECT_TRUE(FormerFiles::is_kept(run));
    EXPECT_EQ(text_of(run / "trajectory.nc"), "more places");
    EXPECT_EQ(text_of(run / "outflow.csv"), rows.substr(0, 5));
    // The run continues.
    TextFile(run / "measures.csv", rows.size() - 3).write("30 again\n40\n");
    TextFile(run / "outflow.csv", 5).write("10 again\n");
    replace_file(run / "scene.toml", "new");
    write_text(run / "run.json", "running");
    fs::remove(run / "checkpoints/000000000010.grs");
    write_text(run / "checkpoints/000000000040.grs", "b");
    write_text(run / "poster.png", "there was none");
    for (int again = 0; again < 2; ++again) {
        if (FormerFiles::is_kept(run)) FormerFiles::put_back(run);
        for (const char* file : {"measures.csv", "outflow.csv", "trajectory.nc"})
            EXPECT_EQ(text_of(run / file), rows) << file;
        EXPECT_EQ(text_of(run / "run.json"), "complete");
        EXPECT_EQ(text_of(run / "scene.toml"), "old");
        EXPECT_EQ(text_of(run / "checkpoints/000000000010.grs"), "a");
        EXPECT_EQ(text_of(run / "mine.txt"), "mine");
        EXPECT_FALSE(fs::exists(run / "checkpoints/000000000040.grs"));
        EXPECT_FALSE(fs::exists(run / "poster.png"));
    }
    EXPECT_FALSE(fs::exists(run / kFormerRun));
    EXPECT_FALSE(fs::exists(run / kFormerRunPart));
}

// The new file is as if it had had its places from the beginning.
TEST(FormerFiles, FramesAreWrittenAgainWithMorePlaces) {
    const TemporaryFolder here;
    TrajectoryInfo info;
    info.title = "A test";
    info.program_version = "1.2.3";
    info.species = {"small ones", "big", "glued"};
    info.traffic = true;
    info.contact_numbers = false;
    const auto write = [&](const char* name, std::size_t capacity) {
        info.capacity = capacity;
        TrajectoryWriter writer(here / name, info);
        for (const int grains : {2, 4, 3}) writer.write(made_frame(grains, grains));
    };
    write("few.nc", 4);
    write("many.nc", 9);
    TrajectoryWriter::write_again(here / "few.nc", 3, here / "again.nc", info);
    EXPECT_EQ(text_of(here / "again.nc") == text_of(here / "many.nc"), true);
    EXPECT_FALSE(TrajectoryWriter::goes_on_with(info, here / "few.nc"));
    EXPECT_TRUE(TrajectoryWriter::goes_on_with(info, here / "again.nc"));
}

TEST(PlainFile, LinksAreNotWrittenThroughAndPipesNotRead) {
    const TemporaryFolder here;
    write_text(here / "precious", "all");
    for (const char* name : {"link", ".file.part"}) fs::create_symlink(here / "precious", here / name);
    EXPECT_THROW(TextFile(here / "link", 0), RunError);
    replace_file(here / "file", "new");
    TextFile(here / "link").write("new");
    const int made = make_plain(here / "link");
    EXPECT_GE(made, 0);
    ::close(made);
    EXPECT_EQ(text_of(here / "precious"), "all");
    ASSERT_EQ(::mkfifo((here / "pipe").c_str(), 0600), 0);
    EXPECT_FALSE(read_plain(here / "pipe"));
    EXPECT_FALSE(read_plain(here / "nothing"));
    EXPECT_EQ(open_plain(here / "pipe"), -1);
    EXPECT_EQ(other_than_file(here / "pipe", true), "a pipe");
    EXPECT_EQ(other_than_file(here.path(), true), "a folder");
    EXPECT_EQ(other_than_file("/dev/zero", true), "a device");
    EXPECT_EQ(other_than_file(here / "precious", false), "");
    fs::create_directory(here / "folder");
    fs::create_directory_symlink(here / "folder", here / "other");
    EXPECT_FALSE(make_plain_folder(here / "folder"));
    EXPECT_TRUE(make_plain_folder(here / "other"));
}

// A comment is taken over if the value is the same, and in the same table of several.
TEST(Comments, AreTakenOver) {
    const std::string before =
        "# all\ntitle = \"a\"\n[[pair]]\n# why\nk = 1.0\n[[pair]]\n# and why\nk = 2.0\n[run]\n# new\nstep = "
        "3.0\n";
    const std::string now =
        "# other\ntitle = \"a\"\n[[pair]]\nk = 1.0\n[[pair]]\nk = 2.0\n[run]\nduration = 1.0\nstep = 4.0\n";
    EXPECT_EQ(with_comments_of(before, now),
              "# other\ntitle = \"a\"\n[[pair]]\n# why\nk = 1.0\n[[pair]]\n# and why\nk = 2.0\n[run]\n"
              "duration = 1.0\nstep = 4.0\n");
}

}  // namespace
}  // namespace grainreel
