// Tests of folders for temporary files.
#include "engine/base/system/own_folder.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "engine/base/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

// Nobody else may look into it, nobody can foresee its name, and nothing of it is left.
TEST(ScratchFolder, IsOfTheUserAloneAndGoesAtTheEnd) {
    fs::path path;
    {
        const ScratchFolder folder("test"), other("test");
        path = folder.path();
        EXPECT_NE(path, other.path());
        struct stat about {};
        ASSERT_EQ(::lstat(path.c_str(), &about), 0);
        EXPECT_EQ(about.st_mode & 07777, 0700u);
        fs::create_directories(path / "a/b");
        std::ofstream(path / "a/b/c") << "x";
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST(ScratchFolder, TellsThatThereIsNoTemporaryFolder) {
    const test::TemporaryFolder here;
    const char* const before = std::getenv("TMPDIR");
    const std::string kept = before == nullptr ? "" : before;
    ::setenv("TMPDIR", (here / "gone").c_str(), 1);
    std::string told;
    try {
        const ScratchFolder folder("test");
    } catch (const RunError& failure) {
        told = failure.what();
    }
    before == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", kept.c_str(), 1);
    EXPECT_THAT(told, testing::HasSubstr("set TMPDIR"));
}

}  // namespace
}  // namespace grainreel
