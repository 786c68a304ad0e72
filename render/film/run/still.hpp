// Draws moments of a finished run as single pictures, one of them as a PNG or PDF file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/run/folder/listener.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/film/sources/stored_shots.hpp"
#include "render/picture/whole/renderer.hpp"

namespace grainreel {

class PdfPage;

// Values of the user's own, by which the grains of one picture are coloured.
struct OwnColours {
    GrainColouring colouring;      // by is GrainValue::own
    std::vector<std::int32_t> id;  // rising; empty: the values are those of all grains, in the order of ids
    std::vector<double> value;     // NaN: not known
};

// Draws moments of one run. The OpenGL context stays from picture to picture, also where colours are others,
// so the second is drawn sooner.
// A picture has the same bytes whatever was drawn before. Source and listener must outlive it. Construct and
// use it on one thread.
class StillPainter {
  public:
    // kept: the context of an earlier painter on this thread, which is taken in place of a new one.
    StillPainter(StoredShots& source, const FilmRequest& request, const PrintSize& print, Listener& listener,
                 std::shared_ptr<DrawingContext> kept = nullptr);

    struct Drawn {
        const Picture* picture;  // until the next call; null where it was drawn on a page
        ShotPtr frame;
        std::string from;  // "frame 4 of 7 of trajectory.nc"
    };
    // Draws the moment that `what` names. When it was not kept and cannot be brought back, the nearest kept
    // moment is drawn, with a warning. Empty when the listener asked to stop. Throws UserError when the run
    // has no such moment, and when there are not as many own values as grains. page: a page of PDF on which
    // the picture is drawn, with its words as text.
    std::optional<Drawn> draw(const RenderRequest& what, const OwnColours* own = nullptr,
                              PdfPage* page = nullptr);

    const FilmedScene& scene() const { return scene_; }
    std::shared_ptr<DrawingContext> context() const { return context_; }  // none before the first picture

  private:
    void tell_once(const std::vector<std::string>& lines);
    bool prepare(std::int64_t step, const OwnColours* own, const ShotSource::GoOn& go_on);

    StoredShots& source_;
    Listener& listener_;
    const gl::Provider gl_;
    FilmedScene scene_;
    std::shared_ptr<DrawingContext> context_;  // serves one renderer after the other
    std::optional<Renderer> renderer_;
    std::set<std::string> told_;  // warnings
};

// Draws the run at what.at (s), as its film would show that moment (StillPainter::draw), into a file. Returns
// the file; none when the listener asked to stop. Throws UserError, with nothing written, when the run has no
// such moment, or when the file exists and may not be replaced, or cannot be written.
std::optional<std::filesystem::path> draw_still(const FilmRequest& request, const RenderRequest& what,
                                                Listener& listener, StoredShots& source);

// Throws UserError where --out names no PNG or PDF file, or one that exists and may not be replaced.
void check_still(const FilmRequest& request, const RenderRequest& what);

// The title of a still in PDF: that of the film, and the moment.
std::string title_of_still(const FilmedScene& scene, const State& frame);

// Writes a time (s) for a file's name: "1.250", with more digits when the time needs them.
std::string seconds_in_names(double time);

}  // namespace grainreel
