// What the user asks for: a film of a scene that is run, of a finished run that is drawn again or of a
// comparison, or a picture for print. Also how many threads a film gets, and which moments of a saved run are
// drawn. The verbs fill in the structs here, and the runs read them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/folder/folder_job.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/sources/shot_source.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The size of one picture for print.
struct PrintSize {
    std::optional<double> dpi, width_mm;
    bool pdf = false;  // a PDF in place of a PNG
    bool wanted() const { return dpi || width_mm || pdf; }
};

// Dots an inch of the picture; 0 when it is not for print.
double dots_an_inch(const PrintSize& print);

// Gives the film as many pixels as the width on paper needs, and keeps the ratio of its sides. Throws
// UserError when a side would be too small or too large.
void fit_to_paper(Film& film, const PrintSize& print);

struct FilmRequest : JobRequest {
    bool film = true;
    bool frames = false;
    bool to_stdout = false;  // the film goes to stdout; the folder's name then goes to stderr
    gl::Provider gl = gl::Provider::automatic;
};

// A film in parts. number: the part that is drawn; 0 draws all parts in one go, as if they had been joined.
struct PartsWanted {
    int number = 0, of = 1;
};

// What is to be drawn of a finished run. Times are s of the run; frames are counted in whole numbers.
struct RenderRequest {
    std::filesystem::path run;     // its folder
    std::filesystem::path beside;  // the folder for the result without --out; empty: beside the run
    // Another program's files have these: the user's name for them, and what was told while they were read.
    // log.txt has it too.
    std::string named;
    std::vector<std::string> told;
    Assignments sets;  // values given to keys of its film
    std::optional<double> from, to, at;
    std::optional<std::int64_t> frame;  // in place of `at`: number of the film's frame, from 0
    // In place of `at`: periods of the drive, and the part of the next one that has passed.
    std::optional<double> cycle;
    double phase = 0;
    bool frame_of_file = false;  // `frame` counts the frames of another program's files
    PrintSize print;             // size of one picture
    // Draws one in `every` kept frames of the trajectory. None: draws the pictures of the film.
    std::optional<int> every;
    bool replay = true;  // moments that were not kept are brought back
    std::optional<PartsWanted> parts;
};

// What is to be shown side by side.
struct CompareRequest {
    std::vector<std::filesystem::path> inputs;  // scene files and folders of runs
    Assignments sets;                           // values given to keys of every scene
    std::optional<std::string> captions;        // one for each panel, separated by "|"
    std::optional<std::string> vary;  // "drive.g_level=2,4": a panel for each value of one scene's key
    std::optional<double> at;         // s: one picture in place of a film
    PrintSize print;                  // size of that picture
    bool replay = true;               // moments that finished runs did not keep are brought back
};

// How many threads each part of a run gets, planned together so that engine, rasteriser and encoder share the
// machine.
struct ThreadPlan {
    int engine = 1;
    int raster = 1;           // threads of the software rasteriser, besides the drawing thread
    int encoder = 1;          // threads of x264
    bool take_turns = false;  // the engine rests while pictures are made, for lack of processors
};

// Plans the threads of a run. processors: the number that the run may keep busy. With a film, about a third
// of the work is drawing and encoding. The engine gets no more threads than its grains can use: a thread with
// too few grains waits longer than it works.
ThreadPlan plan_threads(int processors, bool film, std::int64_t grains);

// Plans the threads of a film that has the machine for itself. wanted: 0 for as many as the machine gives.
ThreadPlan drawing_threads(int wanted);

// s: the time at which `what.cycle` and `what.phase` periods have passed. Throws UserError where the run has
// no drive or ends before.
double time_of_cycle(const RenderRequest& what, const Clock& clock, double last);

// Throws UserError when `from` or `to` lies outside the run, which ends at `last` (s), or `from` after `to`.
// A time may be as far outside as kept moments are apart.
void check_times(const RenderRequest& what, const StateArchive& run, double last);

// The moments of a saved run that are drawn: those from `from` to `to`, or one in `every` of them. If they
// are all at one phase of the drive, only those stay at which the bed looks alike. Throws UserError when
// there is none.
std::vector<State> chosen_moments(const RenderRequest& what, const StateArchive& run);

// For moments at one phase of the drive: those that lie whole multiples of `periods` after the first one. A
// bed that repeats itself after `periods` looks alike there. Moments that are not at one phase all stay.
std::vector<State> alike(const std::vector<State>& moments, int periods);

// A warning for each segment of the scene's film whose pictures should show more than one moment but cannot.
std::vector<std::string> single_moment_warnings(const FilmedScene& scene, const std::string& why);

// The segments without means and exposures.
std::vector<FilmSegment> of_single_moments(std::vector<FilmSegment> segments);

// A note about a run whose bed repeats itself only every so many periods, when the scene does not set that
// number.
std::optional<std::string> periods_warning(const FilmedScene& scene, const StateArchive& run);

}  // namespace grainreel
