// Tests of where imports are kept: only in folders that nobody but the user can change, and nothing but
// imports is removed there.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/system/own_folder.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/import/import_run.hpp"
#include "tests/cli/small_disk.hpp"
#include "tests/foreign/dumps/dump_files.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

// A variable of the environment, until the end of a test; unset where it has no value.
class Variable {
  public:
    Variable(const char* name, const std::optional<std::string>& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        set(value);
    }
    ~Variable() { set(before_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    void set(const std::optional<std::string>& value) const {
        value ? ::setenv(name_, value->c_str(), 1) : ::unsetenv(name_);
    }
    const char* name_;
    std::optional<std::string> before_;
};

mode_t rights_of(const fs::path& path) {
    struct stat about {};
    return ::lstat(path.c_str(), &about) == 0 ? about.st_mode & 0777 : 0;
}

// A dump, and a temporary folder in which everybody may make files. There is no cache folder.
class ImportCache : public testing::Test {
  protected:
    ImportCache() {
        fs::create_directory(temporary);
        ::chmod(temporary.c_str(), 01777);
        dump = folder.write("bed.dump", frame_text("0", "1", "id x y z radius", "1 0 0 0 0.001\n"));
        // No reader waits for the rest of an old file.
        fs::last_write_time(dump, fs::file_time_type::clock::now() - std::chrono::hours(1));
    }

    Imported import() const {
        ImportRequest request;
        request.from = dump;
        request.reading.units = "si";
        request.reading.time_step = 1e-5;
        request.program_version = "test";
        return cached_import(request);
    }
    std::string refusal() const {
        try {
            return "took " + import().folder.string();
        } catch (const UserError& problem) {
            return problem.what();
        }
    }
    // Makes a folder with a large file that was not used for two days. The file takes no room on the disk.
    static void make_large_and_old(const fs::path& path) {
        fs::create_directories(path);
        std::ofstream(path / "large").close();
        fs::resize_file(path / "large", std::uintmax_t{3} << 30);
        fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(48));
    }

    test::TemporaryFolder folder;
    fs::path temporary = folder.path() / "tmp", dump;
    fs::path imports = temporary / ("grainreel-imports-" + std::to_string(::geteuid()));
    Variable home{"HOME", {}}, cache{"XDG_CACHE_HOME", {}}, temporaries{"TMPDIR", temporary.string()};
};

TEST_F(ImportCache, IsAFolderThatOnlyTheUserMayEnter) {
    EXPECT_EQ(import().folder.parent_path().parent_path(), imports);
    EXPECT_EQ(rights_of(imports), 0700u);
    EXPECT_EQ(rights_of(import().folder.parent_path()), 0700u);
}

// Where the name is a link, the oldest folders behind it would be removed, as soon as there are 4 GB.
TEST_F(ImportCache, IsNeverBehindALink) {
    const fs::path victim = folder.path() / "victim";
    make_large_and_old(victim / "photos");
    make_large_and_old(victim / "thesis");
    fs::create_symlink(victim, imports);
    EXPECT_THAT(refusal(),
                AllOf(HasSubstr(imports.string() + ": is a link"), HasSubstr("remove it, or set ")));
    EXPECT_TRUE(fs::exists(victim / "photos/large"));
    EXPECT_TRUE(fs::exists(victim / "thesis/large"));
    EXPECT_EQ(std::distance(fs::directory_iterator(victim), fs::directory_iterator()), 2);
    EXPECT_THAT(imports_kept().fault, HasSubstr("is a link"));
}

TEST_F(ImportCache, IsNotAFile) {
    std::ofstream(imports).close();
    EXPECT_THAT(refusal(), HasSubstr(imports.string() + ": is a file"));
}

TEST_F(ImportCache, IsNotOfAnotherUser) {
    constexpr uid_t kOther = 54321;
    fs::create_directory(imports);
    if (::chown(imports.c_str(), kOther, kOther) != 0) GTEST_SKIP() << "only root may give a folder away";
    EXPECT_THAT(refusal(), HasSubstr(imports.string() + ": belongs to another user"));
    EXPECT_TRUE(fs::is_empty(imports));
}

TEST_F(ImportCache, LosesTheRightsOfOthers) {
    fs::create_directory(imports);
    ::chmod(imports.c_str(), 0777);
    import();
    EXPECT_EQ(rights_of(imports), 0755u);
}

// When the import was made, by the time of its trajectory.
fs::file_time_type made(const Imported& run) {
    return fs::last_write_time(run.folder / "trajectory.nc");
}

// An import that others could have changed is made anew.
TEST_F(ImportCache, BelievesOnlyImportsThatNobodyElseCouldChange) {
    const fs::file_time_type first = made(import());
    EXPECT_EQ(made(import()), first) << "a sound import is found again";
    const fs::path place = import().folder.parent_path();
    ::chmod(place.c_str(), 0777);
    const fs::file_time_type second = made(import());
    EXPECT_NE(second, first);
    constexpr uid_t kOther = 54321;
    if (::chown(place.c_str(), kOther, kOther) != 0) return;  // not root
    EXPECT_NE(made(import()), second);
}

// Whatever lies in place of a file of an import, and whatever was done to the file, it is made anew.
TEST_F(ImportCache, MakesADamagedImportAnew) {
    const Imported sound = import();
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(sound.folder))
        files.push_back(entry.path());
    files.push_back(sound.folder.parent_path() / ".seal");
    ASSERT_GE(files.size(), 5u);
    const std::vector<std::pair<const char*, std::function<void(const fs::path&)>>> damages = {
        {"cut", [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); }},
        {"gone", [](const fs::path& file) { fs::remove(file); }},
        {"a pipe", [](const fs::path& file) { fs::remove(file), ::mkfifo(file.c_str(), 0600); }},
        {"a folder", [](const fs::path& file) { fs::remove(file), fs::create_directory(file); }},
        {"a link",
         [&](const fs::path& file) {
             fs::rename(file, folder.path() / "moved");
             fs::create_symlink(folder.path() / "moved", file);
         }},
        {"changed with its time", [](const fs::path& file) {
             const auto time = fs::last_write_time(file);
             std::fstream(file, std::ios::in | std::ios::out).write("#", 1);
             fs::last_write_time(file, time);
         }}};
    fs::file_time_type before = made(sound);
    for (std::size_t k = 0; k < std::max(files.size(), damages.size()); ++k) {
        const fs::path& file = files[k % files.size()];
        const auto& [what, damage] = damages[k % damages.size()];
        EXPECT_EQ(made(import()), before) << "before " << file << " is " << what;
        damage(file);
        const Imported again = import();
        EXPECT_NE(made(again), before) << file << " is " << what;
        EXPECT_EQ(again.news, sound.news) << file << " is " << what;
        EXPECT_EQ(again.folder, sound.folder);
        before = made(again);
    }
}

// A file may get back its former time (touch, cp -p, rsync); the time of its last change tells.
TEST_F(ImportCache, NoticesAChangeBehindTheSameTime) {
    const fs::file_time_type time = fs::last_write_time(dump);
    const Imported before = import();
    std::fstream(dump, std::ios::in | std::ios::out).seekp(-3, std::ios::end).write("2", 1);
    fs::last_write_time(dump, time);
    EXPECT_NE(import().folder, before.folder);
}

// The pieces of a list are files of the import too, though only the list was named.
TEST_F(ImportCache, NoticesAChangeInAPieceOfAList) {
    const auto piece = [&](const char* x) {
        folder.write("piece.vtp",
                     std::string("<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\">"
                                 "<Points><DataArray type=\"Float64\" format=\"ascii\">") +
                         x +
                         " 0 0</DataArray></Points><PointData><DataArray type=\"Float64\" "
                         "Name=\"radius\">0.1</DataArray></PointData></Piece></PolyData></VTKFile>");
    };
    piece("1");
    dump = folder.write("list.pvd",
                        "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" "
                        "file=\"piece.vtp\"/></Collection></VTKFile>");
    const fs::file_time_type first = made(import());
    EXPECT_EQ(made(import()), first);
    piece("2");
    EXPECT_NE(made(import()), first);
}

TEST_F(ImportCache, GoesToTheTemporaryFolderWhereTheCacheIsFull) {
    const fs::path full = folder.path() / "full";
    fs::create_directory(full);
    const test::SmallDisk disk(full, 4096);
    if (!disk.mounted()) GTEST_SKIP() << "no disk can be mounted here";
    const Variable there("XDG_CACHE_HOME", full.string());
    const fs::file_time_type first = made(import());
    EXPECT_EQ(import().folder.parent_path().parent_path(), imports);
    EXPECT_EQ(made(import()), first) << "it is found there again";
}

TEST(NamedAs, TheFilesStandInPlaceOfTheFolder) {
    EXPECT_EQ(named_as("/c/k/bed/scene.toml:3: wrong; see /c/k/bed", "/c/k/bed", "bed.dump"),
              "bed.dump: scene.toml:3: wrong; see bed.dump");
}

TEST_F(ImportCache, RemovesNothingButImports) {
    const std::string key = "0123456789abcdef0123456789abcdef", other = "f" + key.substr(1);
    make_large_and_old(imports / "photos");
    make_large_and_old(imports / key);
    make_large_and_old(imports / (other + ".17.part"));
    make_large_and_old(folder.path() / "elsewhere");
    fs::create_symlink(folder.path() / "elsewhere", imports / other);
    const fs::path run = import().folder;
    EXPECT_TRUE(fs::exists(imports / "photos/large"));
    EXPECT_TRUE(fs::exists(folder.path() / "elsewhere/large"));
    EXPECT_FALSE(fs::exists(imports / key)) << "the oldest import makes room";
    EXPECT_TRUE(fs::exists(run / "scene.toml"));
    EXPECT_EQ(imports_kept().imports, 2u) << "this one, and the unfinished one that is below the limit";
}

// The cache folder itself may lie where everybody can make files, as with XDG_CACHE_HOME=/tmp.
TEST_F(ImportCache, InACacheFolderOfSomebodyElseIsNotUsed) {
    const Variable there("XDG_CACHE_HOME", temporary.string());
    const fs::path victim = folder.path() / "victim";
    fs::create_directories(victim / "imports");
    fs::create_symlink(victim, temporary / "grainreel");
    EXPECT_EQ(import().folder.parent_path().parent_path(), imports);
    EXPECT_TRUE(fs::is_empty(victim / "imports"));
}

TEST_F(ImportCache, IsRefusedInOneLineWithoutATemporaryFolder) {
    const Variable nowhere("TMPDIR", (folder.path() / "missing").string());
    EXPECT_THAT(refusal(), HasSubstr("set TMPDIR, or XDG_CACHE_HOME"));
}

}  // namespace
}  // namespace grainreel
