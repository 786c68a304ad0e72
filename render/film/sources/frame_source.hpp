// A source of frames for pictures: a scene that is being run (SceneRun) or a run that lies on disk
// (RecordedRun). Whoever draws, looks or counts takes frames from here and need not know which it is.
//
// Each frame comes with all that the scene's film shows beside the grains. PictureParts adds it, from what
// the source can supply.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/frame.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What a source has beside grains and container. What a film asks for and the source lacks is left out of the
// pictures, and news() says so.
struct Supply {
    bool any_moment = false;    // each step of its span; else those of its archive alone
    bool contacts = false;      // Frame::touches
    bool measures = false;      // Frame::measures
    bool orientations = false;  // Frame::orientation
};

// s of simulated time, both ends included.
struct Span {
    double from = 0, to = 0;
};

// What a film asks for: one picture an instant, by rising time.
struct Pictures {
    std::vector<Instant> instants;
    std::vector<FilmSegment> segments;  // by whose rules they are taken
    // A bed that repeats itself only every so many periods lacks locked ones, and they do not come.
    bool may_leave_out = false;
};

struct Taken {
    FramePtr frame;
    int segment = 0;  // of the film
    int periods = 1;  // of the drive, after which the bed repeats itself, as the film has it
};

class FrameSource {
  public:
    // Asked every tenth of a second or so; false: stop.
    using GoOn = std::function<bool()>;

    virtual ~FrameSource() = default;

    virtual const FilmedScene& scene() const = 0;  // as it is drawn
    virtual Supply supply() const = 0;
    virtual Span span() const = 0;
    // Null for what is only being computed.
    virtual const FrameArchive* archive() const { return nullptr; }

    // The moment that each picture would show: a frame without grains.
    virtual std::vector<Frame> moments(const Pictures& pictures) const = 0;
    // Says what next() is to yield. Once.
    virtual void start(const Pictures& pictures) = 0;
    // The next picture. Empty after the last (a scene has then been run to its end), and when told to stop.
    // Throws RunError when a run cannot go on, UserError when what is read is damaged.
    virtual std::optional<Taken> next(const GoOn& go_on) = 0;

    // What the user is to know of it, a line each; more may come at the end while pictures are taken.
    virtual std::vector<std::string> news() const = 0;
};

}  // namespace grainreel
