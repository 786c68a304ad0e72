// The only place where the production line meets OpenGL.
#include "render/draw/renderer.hpp"
#include "render/film/film_maker.hpp"

namespace grainreel {
namespace {

class RendererDrawer final : public Drawer {
  public:
    RendererDrawer(const Scene& scene, const FilmOptions& options)
        : renderer_(scene, options.raster_threads, options.gl) {}
    const Picture& draw(const Frame& frame, const std::string& playback) override {
        return renderer_.draw(frame, playback);
    }
    std::string description() const override { return renderer_.gl_description(); }
    std::string note() const override { return renderer_.gl_note(); }

  private:
    Renderer renderer_;
};

}  // namespace

FilmMaker::FilmMaker(const Scene& scene, const FilmOptions& options)
    : FilmMaker(scene, options,
                [scene, options] { return std::make_unique<RendererDrawer>(scene, options); }) {}

}  // namespace grainreel
