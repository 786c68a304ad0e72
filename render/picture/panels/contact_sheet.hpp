// A page of small pictures, frames spread evenly over the time that a film shows, each with its time.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

struct _cairo;
struct _cairo_surface;

namespace grainreel {

class ContactSheet {
  public:
    // Columns and rows are film.sheet's; the page is 1920 pixels wide at most.
    explicit ContactSheet(const Film& film);

    // Every frame of the film in order, since nobody knows how many will come: a run may be stopped. time: s,
    // simulated, which slow motion passes slowly. Of frames of one time the first is shown.
    void add(const Picture& picture, double time);

    // The page as of now. last: the frame that was added last, which ends the page whatever was kept.
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
    int width_, height_;  // of a tile, pixels
    double letters_;      // pixels
    int label_;           // pixels of the times under the tiles; 0 without them
    Colour background_, ink_;
    std::vector<Tile> kept_;  // by rising time, some times more than there is room for ...
    double apart_ = 0;        // ... and no two nearer than this, s
    double last_time_ = 0;
};

}  // namespace grainreel
