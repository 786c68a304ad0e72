// The film's production line: frames go in on the engine's thread and pass a bounded queue, a drawing thread,
// another bounded queue and an encoding thread. No frame is dropped, and their order stays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/state/state.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The place of a part in its film, when the film is not drawn in one go.
struct FilmExtent {
    // Simulated times (s, rising) of the whole film's pictures that come before this part's first one.
    std::vector<double> earlier;
    bool poster = true;  // whether this part has the picture that stands for the whole film
    // Numbers of the frames at which the encoder begins a new group (FilmWriter::begin_group()), rising;
    // counted from the first frame that is drawn here.
    std::vector<std::int64_t> groups;
};

struct FilmOptions {
    std::filesystem::path folder;  // movie.mp4 (or .webm, ...), poster.png, sheet.png and frames/ go here
    bool film = true;              // the film, in its scene's format, and the pictures that stand for it
    bool frames = false;     // numbered pictures (frames/000000.png ...); the format png always has them
    bool page_copy = false;  // makes a small copy of the film too, where a page may need one
    bool to_stdout = false;  // the film goes to stdout in place of the folder: y4m only
    int raster_threads = 1;
    int encoder_threads = 1;
    // The film takes turns with the caller of take(), which waits while queued pictures are made.
    bool take_turns = false;
    gl::Provider gl = gl::Provider::automatic;
    // The frame that decides the grains' heights at the start; null: the first picture's frame.
    StatePtr start;
    std::int64_t pictures = 0;  // planned number for the whole film; a camera's orbit may last as long as it
    FilmExtent extent;
    // Called before a file is made or replaced in the folder; throws RunError when that is not allowed.
    std::function<void()> check_folder = [] {};
};

struct FilmResult {
    bool complete = false;                        // the film was closed, not abandoned
    std::int64_t frames = 0;                      // number of frames in the film
    double draw_seconds = 0, encode_seconds = 0;  // busy time of the two threads
    double waited_seconds = 0;                    // how long the engine waited for a place in the queue
    std::string gl;                               // description of the OpenGL context
    std::string file;                             // "movie.mp4"; empty without one
    bool pictures = false;                        // whether frames/ is there
    bool poster = false, sheet = false;           // poster.png, sheet.png are there
    std::string encoder;  // "H.264 in MP4: libx264 (...), crf 20, veryfast, 2 threads"; empty without a film
    std::vector<std::string> notes;  // for the user: "1921x1080 padded to 1922x1080: ..."
};

// What one picture shows: a single shot, or one for each panel, all of the same moment.
using Shots = std::vector<ShotPtr>;

// Turns shots into a picture. A film of one scene has a RendererDrawer (film_maker.cpp), a comparison a
// SideBySideDrawer (compare_run.cpp). A drawer is made, used and destroyed on one thread.
class Drawer {
  public:
    virtual ~Drawer() = default;
    // Draws into an empty picture, or one that this drawer has drawn before.
    virtual void draw(const Shots& shots, const std::string& playback, Picture& into) = 0;
    // Takes shots that come before the first drawn one. Trails on later pictures may show them.
    virtual void remember(const Shots&) {}
    virtual std::string description() const = 0;
    virtual std::string note() const { return {}; }  // what the user should know about the drawer
    // What the user should know about all pictures that it has drawn.
    virtual std::string last_note() const { return {}; }
};
using DrawerMaker = std::function<std::unique_ptr<Drawer>()>;

class FilmMaker {
  public:
    // Creates the film's file and folder. Throws RunError when they cannot be written.
    FilmMaker(const FilmedScene& scene, const FilmOptions& options);  // draws with the Renderer
    FilmMaker(const FilmedScene& scene, const FilmOptions& options, DrawerMaker make_drawer);
    ~FilmMaker();  // drops what is queued; the film on disk still plays

    // Waits until the drawer is made and says what it is. Throws RunError when it cannot be made.
    std::string drawer();

    // Takes what one picture shows, with its caption. The film shows the picture once, or held_frames() more
    // times when a caption of the scene begins with it. Waits while the queue is full. Throws RunError with
    // the words of the first failure when drawing or encoding failed (disk full, say).
    void take(Shots shots, std::string playback);
    void take(ShotPtr shot, std::string playback) { take(Shots{std::move(shot)}, std::move(playback)); }

    // Takes a shot that comes before the first picture of this part of a film. Nothing is drawn, but trails
    // show it. Throws RunError as above.
    void remember(ShotPtr shot);

    // Draws and encodes what is queued and closes the film (remuxed to faststart). Throws RunError as above.
    // Neither take() nor finish() may follow. in_a_hurry is called now and then. Once it returns true, what
    // is queued is thrown away and the film is left as it was written; it plays.
    FilmResult finish(const std::function<bool()>& in_a_hurry = {});

    std::int64_t frames_done() const;  // frames encoded so far

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
