// run.json: what was run, with which program, and how it ended. It is written when the run begins (status
// "running") and replaced when it ends, so the file of a killed run still says "running". On a full disk the
// new text is written over the old one, in room that was reserved for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/grain_table.hpp"
#include "engine/measure/deepest_contact.hpp"
#include "engine/scene/keys/keys.hpp"

namespace grainreel {

// A part of a film that is drawn in several parts. The numbers tell how the parts are joined.
struct DrawnPart {
    int number = 1, of = 1;  // this part and the number of parts
    std::int64_t first_picture = 0, pictures = 0, all_pictures = 0;
    std::int64_t first_frame = 0, frames = 0, all_frames = 0;  // including still ones for a caption
    double rate = 0;                                           // frames per second
    std::string file, format;  // the film's file and its format; empty without one
    // Checksums of 16 hexadecimal digits. `run` is of the run, and `settings` of the settings that decide its
    // pictures; both are the same in all parts of a film. `checksum` is of the film's file, and it is empty
    // until that file is complete.
    std::string run, settings, checksum;
};

// XXH64 of a file's bytes, as 16 hexadecimal digits. Throws RunError when it cannot be read.
std::string checksum_of_file(const std::filesystem::path& path);

enum class RunStatus { running, complete, interrupted, failed };

// A finished run whose frames were drawn.
struct DrawnFrom {
    std::string folder;
    std::int64_t frames = 0;     // number of frames drawn
    double first = 0, last = 0;  // s, time of the first and the last of them
};

// The program that wrote the file.
struct ProgramInfo {
    std::string version, commit, compiler, build_flags;
    std::vector<std::pair<std::string, std::string>> libraries;  // names and versions
};

// All that run.json says.
struct RunJson : ProgramInfo {
    RunStatus status = RunStatus::running;
    std::optional<int> exit_status;  // exit status of the program; none while it runs
    std::string error;               // why a run failed

    // Earlier runs whose frames were drawn. If there are any, nothing was computed now, and the file says
    // nothing about the engine.
    std::vector<DrawnFrom> drawn;
    // The part, if the film is one of several parts.
    std::optional<DrawnPart> part;
    // For a film that shows several runs side by side (in panels): the folders with the files of each, in
    // this folder or of another run.
    std::vector<std::string> panels;
    std::vector<std::string> captions;  // of the panels, as --captions gave them; empty without it
    std::string title;                  // on that film

    std::string command;  // as typed, with words quoted where the shell needs it
    std::string scene_file;
    std::string gl;       // the OpenGL context that drew the film; empty without one
    std::string encoder;  // the film's encoder and its settings; empty without one
    std::string vector;   // the vector instructions that the engine used

    std::uint64_t seed = 0;
    int engine_threads = 0, raster_threads = 0, encoder_threads = 0;
    std::string started, finished;  // UTC, ISO 8601

    std::int64_t grains = 0;
    std::int64_t steps = 0, steps_planned = 0;  // since the drive started
    double step = 0;                            // s
    double simulated = 0;                       // s since the drive started
    std::optional<double> settled;  // s for which the bed settled before; none if nothing was packed
    std::optional<std::uint64_t> state_hash;  // hash of the end state

    std::vector<std::pair<std::string, double>> wall_seconds;  // of each stage, by its name
    double particle_steps_per_second = 0;                      // since the drive started, in the engine only
    std::optional<std::int64_t> film_frames = 0;  // 0 without a film; none while the film is open
    std::int64_t trajectory_frames = 0, measures_rows = 0;
    std::optional<TableMark> final_table;  // mark of final.csv, once it is written
    std::vector<AcceptedKey> accepted;     // in the order of time
    std::string page;                      // file name of the run's page; empty without one
    std::int64_t peak_memory = 0;          // bytes
    std::vector<std::string> warnings;
    std::optional<DeepestContact> deepest;  // none where nothing touched, or the run has not ended
    std::vector<std::string> missing;       // files that are still to be made after the run's end
};

inline constexpr const char* kPageIsMissing = "page";
// Whether the run has come to its end and only its page is missing.
inline bool lacks_only_page(const RunJson& record) {
    return record.missing == std::vector<std::string>{kPageIsMissing};
}

std::string to_string(RunStatus status);

// The present time in UTC: "2031-05-04T12:30:00Z".
std::string utc_now();

// Throws RunError when the file cannot be written; the old file stays then.
void write_run_json(const std::filesystem::path& path, const RunJson& record);

// run.json as it was read. Nothing in the file is trusted: what it lacks, or has in another form, stays as in
// a new RunJson, but that film_frames is none.
struct ReadRunJson {
    RunJson record;
    std::string status;  // the file's own word; empty where it has none
    std::string fault;   // why nothing is known: "run.json: is missing"; empty for the record of a run
};

ReadRunJson read_run_json(const std::filesystem::path& path);

// Changes the file to say that the run is complete. page: name of the file of its page, empty without one.
// Throws RunError.
void complete_run_json(const std::filesystem::path& path, const std::string& page);

}  // namespace grainreel
