// What the user asks of a film: of one that is run, drawn again or compared; for print; with how many
// threads; and of which moments of a saved run. It holds values only: verbs fill it in, runs read it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/folder/folder_run.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The size of one picture for print.
struct PrintSize {
    std::optional<double> dpi, width_mm;
    bool wanted() const { return dpi || width_mm; }
};

// 0 where the picture is not for print.
double dots_an_inch(const PrintSize& print);

// Gives the film so many pixels as the width on paper needs, with its own ratio of the sides. Throws
// UserError where a side would be too small or too large.
void fit_to_paper(Film& film, const PrintSize& print);

struct FilmRequest : RunRequest {
    bool film = true;
    bool frames = false;
    bool to_stdout = false;  // the film; the folder's name then goes to stderr
    gl::Provider gl = gl::Provider::automatic;
};

// A film in parts: the one of this number, or with 0 all of them in one go, as if they had been joined.
struct PartsWanted {
    int number = 0, of = 1;
};

// What is to be drawn of a finished run. Times in s, of the run; whole numbers of frames.
struct RenderRequest {
    std::filesystem::path run;     // its folder
    std::filesystem::path beside;  // where what is drawn goes without --out; empty: beside the run
    Assignments sets;              // other values for keys of its film
    std::optional<double> from, to, at;
    std::optional<std::int64_t> frame;  // in place of `at`: of the film, from 0
    bool frame_of_file = false;         // frame counts the frames of another program's files
    PrintSize print;                    // of one picture
    std::optional<int> every;  // kept frames of the trajectory, one of so many; none: the film's pictures
    bool replay = true;        // what was not kept is brought back
    std::optional<PartsWanted> parts;
};

// What is to be shown side by side.
struct CompareRequest {
    std::vector<std::filesystem::path> inputs;  // scene files and folders of runs
    Assignments sets;                           // for every scene
    std::optional<std::string> captions;        // one a panel, bars between them
    std::optional<std::string> vary;  // "drive.g_level=2,4": a panel for each value of one scene's key
    std::optional<double> at;         // s: one picture in place of a film
    PrintSize print;                  // of that picture
    bool replay = true;               // of finished runs what was not kept is brought back
};

// How many threads each part of a run gets, planned together so that engine, rasteriser and encoder share the
// machine.
struct ThreadPlan {
    int engine = 1;
    int raster = 1;           // of the software rasteriser, beside the drawing thread
    int encoder = 1;          // of x264
    bool take_turns = false;  // the engine rests while pictures are made: there are no processors for both
};

// processors: as many as the run may keep busy. With a film, about a third of the work is drawing and
// encoding. A thread with too few grains waits longer than it works.
ThreadPlan plan_threads(int processors, bool film, std::int64_t grains);

// The threads of a film that has the machine for itself. wanted: 0 for as many as the machine gives.
ThreadPlan drawing_threads(int wanted);

// The moments of a saved run that are drawn: every so many from `from` to `to`. Of frames at one phase of the
// drive only those are taken at which the bed looks alike. Throws UserError when there is none.
std::vector<Frame> chosen_moments(const RenderRequest& what, const FrameArchive& run);

// Moments at one phase of the drive that lie whole multiples of `periods` behind the first: a bed
// that repeats itself after so many looks alike there. Others are left as they are.
std::vector<Frame> alike(const std::vector<Frame>& moments, int periods);

// A line for each segment of the scene's film whose pictures are to show more than a moment, where they
// cannot.
std::vector<std::string> single_moment_warnings(const FilmedScene& scene, const std::string& why);

// Without means and exposures.
std::vector<FilmSegment> of_single_moments(std::vector<FilmSegment> segments);

// What is to be said of a run whose bed repeats itself only every so many periods, where the scene leaves it
// open.
std::optional<std::string> periods_warning(const FilmedScene& scene, const FrameArchive& run);

}  // namespace grainreel
