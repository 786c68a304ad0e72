// Tests of `grainreel render --part` and `grainreel join` as a user sees them: a film drawn in parts is the
// same as the film drawn in one go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/film_length.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

using Words = std::vector<std::string>;

// A film whose pictures depend on earlier ones: it has trails, a plot, a moving camera, a caption that holds
// the film, and the heights that grains had at first.
constexpr const char* film_with_a_past = R"([[film.segment]]
playback = 0.25
[film.colour]
by = "start-height"
[[film.caption]]
from = "0.05 s"
to = "0.15 s"
text = "Look"
hold = "0.2 s"
[[film.plot]]
y = "kinetic"
[film.trails]
species = ["big"]
duration = "0.1 s"
[film.camera]
frame = "container"
orbit = 90
)";

class PartsOfFilm : public testing::Test {
  protected:
    Ended program(const Words& words) { return run_program(words, {here.path(), {}}); }
    void run(const std::string& name, const std::string& seed) {
        std::string text = small_scene_text;
        text.replace(text.find("[[film.segment]]"), std::string::npos, film_with_a_past);
        write_text(here / (name + ".toml"), text);
        const Ended ended =
            program({"movie", name + ".toml", "--out", name, "--no-film", "--no-report", "--seed", seed});
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    // Draws the parts a, b and c of a film of the run.
    void draw_parts(const Words& more = {}) {
        int number = 0;
        for (const std::string name : {"a", "b", "c"}) {
            Words words{"render", "run", "--part", std::to_string(++number) + "/3", "--out", name, "--force"};
            words.insert(words.end(), more.begin(), more.end());
            const Ended ended = program(words);
            ASSERT_EQ(ended.status, 0) << ended.err;
        }
    }
    void draw_whole(const Words& more = {}) {
        Words words{"render", "run", "--parts", "3", "--out", "whole", "--force"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = program(words);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    // Joins these parts and expects a refusal in one line and no film.
    void expect_refused(const Words& parts, const std::string& why) {
        Words words{"join"};
        words.insert(words.end(), parts.begin(), parts.end());
        words.insert(words.end(), {"--out", "film.mp4"});
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(why));
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
        EXPECT_FALSE(fs::exists(here / "film.mp4"));
        EXPECT_FALSE(fs::exists(here / "film.mp4.part"));
    }
    void change_record(const std::string& part, const std::string& key, const nlohmann::json& value) {
        const fs::path file = here / part / "run.json";
        nlohmann::json record = nlohmann::json::parse(text_of(file));
        (record.contains(key) ? record : record["part"])[key] = value;
        write_text(file, record.dump());
    }

    TemporaryFolder here;
};

TEST_F(PartsOfFilm, JoinedAreTheFilmOfOneGoToTheByte) {
    run("run", "1");
    draw_whole({"--frames"});
    draw_parts({"--frames"});
    const Ended ended = program({"join", "c", "a", "b", "--out", "film.mp4"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "film.mp4\n");
    EXPECT_TRUE(text_of(here / "film.mp4") == text_of(here / "whole/movie.mp4"));
    const int pictures = decoded_pictures(here / "film.mp4");
    EXPECT_EQ(pictures,
              31);  // 0.2 s at 30 a second and 1/4 speed, both ends included, and 6 pictures that are held
    int posters = 0, found = 0;
    for (const char* part : {"a", "b", "c"}) {
        if (fs::exists(here / part / "poster.png")) {
            ++posters;
            EXPECT_TRUE(text_of(here / part / "poster.png") == text_of(here / "whole/poster.png"));
        }
        for (const fs::directory_entry& entry : fs::directory_iterator(here / part / "frames")) {
            ++found;
            EXPECT_TRUE(text_of(entry.path()) == text_of(here / "whole/frames" / entry.path().filename()))
                << entry.path();
        }
    }
    EXPECT_EQ(posters, 1);
    EXPECT_EQ(found, pictures);
}

// The pictures are the same if the encoder chooses its own groups of pictures in place of those of parts.
TEST_F(PartsOfFilm, EachFormatThatHasAFileJoins) {
    run("run", "1");
    for (const auto& [format, file] :
         {std::pair("webm", "movie.webm"), {"ffv1", "movie.mkv"}, {"av1", "movie.mp4"}}) {
        draw_whole({"--format", format});
        draw_parts({"--format", format});
        const std::string film = std::string("film") + fs::path(file).extension().string();
        const Ended ended = program({"join", "a", "b", "c", "--out", film, "--force"});
        ASSERT_EQ(ended.status, 0) << format << ended.err;
        EXPECT_EQ(decoded_pictures(here / film), 31) << format;
        EXPECT_TRUE(text_of(here / film) == text_of(here / "whole" / file)) << format;
    }
}

TEST_F(PartsOfFilm, JoinRefusesWhatIsNotAllOfOneFilm) {
    run("run", "1");
    draw_parts();
    expect_refused({"a", "c"}, "part 2 of 3: missing; draw it by render --part");
    expect_refused({"a", "b", "c", "b"}, "b: is part 2 of 3, as b is");
    expect_refused({"a", "b", "run"}, "run: has no run.json of a part of a film");
    expect_refused({"a", "b", "nowhere"}, "nowhere: is no folder");
    const Words again{"render", "run", "--part", "2/3", "--out", "d", "--set", "film.background=black"};
    ASSERT_EQ(program(again).status, 0);
    expect_refused({"a", "d", "c"}, "d: was drawn with other settings");
    ASSERT_EQ(program({"render", "run", "--part", "2/4", "--out", "e"}).status, 0);
    expect_refused({"a", "e", "c"}, "e: is one of 4 parts, and a one of 3");
    run("other", "2");
    ASSERT_EQ(program({"render", "other", "--part", "2/3", "--out", "f"}).status, 0);
    expect_refused({"a", "f", "c"}, "f: is of another run");
    write_text(here / "film.mp4", "mine");
    EXPECT_EQ(program({"join", "a", "b", "c", "--out", "film.mp4"}).status, 2);
    EXPECT_EQ(text_of(here / "film.mp4"), "mine");
}

TEST_F(PartsOfFilm, JoinRefusesPartsThatAreDamaged) {
    run("run", "1");
    draw_parts();
    const std::string film = text_of(here / "b/movie.mp4"), record = text_of(here / "b/run.json");
    write_text(here / "b/movie.mp4", film.substr(0, film.size() / 2));
    expect_refused({"a", "b", "c"}, "b/movie.mp4: was cut off or changed");
    fs::remove(here / "b/movie.mp4");
    expect_refused({"a", "b", "c"}, "b/movie.mp4: is missing");
    write_text(here / "b/movie.mp4", film);
    change_record("b", "status", "running");
    expect_refused({"a", "b", "c"}, "b: is not complete (its run.json says running)");
    write_text(here / "b/run.json", record);
    change_record("b", "frames", 12);
    change_record("b", "pictures", 5);
    expect_refused({"a", "b", "c"}, "run.json");
    for (const nlohmann::json& wrong :
         {nlohmann::json(-3), nlohmann::json(1e30), nlohmann::json("many"), nlohmann::json(nullptr)}) {
        change_record("b", "frames", wrong);
        expect_refused({"a", "b", "c"}, "b: has no run.json of a part of a film");
    }
    write_text(here / "b/run.json", record);
    EXPECT_EQ(program({"join", "a", "b", "c", "--out", "film.mp4"}).status, 0);
}

TEST_F(PartsOfFilm, WhatCannotBeDrawnInPartsIsRefusedByName) {
    run("run", "1");
    const auto expect = [&](Words more, const std::string& why) {
        more.insert(more.begin(), {"render", "run"});
        const Ended ended = program(more);
        EXPECT_EQ(ended.status, 2);
        EXPECT_THAT(ended.err, HasSubstr(why));
    };
    expect({"--part", "1/3", "--format", "gif"}, "--part 1/3: a GIF is made as a whole");
    expect({"--part", "1/3", "--format", "y4m"}, "--part 1/3: films in y4m are not joined");
    expect({"--part", "1/3", "--max-size", "1MB"}, "--part 1/3: film.max_size is a cap on the whole film");
    expect({"--part", "1/20"}, "--part 1/20: the film has 25 pictures, and a part needs 4; 6 parts at most");
    expect({"--part", "4/3"}, "--part 4/3: is no part");
    expect({"--part", "0/3"}, "--part 0/3: is no part");
    expect({"--part", "1/3", "--at", "0.1"}, "--at");
    expect({"--part", "1/3", "--parts", "3"}, "--parts");
    expect({"--part", "1/3", "--follow"}, "--follow");
    expect({"--slurm", "3"}, "--slurm: the film needs a name");
    EXPECT_THAT(program({"compare", "run", "run", "--part", "1/3"}).err, HasSubstr("--part: is of render"));
}

}  // namespace
}  // namespace grainreel
