// A page of PDF that holds one picture and its words: the picture as pixels, the words as text that can be
// searched and copied, with their fonts. Cairo is not included here, so that films can include it.
#pragma once

#include <memory>
#include <string>

#include "render/picture/base/picture.hpp"

typedef struct _cairo cairo_t;

namespace grainreel {

class PdfPage {
  public:
    // width, height: pixels of the whole picture. dots_an_inch: pixels an inch on paper, above 0.
    PdfPage(int width, int height, double dots_an_inch);
    ~PdfPage();

    // Paints a picture with its upper left corner at the origin of on().
    void paint(const Picture& picture);
    // Cairo's context of the page, whose unit is one pixel of the picture.
    cairo_t* on() const;

    // The bytes of the file. The page takes nothing more. Throws RunError when Cairo could not make it.
    std::string finish(const std::string& title);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
