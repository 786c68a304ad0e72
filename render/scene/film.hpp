// What a scene file says of its film: plain values in SI units, defaults filled in.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "render/scene/film_look.hpp"
#include "render/scene/film_shows.hpp"

namespace grainreel {

struct Colour {
    double red = 0, green = 0, blue = 0;  // sRGB, 0 to 1
    bool operator==(const Colour&) const = default;
};

struct FilmSegment {
    enum class Kind { motion, locked };
    Kind kind = Kind::motion;
    std::optional<double>
        duration;         // s simulated; at most one segment has none and takes what the others leave
    double playback = 1;  // motion: simulated seconds a second of film (0.1 = ten times slower)
    int every = 1;        // locked: one frame every 1, 2 or 4 periods ...
    double phase = 0;     // ... at this phase, turns
    // What each picture shows up to its moment; at most one of the two.
    int average = 0;      // whole periods, in which the grains' mean places are drawn; 0: none
    double exposure = 0;  // s, of an open shutter; 0: one moment
    int exposures = 16;   // moments in that time; locked: at most one a period
    bool operator==(const FilmSegment&) const = default;
};

// Words that the film shows for a while.
struct FilmCaption {
    double from = 0, to = 0;  // s of simulated time
    std::string text;
    double hold = 0;  // s of film that the picture stands still at the caption's beginning
    bool operator==(const FilmCaption&) const = default;
};
// Whether it is there at that simulated time, s; a frame that is early by rounding counts as there.
inline bool shows_caption(const FilmCaption& caption, double time) {
    constexpr double rounding = 1e-9;
    return time >= caption.from - rounding && time < caption.to - rounding;
}

// Words beside a grain.
struct FilmLabel {
    int id = 0;
    std::string text;
    bool operator==(const FilmLabel&) const = default;
};

// Where the camera is at one moment of the film; what is left empty follows from the other keys.
struct CameraKey {
    double time = 0;  // s of film
    std::optional<double> azimuth, elevation, zoom;
    std::optional<Vec3> target;
    bool operator==(const CameraKey&) const = default;
};

// What the automatic framing has in the picture: all of the container, the bed at rest, or what the grains
// reach in the course of the film. Of a container higher than that the upper part runs out of the picture.
enum class CameraFrame { container, bed, reach };

struct Camera {
    CameraFrame frame = CameraFrame::reach;
    std::optional<double> reach;  // m above the floor's rest position; estimated, or measured, when empty
    double azimuth = 20;    // degrees, about z: 0 looks along -x at the wide face, positive goes to the right
    double elevation = 10;  // degrees above the horizon
    double field_of_view = 25;         // degrees, vertical; 0 for orthographic
    double zoom = 1;                   // over the automatic framing
    Vec3 up{0, 0, 1};                  // unit; against gravity where that is level. Azimuth is about it
    bool follow = false;               // true: the container's own frame, false: the lab's
    std::optional<Vec3> position;      // m, in place of azimuth, elevation and automatic framing
    std::optional<Vec3> target;        // m, the middle of the picture; the container's when empty
    double orbit = 0;                  // degrees turned about the vertical through the target ...
    std::optional<double> orbit_time;  // s of film in which it does so; all the film when empty
    std::vector<CameraKey> keys;       // by rising time
    bool moves() const { return orbit != 0 || !keys.empty(); }
    // Whether the picture's framing is the user's, not one that has the container whole.
    bool framed_by_user() const;
    bool operator==(const Camera&) const = default;
};

enum class FilmFormat { mp4, webm, av1, gif, ffv1, png, y4m };  // docs/guide/films.md says what each is

// Where the words of a frame are: beside the picture, or over it on plates. automatic: over it with a camera
// that the user frames.
enum class WordPlace { automatic, gutters, plates, none };

struct Film {
    int width = 1920, height = 1080;
    double rate = 30;   // frames a second of film
    std::string title;  // shown on the frame; empty: none is
    std::vector<FilmSegment> segments;
    std::vector<FilmCaption> captions;  // by rising time; none over another
    std::vector<FilmLabel> labels;
    int periods = 0;  // of the drive, that locked frames, displacements and means go by; 0: as the bed does
    Camera camera;
    Colour background{1, 1, 1};
    FilmLook look;
    int quality = 20;  // x264 crf; other codecs take what looks alike
    std::string preset = "veryfast";
    WordPlace words = WordPlace::automatic;
    WordKinds word_kinds;
    bool axes = false;        // x, y and z beside the picture
    bool wall_ghost = false;  // the outline of the container at rest
    double exaggerate = 1;    // of the container's motion, grains and all
    FilmShows shows;
    FilmFormat format = FilmFormat::mp4;
    bool transparent = false;              // no background: alpha in its place
    std::optional<std::int64_t> max_size;  // bytes, of the film's file
    std::array<int, 2> sheet{0, 0};        // columns and rows of the contact sheet; zeros: none
    std::string purpose;                   // whose defaults were taken ("journal"); empty: nobody's
    bool operator==(const Film&) const = default;
};

}  // namespace grainreel
