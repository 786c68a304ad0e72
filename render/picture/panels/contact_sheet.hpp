// A page of small pictures: frames spread evenly over the time that a film shows, each with its time. The
// header includes nothing of Cairo, since films include it.
#pragma once

#include <memory>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

struct _cairo;
struct _cairo_surface;

namespace grainreel {

class ContactSheet {
  public:
    // film.sheet gives columns and rows. The page is at most 1920 pixels wide.
    explicit ContactSheet(const Film& film);

    // Takes every frame of the film in order, since a run may be stopped and nobody knows how many frames
    // will come. time: s of the simulation, not of the film. Of frames with the same time the first is shown.
    void add(const Picture& picture, double time);

    // Draws the page of the frames up to now. last: the frame that was added last, which is always the last
    // on the page.
    Picture draw(const Picture& last) const;

  private:
    struct Tile {
        double time = 0;  // s
        std::shared_ptr<_cairo_surface> picture;
    };
    Tile tile(const Picture& picture, double time) const;
    std::vector<Tile> chosen(const Picture& last) const;
    void draw_tile(_cairo* on, const Tile& tile, std::size_t place, int decimals) const;

    int columns_, rows_;
    int width_, height_;  // pixels, size of a tile
    double letters_;      // pixels
    int label_;           // pixels of the times under the tiles; 0 without them
    Colour background_, ink_;
    std::vector<Tile> kept_;  // by rising time; several times as many as the page has room for
    double apart_ = 0;        // s: no two kept tiles are nearer in time than this
    double last_time_ = 0;
};

}  // namespace grainreel
