// Tests of `--gl`: which driver draws, and the messages when a library is missing. A library goes missing
// here because a file with its name that is no library comes first on the search path.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::AllOf, testing::HasSubstr, testing::Not, testing::StartsWith;

class GlChoice : public testing::Test {
  protected:
    Ended movie(std::vector<std::string> words, const std::vector<std::string>& environment = {}) {
        words.insert(words.begin(), {"movie", scene.string(), "--duration", "0.02s", "--progress", "none"});
        words.insert(words.end(), {"--out", "run", "--force"});
        return run_program(words, {here.path(), environment});
    }
    std::string without(const std::vector<std::string>& libraries) {
        fs::create_directory(here / "broken");
        for (const std::string& name : libraries) std::ofstream(here / "broken" / name) << "not a library";
        return "LD_LIBRARY_PATH=" + (here / "broken").string();
    }
    std::string gl() { return nlohmann::json::parse(text_of(here / "run/run.json"))["gl"]; }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

TEST_F(GlChoice, TheOptionGoesBeforeTheEnvironment) {
    EXPECT_EQ(movie({}, {"GRAINREEL_GL=egl"}).status, 0);
    EXPECT_THAT(gl(), StartsWith("EGL: "));
    const Ended ended = movie({"--gl", "osmesa", "--verbose"}, {"GRAINREEL_GL=egl"});
    if (ended.status !=
        0) {  // Mesa 25.1 and later: the option still goes first, and what it wants is missing
        EXPECT_THAT(ended.err, HasSubstr("libOSMesa.so.8 cannot be opened"));
        return;
    }
    EXPECT_THAT(gl(), StartsWith("OSMesa: "));
    EXPECT_THAT(ended.err, HasSubstr("drawn with " + gl()));
}

TEST_F(GlChoice, AnUnknownOneIsRefused) {
    for (const Ended& ended : {movie({"--gl", "vulkan"}), movie({}, {"GRAINREEL_GL=vulkan"})}) {
        EXPECT_EQ(ended.status, 2);
        EXPECT_THAT(ended.err, tells({"vulkan", "no such maker", "osmesa or egl"}));
    }
    EXPECT_FALSE(fs::exists(here / "run"));
}

// Mesa 25.1 and later have no OSMesa. The software driver draws the same pictures through EGL.
TEST_F(GlChoice, WithoutOSMesaItIsTheSoftwareDriverOfEgl) {
    const std::string lost = without({"libOSMesa.so.8", "libOSMesa.so.6"});
    const Ended ended = movie({}, {lost});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(gl(), AllOf(StartsWith("EGL: "), HasSubstr("llvmpipe")));
    EXPECT_THAT(ended.err, Not(HasSubstr("drawn through EGL")));
    const Ended asked = movie({"--gl", "osmesa"}, {lost});
    EXPECT_EQ(asked.status, 1);
    EXPECT_THAT(asked.err, AllOf(HasSubstr("install Debian's libosmesa6"), Not(HasSubstr("EGL"))));
}

TEST_F(GlChoice, WithoutEglTheRemedyIsNamed) {
    const Ended ended = movie({"--gl", "egl"}, {without({"libEGL.so.1"})});
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.err, tells({"libEGL.so.1", "cannot be opened", "libegl1", "libegl-mesa0"}));
}

TEST_F(GlChoice, WithoutEitherBothAreNamed) {
    const Ended ended = movie({}, {without({"libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so.6"})});
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("libosmesa6"), HasSubstr("libegl-mesa0")));
}

// A cache of shaders on a full disk ended the program.
TEST_F(GlChoice, NoShadersAreKept) {
    const Ended ended =
        movie({}, {"XDG_CACHE_HOME=" + (here / "cache").string(), "HOME=" + here.path().string()});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_FALSE(fs::exists(here / "cache/mesa_shader_cache"));
    EXPECT_FALSE(fs::exists(here / ".cache/mesa_shader_cache"));
}

}  // namespace
}  // namespace grainreel
