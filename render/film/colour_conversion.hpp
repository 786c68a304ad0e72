// From drawn pixels to what H.264 stores: sRGB to BT.709 Y'CbCr, limited range, chroma halved both ways.
#pragma once

#include "render/draw/picture.hpp"
#include "render/film/ffmpeg_handles.hpp"

namespace grainreel {

class ColourConversion {
  public:
    // Size of the pictures, pixels. An odd width or height grows by one: its last column or row is repeated.
    ColourConversion(int width, int height);

    int coded_width() const { return width_ + width_ % 2; }
    int coded_height() const { return height_ + height_ % 2; }

    // `target`: yuv420p of the coded size, writable.
    void convert(const Picture& picture, AVFrame& target);

  private:
    const Picture& even(const Picture& picture);

    int width_, height_;
    ScalerPtr scaler_;
    Picture padded_;  // only used when a size is odd
};

}  // namespace grainreel
