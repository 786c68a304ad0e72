// A source of frames for pictures: a scene that is being run (LiveShots) or a run that lies on disk
// (StoredShots). Code that draws or looks at frames takes them from here and need not know
// which of the two it is.
//
// Each frame comes with all that the scene's film shows besides the grains. PictureParts adds it, from what
// the source can supply.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/state/state.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A span of simulated time in s, both ends included.
struct Span {
    double from = 0, to = 0;
};

// The pictures that a film asks for: one for each instant, by rising time.
struct Pictures {
    std::vector<Instant> instants;
    std::vector<FilmSegment> segments;  // the rules by which pictures are taken
    // Whether locked pictures may be left out. When a bed repeats itself only every so many periods, the film
    // then shows only the locked pictures at which the bed looks alike (PeriodChoice).
    bool may_leave_out = false;
};

struct Taken {
    ShotPtr frame;
    int segment = 0;  // the film's segment
    int periods = 1;  // periods of the drive after which the bed repeats itself, as the film takes it
};

class ShotSource {
  public:
    // Is called about every tenth of a second; returning false stops the work.
    using GoOn = std::function<bool()>;

    virtual ~ShotSource() = default;

    virtual const FilmedScene& scene() const = 0;  // the scene as it is drawn
    // Whether it has every step of its span; else only the moments of its archive.
    virtual bool has_any_moment() const = 0;
    virtual Span span() const = 0;
    // The frames on disk; null for a run that is only being computed.
    virtual const StateArchive* archive() const { return nullptr; }

    // The moment that each picture would show, as a frame without grains.
    virtual std::vector<State> moments(const Pictures& pictures) const = 0;
    // Tells the source which pictures next() has to give. To be called once.
    virtual void start(const Pictures& pictures) = 0;
    // Gives the next picture. Empty after the last one (a scene has then been run to its end), and when told
    // to stop. Throws RunError when a run cannot go on, UserError when the files are damaged.
    virtual std::optional<Taken> next(const GoOn& go_on) = 0;

    // Lines that the user should see. More lines may be added at the end while pictures are taken.
    virtual std::vector<std::string> news() const = 0;
};

}  // namespace grainreel
