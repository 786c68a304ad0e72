// The film's production line: frames go in on the engine's thread and pass a bounded queue, a drawing thread,
// another bounded queue and an encoding thread. None is dropped, and their order stays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/gl/provider.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What a film has that is not drawn in one go by itself.
struct FilmExtent {
    // A part of a film: s, simulated, of the whole film's pictures that come before its first one; rising.
    std::vector<double> earlier;
    bool poster = true;  // it has the picture that stands for the whole film
    // Frames from which on the encoder begins anew, counted from the film's first; rising.
    std::vector<std::int64_t> groups;
};

struct FilmOptions {
    std::filesystem::path folder;  // movie.mp4 (or .webm, ...), poster.png, sheet.png and frames/ go here
    bool film = true;              // the film, in its scene's format, and the pictures that stand for it
    bool frames = false;           // frames/000000.png ...; always with the format png
    bool page_copy = false;        // a small copy of the film too, where a page may need one
    bool to_stdout = false;        // the film goes to stdout in place of the folder: y4m only
    int raster_threads = 1;
    int encoder_threads = 1;
    bool take_turns = false;  // with who calls take(), which then waits while queued pictures are made
    gl::Provider gl = gl::Provider::automatic;
    FramePtr start;             // from which start heights are counted; null: the first picture's frame
    std::int64_t pictures = 0;  // planned, of the whole film; an orbit may last as long
    FilmExtent extent;
    // Called before a file is made in the folder or replaced there; throws RunError when that may not be.
    std::function<void()> check_folder = [] {};
};

struct FilmReport {
    bool complete = false;                        // not left as it was
    std::int64_t frames = 0;                      // in the film
    double draw_seconds = 0, encode_seconds = 0;  // busy time of the two threads
    double waited_seconds = 0;                    // the engine's, for a place in the queue
    std::string gl;                               // context description
    std::string file;                             // "movie.mp4"; empty without one
    bool pictures = false;                        // frames/ is there
    bool poster = false, sheet = false;           // poster.png, sheet.png are there
    std::string encoder;  // "H.264 in MP4: libx264 (...), crf 20, veryfast, 2 threads"; empty as above
    std::vector<std::string> notes;  // "1921x1080 padded to 1922x1080: ..."
};

// The frames that one picture shows: one, or one a panel, of the same moment.
using Frames = std::vector<FramePtr>;

// What turns frames into a picture: the Renderer, or a test's own. Made, used and destroyed on one thread.
class Drawer {
  public:
    virtual ~Drawer() = default;
    // Into an empty picture, or one that it has drawn before.
    virtual void draw(const Frames& frames, const std::string& playback, Picture& into) = 0;
    // Takes frames from before all that is drawn, for what leaves marks on later pictures.
    virtual void remember(const Frames&) {}
    virtual std::string description() const = 0;
    virtual std::string note() const { return {}; }       // what its user should know about it
    virtual std::string last_note() const { return {}; }  // and about all that it has drawn
};
using DrawerMaker = std::function<std::unique_ptr<Drawer>()>;

class FilmMaker {
  public:
    // Creates the film's file and folder. Throws RunError when they cannot be written.
    FilmMaker(const FilmedScene& scene, const FilmOptions& options);  // draws with the Renderer
    FilmMaker(const FilmedScene& scene, const FilmOptions& options, DrawerMaker make_drawer);
    ~FilmMaker();  // abandons what is queued; the film on disk still plays

    // Waits until the drawer is made and says what it is. Throws RunError when it cannot be made.
    std::string drawer();

    // Takes one picture's frames with their caption, which the film shows once, or for as long as a caption
    // of the scene that begins with it holds it (held_frames() more). Waits while the queue is full. Throws
    // RunError when drawing or encoding failed (disk full), with the first failure's words.
    void take(Frames frames, std::string playback);
    void take(FramePtr frame, std::string playback) { take(Frames{std::move(frame)}, std::move(playback)); }

    // Takes a picture's frames that come before the first one of this part of a film: trails show them, and
    // nothing is drawn. Throws RunError as above.
    void remember(FramePtr frame);

    // Draws and encodes what is queued and closes the film (remuxed to faststart). Throws RunError as above.
    // Neither take() nor finish() may follow. in_a_hurry: asked now and then; once it is true what is queued
    // is thrown away and the film left as it grew, which plays.
    FilmReport finish(const std::function<bool()>& in_a_hurry = {});

    std::int64_t frames_done() const;  // encoded so far

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
