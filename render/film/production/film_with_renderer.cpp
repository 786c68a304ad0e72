// The only place where the production line meets OpenGL.
#include "render/film/production/film_maker.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

class RendererDrawer final : public Drawer {
  public:
    RendererDrawer(const FilmedScene& scene, const FilmOptions& options)
        : renderer_(with_orbit(scene, options), options.raster_threads, options.gl),
          rate_(scene.film.rate),
          drawn_(static_cast<std::int64_t>(options.extent.earlier.size())) {
        if (options.start) renderer_.start_from(*options.start);
    }
    void draw(const Frames& frames, const std::string& playback, Picture& into) override {
        renderer_.draw_into(into, *frames.front(), playback, static_cast<double>(drawn_++) / rate_);
    }
    void remember(const Frames& frames) override { renderer_.remember(*frames.front()); }
    std::string description() const override { return renderer_.gl_description(); }
    std::string note() const override { return renderer_.gl_note(); }
    std::string last_note() const override { return renderer_.last_note(); }

  private:
    static FilmedScene with_orbit(FilmedScene scene, const FilmOptions& options) {
        settle_orbit(scene.film.camera, static_cast<double>(options.pictures) / scene.film.rate);
        return scene;
    }

    Renderer renderer_;
    const double rate_;
    std::int64_t drawn_;  // of the film, with the parts before this one
};

}  // namespace

FilmMaker::FilmMaker(const FilmedScene& scene, const FilmOptions& options)
    : FilmMaker(scene, options,
                [scene, options] { return std::make_unique<RendererDrawer>(scene, options); }) {}

}  // namespace grainreel
