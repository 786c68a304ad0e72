#include "render/film/side_by_side_drawer.hpp"

namespace grainreel {
namespace {

class SideBySideDrawer final : public Drawer {
  public:
    SideBySideDrawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                     gl::Provider provider, std::size_t clock)
        : panels_(panels, film, raster_threads, provider), clock_(clock), rate_(film.rate) {}
    void draw(const Frames& frames, const std::string& playback, Picture& into) override {
        into = panels_.draw(frames, playback, clock_, static_cast<double>(drawn_++) / rate_);
    }
    std::string description() const override { return panels_.gl_description(); }
    std::string note() const override { return panels_.gl_note(); }

  private:
    SideBySide panels_;
    const std::size_t clock_;
    const double rate_;
    std::int64_t drawn_ = 0;
};

}  // namespace

DrawerMaker side_by_side_drawer(const std::vector<Panel>& panels, const Film& film, int raster_threads,
                                gl::Provider provider, std::size_t clock) {
    return [=] { return std::make_unique<SideBySideDrawer>(panels, film, raster_threads, provider, clock); };
}

}  // namespace grainreel
