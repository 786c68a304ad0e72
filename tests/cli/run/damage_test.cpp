// Tests of trajectory.nc and contacts.nc with changed bytes: what is read is what was written, or nothing;
// and no number in a file makes the program crash or ask for memory without bound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <netcdf.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <random>

#include "engine/base/error.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "tests/cli/film_length.hpp"
#include "tests/cli/made_frame.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

constexpr int frames = 5, grains = 8;

std::string written_trajectory(const TemporaryFolder& here) {
    TrajectoryInfo info;
    info.title = "A test";
    info.program_version = "1.2.3";
    info.species = {"small", "big", "glued"};
    info.capacity = grains;
    info.orientation = true;
    {
        TrajectoryWriter writer(here / "t.nc", info);
        for (int i = 0; i < frames; ++i) writer.write(made_frame(grains, i, true));
    }
    return text_of(here / "t.nc");
}

std::vector<SavedContact> made_contacts(int frame) {
    std::vector<SavedContact> contacts;
    for (int i = 0; i < 4; ++i)
        contacts.push_back({i, i == 3 ? -1 : i + 1, 0.5 * i + frame, vector_of(i), vector_of(frame)});
    return contacts;
}

std::string written_contacts(const TemporaryFolder& here) {
    {
        ContactsWriter writer(here / "c.nc", "A test", "1.2.3");
        for (int i = 0; i < frames; ++i) writer.write(i, made_contacts(i));
    }
    return text_of(here / "c.nc");
}

// Changes one bit, or up to sixteen bytes. Half of the changes are in the header, though the rest is larger.
std::string damaged(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t limit) { return random() % limit; };
    const std::size_t at = below(random() % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 1500));
    switch (random() % 4) {
        case 0:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
            break;
        case 1:
            for (std::size_t i = at; i < std::min(bytes.size(), at + 8); ++i) bytes[i] = '\xff';
            break;
        case 2:
            for (std::size_t i = at; i < std::min(bytes.size(), at + 1 + below(16)); ++i)
                bytes[i] = static_cast<char>(random());
            break;
        default:
            bytes =
                bytes.substr(0, at) + bytes.substr(std::min(bytes.size(), at + 4));  // four bytes are missing
    }
    return bytes;
}

// Compares bit by bit, except for numbers that the file keeps as floats.
bool same(const State& a, const State& b) {
    const auto close = [](const Vec3& u, const Vec3& v) { return (u - v).norm() <= 1e-6 * v.norm(); };
    bool all = a.step == b.step && a.time == b.time && a.cycles == b.cycles && a.phase == b.phase &&
               a.bodies == b.bodies && a.id == b.id && a.species == b.species && a.radius == b.radius &&
               a.position == b.position && a.orientation.size() == b.orientation.size();
    for (std::size_t i = 0; all && i < a.size(); ++i)
        all = close(a.velocity[i], b.velocity[i]) && close(a.spin[i], b.spin[i]) &&
              a.orientation[i].isApprox(b.orientation[i], 1e-6);
    return all;
}

TEST(Damage, NoFrameIsReadThatWasNotWritten) {
    const TemporaryFolder here;
    const std::string whole = written_trajectory(here);
    std::mt19937 random(33);
    int refused = 0, left_out = 0;
    for (int trial = 0; trial < 300; ++trial) {
        write_old_text(here / "d.nc", damaged(whole, random));
        try {
            const TrajectoryReader reader(here / "d.nc");
            EXPECT_EQ(reader.frames() + reader.uncounted() + (reader.cut_off() ? 1 : 0), std::size_t{frames})
                << trial;
            for (std::size_t i = 0; i < reader.frames(); ++i) {
                try {
                    EXPECT_TRUE(same(reader.read(i), made_frame(grains, static_cast<int>(i), true)))
                        << "trial " << trial << ", frame " << i;
                } catch (const DamagedFrame&) {
                    ++left_out;
                }
            }
        } catch (const UserError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 30);
    EXPECT_GT(left_out, 50);
}

// Returns a file of an earlier version, in which checksums are not known by that name.
std::string without_checksums(std::string bytes) {
    for (std::size_t at = 0; (at = bytes.find("_checksum", at)) != std::string::npos;)
        bytes.replace(at, 9, "_somewhat");
    return bytes;
}

TEST(Damage, AnEarlierVersionsFramesHoldOnlyWhatARunCanHave) {
    const TemporaryFolder here;
    const std::string whole = without_checksums(written_trajectory(here));
    std::mt19937 random(34);
    int left_out = 0;
    for (int trial = 0; trial < 300; ++trial) {
        write_old_text(here / "d.nc", damaged(whole, random));
        try {
            const TrajectoryReader reader(here / "d.nc");
            EXPECT_FALSE(reader.info().checksums);
            for (std::size_t i = 0; i < reader.frames(); ++i) {
                try {
                    const State frame = reader.read(i);
                    EXPECT_LE(frame.size(), std::size_t{grains});
                    for (std::size_t g = 0; g < frame.size(); ++g) {
                        EXPECT_TRUE(frame.species[g] >= 0 && frame.species[g] < 3) << trial;
                        EXPECT_TRUE(frame.radius[g] > 0 && frame.radius[g] < 1e4) << trial;
                        EXPECT_LT(frame.position[g].norm(), 1e7) << trial;
                        EXPECT_LT(frame.velocity[g].norm(), 1e7) << trial;
                    }
                } catch (const DamagedFrame&) {
                    ++left_out;
                }
            }
        } catch (const UserError&) {
        }
    }
    EXPECT_GT(left_out, 10);
}

TEST(Damage, NoContactIsReadThatWasNotWritten) {
    const TemporaryFolder here;
    const std::string whole = written_contacts(here);
    std::mt19937 random(35);
    int refused = 0;
    for (int trial = 0; trial < 300; ++trial) {
        write_old_text(here / "d.nc", damaged(whole, random));
        try {
            const ContactsReader reader(here / "d.nc");
            if (reader.cut_off() || reader.uncounted() > 0 || !reader.has_checksums())
                continue;  // the program reports the damage
            for (int i = 0; i < frames; ++i) {
                const std::vector<Link> touches = reader.touches(static_cast<std::size_t>(i));
                const std::vector<SavedContact> wanted = made_contacts(i);
                ASSERT_EQ(touches.size(), wanted.size()) << trial;
                for (std::size_t k = 0; k < touches.size(); ++k)
                    EXPECT_TRUE(touches[k].first == wanted[k].first &&
                                touches[k].second == wanted[k].second && touches[k].force == wanted[k].normal)
                        << trial;
            }
        } catch (const UserError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

// Each count in a header becomes the largest number of its four bytes. No memory may be asked for such a
// count.
TEST(Damage, ACountIsHeldAgainstTheFile) {
    const TemporaryFolder here;
    const std::string whole = written_trajectory(here);
    for (std::size_t at = 4; at + 4 < whole.find("wall_offset"); at += 4) {
        std::string bytes = whole;
        bytes.replace(at, 4, "\x7f\xff\xff\xff");
        write_old_text(here / "d.nc", bytes);
        try {
            const TrajectoryReader reader(here / "d.nc");
            for (std::size_t i = 0; i < reader.frames(); ++i) reader.read(i);
        } catch (const UserError&) {
        }
    }
}

TEST(Damage, OnlyAFileIsOpened) {
    const TemporaryFolder here;
    ASSERT_EQ(::mkfifo((here / "pipe.nc").c_str(), 0600), 0);  // reading it would wait for ever
    for (const fs::path& path : {here / "pipe.nc", here.path(), fs::path("/dev/zero")})
        EXPECT_THROW(TrajectoryReader{path}, UserError) << path;
}

class DamagedRun : public testing::Test {
  protected:
    void SetUp() override {
        const Ended made =
            program({"movie", scene.string(), "--no-film", "--out", "run", "--set", "output.contacts=true"});
        ASSERT_EQ(made.status, 0) << made.err;
    }
    Ended program(const std::vector<std::string>& words) { return run_program(words, {here.path(), {}}); }
    std::size_t count() const { return TrajectoryReader(here / "run/trajectory.nc").frames(); }
    void flip_bit(const char* file, std::size_t from_end) const {
        std::string bytes = text_of(here / "run" / file);
        bytes[bytes.size() - from_end] = static_cast<char>(bytes[bytes.size() - from_end] ^ 4);
        write_text(here / "run" / file, bytes);
    }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

TEST_F(DamagedRun, ADamagedFrameIsLeftOutAndNamed) {
    const std::size_t last = count() - 1;
    ASSERT_EQ(last, 4u);  // 0.2 s at 20 Hz
    flip_bit("trajectory.nc", 200);
    const std::string words =
        "run/trajectory.nc: frame 4 (the first is 0) is damaged: its checksum is not that "
        "of its numbers; copy the file again, or run the scene again";
    const Ended film = program({"render", "run", "--out", "again", "--no-replay"});
    EXPECT_EQ(film.status, 0) << film.err;
    EXPECT_THAT(film.err, HasSubstr(words + "; it is left out"));
    EXPECT_EQ(decoded_pictures(here / "again/movie.mp4"), 4);
    EXPECT_THAT(text_of(here / "again/run.json"), HasSubstr(words));
    const Ended still = program({"render", "run", "--at", "0.2 s", "--out", "still.png", "--no-replay"});
    EXPECT_EQ(still.status, 2);
    EXPECT_THAT(still.err, HasSubstr(words));
    EXPECT_FALSE(fs::exists(here / "still.png"));
    EXPECT_EQ(program({"render", "run", "--at", "0.1 s", "--out", "still.png"}).status, 0);
    const Ended both =
        program({"compare", "run", "run", "--size", "640x360", "--out", "both", "--no-replay"});
    EXPECT_EQ(both.status, 0) << both.err;
    EXPECT_THAT(both.err, HasSubstr(words));
    EXPECT_EQ(decoded_pictures(here / "both/movie.mp4"), 4);
    const Ended back = program({"render", "run", "--at", "0.2 s", "--out", "back.png"});
    EXPECT_EQ(back.status, 0) << back.err << "its last checkpoint has the moment";
}

TEST_F(DamagedRun, DamagedContactsAreRefusedBeforeAnythingIsMade) {
    flip_bit("contacts.nc", 30);
    EXPECT_EQ(program({"render", "run", "--no-film", "--frames", "--out", "without"}).status, 0);
    const Ended refused = program({"render", "run", "--set", "film.force_chains=true", "--out", "again"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("run/contacts.nc: row "));
    EXPECT_THAT(refused.err, HasSubstr("is damaged: its checksum"));
    EXPECT_FALSE(fs::exists(here / "again"));
}

TEST_F(DamagedRun, AnEarlierVersionsTrajectoryIsDrawnWithANote) {
    write_text(here / "run/trajectory.nc", without_checksums(text_of(here / "run/trajectory.nc")));
    const Ended film = program({"render", "run", "--no-film", "--frames", "--out", "again"});
    EXPECT_EQ(film.status, 0) << film.err;
    EXPECT_THAT(film.err, HasSubstr("run/trajectory.nc: has no checksums"));
}

// People who read the files look into docs/reference/run_files.md.
TEST_F(DamagedRun, TheDocumentationListsEveryVariable) {
    const std::string docs = text_of(fs::path(GRAINREEL_SOURCE) / "docs/reference/run_files.md");
    const std::size_t trajectory = docs.find("## The contents of trajectory.nc");
    const std::size_t contacts = docs.find("## The contents of contacts.nc");
    ASSERT_LT(trajectory, contacts);
    ASSERT_LT(contacts, docs.size());
    const auto expect_listed = [](const fs::path& path, const std::string& section) {
        int file = -1, variables = 0;
        ASSERT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file), NC_NOERR);
        nc_inq_nvars(file, &variables);
        EXPECT_GT(variables, 5);
        for (int i = 0; i < variables; ++i) {
            std::array<char, NC_MAX_NAME + 1> name{};
            nc_inq_varname(file, i, name.data());
            EXPECT_THAT(section, HasSubstr("`" + std::string(name.data()) + "`"));
        }
        nc_close(file);
    };
    expect_listed(here / "run/trajectory.nc", docs.substr(trajectory, contacts - trajectory));
    expect_listed(here / "run/contacts.nc",
                  docs.substr(contacts, docs.find("\n## ", contacts + 3) - contacts));
}

// A run may be killed after trajectory.nc was made and before its header was written.
TEST_F(DamagedRun, AnEmptyTrajectoryHoldsNoFrameYet) {
    write_text(here / "run/trajectory.nc", "");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"render", "run", "--at", "0", "--out", "drawn.png"},
          std::vector<std::string>{"inspect", "run", "--at", "0", "--no-replay"}}) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << words[0];
        EXPECT_THAT(ended.err, HasSubstr("run/trajectory.nc: holds no frame yet")) << words[0];
    }
}

}  // namespace
}  // namespace grainreel
