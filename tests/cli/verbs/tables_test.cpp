// Tests of measures.csv, final.csv, run.json and log.txt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_json.hpp"
#include "engine/grain_table.hpp"
#include "engine/run/folder/listener.hpp"
#include "tests/cli/made_frame.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using test::made_frame, test::made_measures, test::TemporaryFolder, test::text_of, test::write_text;
using test::tells;
using test::tells_only;
using testing::HasSubstr;

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

void expect_same_bits(const Vec3& a, const Vec3& b) {
    for (int k = 0; k < 3; ++k)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(a[k]), std::bit_cast<std::uint64_t>(b[k]));
}

TEST(GrainTable, ReadsBackBitByBit) {
    const TemporaryFolder here;
    State frame = made_frame(9, 4, true);
    frame.velocity[0] = {-0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()};
    frame.position[1] = {0.1, 1.0 / 3, 5e-324};
    write_grain_table(here / "final.csv", frame);
    const State back = read_grain_table(here / "final.csv");
    EXPECT_EQ(back.id, frame.id);
    EXPECT_EQ(back.species, frame.species);
    EXPECT_EQ(back.radius, frame.radius);
    ASSERT_EQ(back.size(), frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        expect_same_bits(back.position[i], frame.position[i]);
        expect_same_bits(back.velocity[i], frame.velocity[i]);
        expect_same_bits(back.spin[i], frame.spin[i]);
        EXPECT_EQ(back.orientation[i].coeffs(), frame.orientation[i].coeffs());
    }
}

// A spreadsheet's "CSV UTF-8" begins with a mark and ends its lines as on Windows.
TEST(GrainTable, IsReadAsASpreadsheetSavesIt) {
    const TemporaryFolder here;
    const State frame = made_frame(3, 4);
    write_grain_table(here / "final.csv", frame);
    std::string text = text_of(here / "final.csv");
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    for (const std::string& saved : {"\xef\xbb\xbf" + text_of(here / "final.csv"), "\xef\xbb\xbf" + text}) {
        write_text(here / "saved.csv", saved);
        EXPECT_EQ(read_grain_table(here / "saved.csv").position, frame.position);
    }
}

TEST(MeasuresCsv, IsReadAsASpreadsheetSavesIt) {
    const TemporaryFolder here;
    write_text(here / "measures.csv", "\xef\xbb\xbfstep,time_s\r\n1,0.5\r\n2,1\r\n");
    const auto table = read_measures(here / "measures.csv");
    ASSERT_TRUE(table);
    EXPECT_EQ(table->columns(), (std::vector<std::string>{"step", "time_s"}));
    EXPECT_EQ(table->values(1, 0, 2), (std::vector<double>{0.5, 1}));
}

std::string reading_error(const std::string& text) {
    const TemporaryFolder here;
    write_text(here / "final.csv", text);
    try {
        read_grain_table(here / "final.csv");
    } catch (const UserError& error) {
        return std::string(error.what()).substr(here.path().string().size() + 1);
    }
    return "no error";
}

constexpr const char* header = "id,type,radius,x,y,z,vx,vy,vz,wx,wy,wz\n";

TEST(GrainTable, MistakesAreNamedWithTheirPlace) {
    const std::string good = "0,1,0.1,0,0,0,0,0,0,0,0,0\n";
    const std::string h = header;
    EXPECT_EQ(reading_error(h + good), "no error");
    EXPECT_THAT(reading_error("id,x\n"), tells({"final.csv:1:1", "not a table"}));
    EXPECT_THAT(reading_error(h), HasSubstr("no grains"));
    EXPECT_THAT(reading_error(h + good + good), tells({"final.csv:3:1", "grain 0", "twice"}));
    EXPECT_THAT(reading_error(h + "0,1,0.1,0,oops,0,0,0,0,0,0,0\n"),
                tells({"final.csv:2:11", "`oops`", "no number", "`y`"}));
    EXPECT_THAT(reading_error(h + "0,1,0.1,0,nan,0,0,0,0,0,0,0\n"), HasSubstr("`y` is nan"));
    EXPECT_THAT(reading_error(h + "0,1,-1,0,0,0,0,0,0,0,0,0\n"),
                HasSubstr("final.csv:2:5: `radius` is not positive"));
    EXPECT_THAT(reading_error(h + "0,1,0.1,0,0,0,0,0,0,0,0\n"), HasSubstr("the row ends before `wz`"));
    EXPECT_THAT(reading_error(h + "0,1,0.1,0,0,0,0,0,0,0,0,0,7\n"), HasSubstr("more columns"));
    EXPECT_THAT(reading_error(h + "0,0,0.1,0,0,0,0,0,0,0,0,0\n"),
                tells({"final.csv:2:3", "`type` is 0", "from 1"}));
    EXPECT_THROW(read_grain_table("/nowhere/final.csv"), UserError);
}

// In these tables the column was `species`, counted from 0.
TEST(GrainTable, TablesOfEarlierVersionsAreReadAsTheyWereMeant) {
    const TemporaryFolder here;
    const std::string columns = "radius,x,y,z,vx,vy,vz,wx,wy,wz\n", rest = ",0.1,0,0,0,0,0,0,0,0,0\n";
    write_text(here / "old.csv", "id,species," + columns + "0,0" + rest + "1,1" + rest);
    write_text(here / "new.csv", "id,type," + columns + "0,1" + rest + "1,2" + rest);
    for (const char* file : {"old.csv", "new.csv"})
        EXPECT_THAT(read_grain_table(here / file).species, testing::ElementsAre(0, 1)) << file;
    EXPECT_THAT(reading_error("id,species," + columns + "0,-1" + rest),
                tells({"final.csv:2:3", "`species` is -1", "from 0"}));
}

// Readers of the file rely on names and order in the header.
TEST(MeasuresCsv, HasAColumnForEveryNumber) {
    const TemporaryFolder here;
    const std::vector<std::string> species{"small", "big, \"round\""};
    {
        MeasuresWriter writer(here / "m.csv", made_measures(1, species).names());
        writer.write(made_measures(1, species));
        writer.write(made_measures(2, species));
        EXPECT_EQ(writer.rows(), 2);
    }
    const std::vector<std::string> lines = split(text_of(here / "m.csv"), '\n');
    ASSERT_EQ(lines.size(), 3u);
    const std::vector<double> expected = made_measures(2, species).values();
    const std::vector<std::string> columns{"step",
                                           "time_s",
                                           "phase_turns",
                                           "cycles",
                                           "kinetic_J",
                                           "rotational_J",
                                           "gravitational_J",
                                           "elastic_J",
                                           "wall_work_J",
                                           "lost_J",
                                           "centre_x_m",
                                           "centre_y_m",
                                           "centre_z_m",
                                           "small_centre_x_m",
                                           "small_centre_y_m",
                                           "small_centre_z_m",
                                           "small_height_m",
                                           "big_ _round__centre_x_m",
                                           "big_ _round__centre_y_m",
                                           "big_ _round__centre_z_m",
                                           "big_ _round__height_m",
                                           "height_difference",
                                           "big_above_small",
                                           "big_in_top_quarter",
                                           "big_in_bottom_quarter",
                                           "big_at_walls",
                                           "unlike_neighbours",
                                           "lacey",
                                           "intensity",
                                           "contact_number",
                                           "fabric_anisotropy",
                                           "fabric_vertical",
                                           "largest_overlap",
                                           "floor_position_m",
                                           "bed_periods",
                                           "period_difference_m",
                                           "drive_frequency_Hz",
                                           "drive_g_level",
                                           "bed_top_m",
                                           "bed_solid_fraction"};
    const std::vector<std::string> names = split(lines[0], ','), values = split(lines[2], ',');
    EXPECT_EQ(names, columns);
    ASSERT_EQ(values.size(), expected.size());
    std::set<double> different;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        double number = std::numeric_limits<double>::quiet_NaN();
        std::from_chars(values[i].data(), values[i].data() + values[i].size(), number);
        EXPECT_EQ(number, expected[i]) << names[i];
        different.insert(number);
    }
    EXPECT_EQ(different.size(), expected.size()) << "two that are exchanged would not be seen";
}

TEST(MeasuresCsv, AFullDiskIsARunErrorThatNamesFileAndReason) {
    try {
        MeasuresWriter writer("/dev/full", {});
        FAIL() << "/dev/full took a line";
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), tells_only({"/dev/full", "cannot be written", "No space left"}));
    }
}

TEST(RunJson, HoldsTheRecord) {
    const TemporaryFolder here;
    RunJson record;
    record.command = "grainreel movie 'my scene.toml'";
    record.libraries = {{"NetCDF", "4.9.0"}};
    record.state_hash = 0x0123456789abcdefull;
    record.seed = std::numeric_limits<std::uint64_t>::max();
    record.wall_seconds = {{"engine", 1.5}};
    record.warnings = {"bytes that are no UTF-8: \xff"};
    write_run_json(here / "run.json", record);
    const nlohmann::json running = nlohmann::json::parse(text_of(here / "run.json"));
    EXPECT_EQ(running["status"], "running");
    EXPECT_TRUE(running["exit_status"].is_null());

    record.status = RunStatus::interrupted;
    record.exit_status = 130;
    write_run_json(here / "run.json", record);
    const nlohmann::json ended = nlohmann::json::parse(text_of(here / "run.json"));
    EXPECT_EQ(ended["status"], "interrupted");
    EXPECT_EQ(ended["exit_status"], 130);
    EXPECT_EQ(ended["command"], record.command);
    EXPECT_EQ(ended["program"]["libraries"]["NetCDF"], "4.9.0");
    EXPECT_EQ(ended["engine"]["state_hash"], "0123456789abcdef");
    EXPECT_EQ(ended["engine"]["seed"], record.seed);
    EXPECT_EQ(ended["wall_s"]["engine"], 1.5);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(here.path()), {}), 1);  // nothing left over
}

// Every member has a value of its own, so that a reader that takes the wrong one is found.
RunJson full_record() {
    RunJson r;
    r.version = "9.8";
    r.commit = "3f2a";
    r.compiler = "g++";
    r.build_flags = "-O2";
    r.libraries = {{"NetCDF", "4.9.0"}, {"fmt", "9"}};
    r.status = RunStatus::failed;
    r.exit_status = 3;
    r.error = "the disk is full";
    r.part.emplace();
    r.part->number = 2;
    r.part->of = 3;
    r.part->first_picture = 4;
    r.part->pictures = 5;
    r.part->all_pictures = 11;
    r.part->first_frame = 6;
    r.part->frames = 7;
    r.part->all_frames = 13;
    r.part->rate = 25;
    r.part->file = "film.mp4";
    r.part->format = "mp4";
    r.part->run = "00000000000000aa";
    r.part->settings = "00000000000000bb";
    r.part->checksum = "00000000000000cc";
    r.command = "grainreel movie a.toml";
    r.scene_file = "a.toml";
    r.gl = "llvmpipe";
    r.encoder = "libx264";
    r.vector = "AVX2";
    r.seed = std::numeric_limits<std::uint64_t>::max();
    r.engine_threads = 4;
    r.raster_threads = 8;
    r.encoder_threads = 16;
    r.started = "2031-05-04T12:30:00Z";
    r.finished = "2031-05-04T12:40:00Z";
    r.grains = 100;
    r.steps = 200;
    r.steps_planned = 300;
    r.step = 1e-6;
    r.simulated = 2e-4;
    r.state_hash = 0xfedcba9876543210ull;
    r.wall_seconds = {{"engine", 1.5}, {"film", 2.5}};
    r.particle_steps_per_second = 1e7;
    r.film_frames = 25;
    r.trajectory_frames = 26;
    r.measures_rows = 27;
    r.final_table = TableMark{100, 0x123456789abcdefull};
    r.accepted = {{.step = 50, .key = "contact.friction", .then = "0.3", .now = "0.4"}};
    r.page = "report.html";
    r.peak_memory = 1 << 20;
    r.warnings = {"one", "two"};
    r.missing = {kPageIsMissing};
    return r;
}

TEST(RunJson, IsReadAsItWasWritten) {
    const TemporaryFolder here;
    RunJson compared = full_record();  // a film of several runs: nothing about an engine
    compared.drawn = {{.folder = "../a", .frames = 9, .first = 0.25, .last = 0.5}};
    compared.panels = {"left", "right"};
    for (const RunJson& record : {full_record(), compared, RunJson()}) {
        write_run_json(here / "run.json", record);
        const ReadRunJson read = read_run_json(here / "run.json");
        EXPECT_EQ(read.fault, "");
        EXPECT_EQ(read.status, to_string(record.status));
        write_run_json(here / "again.json", read.record);
        EXPECT_EQ(text_of(here / "again.json"), text_of(here / "run.json"));
    }
}

TEST(RunJson, WhatHasAnotherFormIsLeftOut) {
    const TemporaryFolder here;
    const auto read = [&](const std::string& text) {
        write_text(here / "run.json", text);
        return read_run_json(here / "run.json");
    };
    EXPECT_THAT(read_run_json(here / "none.json").fault, testing::EndsWith("none.json: is missing"));
    EXPECT_THAT(read("{\"status\": \"run").fault, testing::HasSubstr("no JSON"));
    EXPECT_THAT(read("[]").fault, testing::HasSubstr("no record of a run"));
    EXPECT_THAT(read(R"({"scene": "a.toml"})").fault, testing::HasSubstr("no record of a run"));
    const RunJson odd = read(R"({"status": 7, "warnings": {"a": 1}, "threads": [1],
        "engine": {"seed": -1, "grains": 2.5, "steps": 1e300, "state_hash": "0x12"},
        "accepted": [{"key": "k"}, 3, {"step": 4, "key": "l"}], "exit_status": 99999999999,
        "part": {"number": 2, "of": 1}})")
                            .record;
    EXPECT_EQ(odd.status, RunStatus::running);
    EXPECT_TRUE(odd.warnings.empty());
    EXPECT_EQ(odd.seed, 0u);
    EXPECT_EQ(odd.grains, 0);
    EXPECT_EQ(odd.steps, 0);
    EXPECT_FALSE(odd.state_hash);
    EXPECT_FALSE(odd.exit_status);
    EXPECT_FALSE(odd.part);
    ASSERT_EQ(odd.accepted.size(), 1u);
    EXPECT_EQ(odd.accepted[0].key, "l");
}

// A part of a film is believed only where it lies within the film.
TEST(RunJson, APartMustLieWithinItsFilm) {
    const TemporaryFolder here;
    const auto is_taken = [&](const auto& change) {
        RunJson record = full_record();
        change(*record.part);
        write_run_json(here / "run.json", record);
        return read_run_json(here / "run.json").record.part.has_value();
    };
    EXPECT_TRUE(is_taken([](DrawnPart&) {}));
    EXPECT_FALSE(is_taken([](DrawnPart& part) { part.number = 4; }));
    EXPECT_FALSE(is_taken([](DrawnPart& part) { part.first_picture = -1; }));
    EXPECT_FALSE(is_taken([](DrawnPart& part) { part.first_picture = 7; }));
    EXPECT_FALSE(is_taken([](DrawnPart& part) { part.all_frames = 12; }));
    EXPECT_FALSE(is_taken([](DrawnPart& part) { part.frames = 4; }));
    EXPECT_FALSE(is_taken([](DrawnPart& part) { part.rate = 0; }));
    EXPECT_FALSE(is_taken([](DrawnPart& part) { part.file = "../film.mp4"; }));
}

// A folder with the new file's name stands for the full disk: no new file can be made.
TEST(RunJson, IsWrittenInPlaceWhereNoNewFileCanBeHad) {
    const TemporaryFolder here;
    RunJson record;
    record.command = "grainreel movie long.toml";
    write_run_json(here / "run.json", record);
    std::filesystem::create_directories(here / ".run.json.part/in the way");
    for (const std::string& error : {std::string(9000, 'x'), std::string("short")}) {
        record.status = RunStatus::failed;
        record.error = error;
        write_run_json(here / "run.json", record);
        const nlohmann::json ended = nlohmann::json::parse(text_of(here / "run.json"));
        EXPECT_EQ(ended["status"], "failed");
        EXPECT_EQ(ended["error"], error);
    }
    EXPECT_THROW(write_run_json(here / "none/run.json", record), RunError);
}

TEST(RunLog, EveryLineIsOnDiskAtOnceWithItsTime) {
    const TemporaryFolder here;
    RunLog log(here / "log.txt");
    log.info("begun {} %v");
    EXPECT_THAT(text_of(here / "log.txt"),
                testing::MatchesRegex("[0-9-]+ [0-9:.]+  info +begun \\{\\} %v\n"));
    log.warning("hot");
    EXPECT_THAT(text_of(here / "log.txt"), HasSubstr("warning  hot\n"));
}

TEST(RunLog, AFullDiskDoesNotStopTheRun) {
    RunLog log("/dev/full");
    EXPECT_NO_THROW(log.info("lost"));
}

}  // namespace
}  // namespace grainreel
