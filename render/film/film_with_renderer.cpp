// The only place where the production line meets OpenGL.
#include "render/draw/renderer.hpp"
#include "render/film/film_maker.hpp"

namespace grainreel {
namespace {

class RendererDrawer final : public Drawer {
  public:
    RendererDrawer(const Scene& scene, int raster_threads) : renderer_(scene, raster_threads) {}
    const Picture& draw(const Frame& frame, const std::string& playback) override {
        return renderer_.draw(frame, playback);
    }
    std::string description() const override { return renderer_.gl_description(); }

  private:
    Renderer renderer_;
};

}  // namespace

FilmMaker::FilmMaker(const Scene& scene, const FilmOptions& options)
    : FilmMaker(scene, options, [scene, threads = options.raster_threads] {
          return std::make_unique<RendererDrawer>(scene, threads);
      }) {}

}  // namespace grainreel
