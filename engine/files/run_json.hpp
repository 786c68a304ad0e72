// run.json: what was run, with what, and how it went. Written when the run begins (status "running") and
// again, in one stroke, when it ends; a run that was killed still says "running". On a full disk its last
// word takes the place of its first, for which there is room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/grain_table.hpp"
#include "engine/scene/keys/keys.hpp"

namespace grainreel {

// What run.json says of a film that is one of several parts, so that they can be joined.

struct DrawnPart {
    int number = 1, of = 1;
    std::int64_t first_picture = 0, pictures = 0, all_pictures = 0;
    std::int64_t first_frame = 0, frames = 0, all_frames = 0;  // with those that stand still for a caption
    double rate = 0;                                           // frames a second
    std::string file, format;                                  // its film: a file's name; empty without one
    // Checksums, 16 hexadecimal digits each: of the run and of what decides its pictures, by which parts of
    // one film know each other; and of the film's file, empty until that is complete.
    std::string run, settings, checksum;
};

// A part, as its run.json has it.
struct PartJson : DrawnPart {
    std::string status;   // as RunStatus in words
    std::string program;  // "grainreel 0.9 (3f2a...)"
    std::string encoder, gl;
};

// None when the file is not there, is no run.json, or is not of a part. What it says of the part is
// consistent in itself: of counts none is negative, and the part lies in the whole.
std::optional<PartJson> part_in_run_json(const std::filesystem::path& path);

// XXH64 of a file's bytes. Throws RunError when it cannot be read.
std::string checksum_of_file(const std::filesystem::path& path);

enum class RunStatus { running, complete, interrupted, failed };

// A finished run whose frames were drawn.
struct DrawnRun {
    std::string folder;
    std::int64_t frames = 0;     // drawn of it
    double first = 0, last = 0;  // s, their times
};

// The program that wrote it.
struct ProgramInfo {
    std::string version, commit, compiler, build_flags;
    std::vector<std::pair<std::string, std::string>> libraries;  // name, version
};

struct RunJson : ProgramInfo {
    RunStatus status = RunStatus::running;
    std::optional<int> exit_status;  // of the program; none while running
    std::string error;               // what ended a failed run

    // What was drawn without being run; then nothing is said of the engine.
    std::vector<DrawnRun> drawn;
    // Which part of a film this one is; none for a whole film.
    std::optional<DrawnPart> part;
    // Where the files of each panel of a film are: a folder beside run.json, or another run's.
    std::vector<std::string> panels;

    std::string command;  // as typed, words quoted where the shell needs it
    std::string scene_file;
    std::string gl;       // of the context that drew the film; empty without one
    std::string encoder;  // of the film: what, and how it was set up; empty without one
    std::string vector;   // vector instructions the engine used

    std::uint64_t seed = 0;
    int engine_threads = 0, raster_threads = 0, encoder_threads = 0;
    std::string started, finished;  // UTC, ISO 8601

    std::int64_t grains = 0;
    std::int64_t steps = 0, steps_planned = 0;  // of vibration
    double step = 0;                            // s
    double simulated = 0;                       // s, since the drive started
    std::optional<std::uint64_t> state_hash;    // of the end state

    std::vector<std::pair<std::string, double>> wall_seconds;  // by stage
    double particle_steps_per_second = 0;                      // of vibration, time in the engine alone
    std::optional<std::int64_t> film_frames = 0;               // none while the film is being closed
    std::int64_t trajectory_frames = 0, measures_rows = 0;
    std::optional<TableMark> final_table;  // of final.csv, once it is written
    std::vector<AcceptedKey> accepted;     // in the order of time
    std::string page;                      // file name of the run's page; empty without one
    std::int64_t peak_memory = 0;          // bytes
    std::vector<std::string> warnings;
    std::vector<std::string> missing;  // what has yet to be made of a run that has come to its end
};

inline constexpr const char* kPageIsMissing = "page";

std::string to_string(RunStatus status);

// Now, in UTC: "2031-05-04T12:30:00Z".
std::string utc_now();

// Throws RunError when the file cannot be written; what it held before stays then.
void write_run_json(const std::filesystem::path& path, const RunJson& record);

// The scene file that such a file names, and its status; empty where it says none.
std::string scene_in_run_json(const std::filesystem::path& path);
std::string status_in_run_json(const std::filesystem::path& path);
// Whether such a file says that the run has come to its end, and that its page alone is missing.
bool lacks_only_page(const std::filesystem::path& path);
// The run in such a file is complete; page: the name of its page's file, empty without one. Throws RunError.
void complete_run_json(const std::filesystem::path& path, const std::string& page);
// `panels` of such a file; empty when it has none or is no such file.
std::vector<std::string> panels_in_run_json(const std::filesystem::path& path);
// What was accepted on the run's way; empty when nothing was, or there is no such file.
std::vector<AcceptedKey> accepted_in_run_json(const std::filesystem::path& path);

}  // namespace grainreel
