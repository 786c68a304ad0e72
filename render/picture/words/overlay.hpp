// All words of a picture: the words around it, in gutters without grains or on plates over the picture, and
// the labels beside grains. Words that never change are drawn once. Other words are drawn anew only when they
// have changed since the frame before.
#pragma once

#include <cairo.h>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/plots/plot.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/caption_band.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class Overlay {
  public:
    Overlay(const FilmedScene& scene, const Palette& palette, const PictureLayout& layout, const View& view);

    // Writes the gutters into the picture: all of them the first time, then only what changes. Plates are
    // only prepared here; lay_over() puts them into the picture. view: the view before the camera follows the
    // container.
    void write(Picture& picture, const Shot& frame, const std::string& playback, const View& view);
    // Lays the plates, if there are any, over a picture that is drawn.
    void lay_over(Picture& picture) const;

    // In place of both: the picture gets its background alone, and all words are drawn on a page of PDF.
    void leave_out(Picture& picture);
    void draw_on(cairo_t* on, const Shot& frame, const std::string& playback, const View& view);

    // Picture::still and Picture::moving, as far as the gutters are concerned.
    std::uint64_t still() const { return still_number_; }
    std::vector<Rectangle> moving() const;

  private:
    CairoSurface blank(const Rectangle& part, const std::vector<Rectangle>& plates) const;
    void draw_still(const View& view);
    void draw_still_numbers(const Writer& writer, const View& view) const;
    // Words of the second gutter that change. `now`: what they say or show, to see whether it has changed.
    struct Changing {
        Rectangle part;
        std::string now;
        std::function<void(const Writer&)> draw;
    };
    std::vector<Changing> changing(const Shot& frame, const std::string& playback, const View& view) const;
    void make_plots();
    // Puts a part of a gutter's surface where it belongs in the picture.
    void put(cairo_surface_t* from, const Rectangle& part, const Rectangle& gutter, Picture& picture) const;
    // Draws a rectangle of the second gutter anew over what stands still, and puts it into the picture.
    template <class Draw>
    void renew(Picture& picture, const Rectangle& part, const Draw& draw);
    void renew_plots(Picture& picture, const Shot& frame);
    void renew_caption(Picture& picture, const Shot& frame);

    const FilmedScene& scene_;
    const Palette palette_;
    const PictureLayout layout_;
    const TypeScale type_;
    const NumbersPlan plan_;
    const CaptionPlan captions_;
    const std::vector<Rectangle> first_plates_, second_plates_;  // pixels from the gutters' corners
    CairoSurface first_, still_, second_;
    std::vector<std::unique_ptr<SidePlot>> plots_;
    View drawn_for_;
    bool written_ = false;
    std::uint64_t still_number_ = 0;
    std::vector<std::string> now_;  // what the words that change say in the picture
    std::string caption_;
};

// Words beside single grains, [[film.label]]: each label stands on a plate to the right of its grain, with a
// line to it. Draws the labels of a frame. A label whose grain is not there or lies outside the view is left
// out. A label that would lie over another moves down below it. found: for each label, 1 if its grain has
// been in a frame; this frame is counted.
void draw_grain_labels(const FilmedScene& scene, const State& frame, const View& view,
                       const PictureLayout& layout, const Palette& palette, Picture& picture,
                       std::vector<char>& found);

// The same on a page, whose origin is the corner of the port.
void write_grain_labels(cairo_t* on, const FilmedScene& scene, const State& frame, const View& view,
                        const TypeScale& type, const Palette& palette, std::vector<char>& found);

// "label \"big\": no grain has the id 900 ..."; empty where all labels have had their grain.
std::string missing_labels(const FilmedScene& scene, const std::vector<char>& found);

}  // namespace grainreel
